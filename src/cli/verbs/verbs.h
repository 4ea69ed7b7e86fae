// The verbs in the order in which help lists them.
#pragma once

#include <vector>

#include "cli/program.h"

namespace scotopic {

std::vector<AddVerb> verbs();

}  // namespace scotopic
