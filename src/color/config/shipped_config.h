// Where the config that ships with the program lies.
#pragma once

#include <string>

namespace scotopic {

/// Beside an installed program or module, where packages put it, beside a build folder; empty: nowhere.
std::string shipped_config_file();

}  // namespace scotopic
