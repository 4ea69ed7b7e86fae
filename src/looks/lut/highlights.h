// The highlight-safe view's curve.
#pragma once

#include "looks/chain/chain.h"

namespace scotopic {

/// Linear RGB, white at 1, to display-linear 0..1: identity up to .5, then 1 - .5 exp(1 - 2x): its value and
/// slope go on, and 1 is never passed. Relative error below 1e-4.
Chain highlight_chain(const std::string& version);

}  // namespace scotopic
