// Parameters by name, as the program's options.
#pragma once

#include "options/scene/apply_settings.h"
#include "scotopic/parameters.h"

namespace scotopic {

/// The options with these values. Error(usage) for a name that is none, and for values that exclude each
/// other.
ApplyOptions options_of(const Parameters& parameters);

}  // namespace scotopic
