// LUT and config files as OpenColorIO reads them, held against what was meant.
#pragma once

#include <string>

#include "looks/chain/chain.h"

namespace scotopic {

/// Throws Error(output), about `path`, unless OpenColorIO reads the LUT in `file`, finds every number of its
/// tables as in `chain`, and makes the same of colours over 28 stops, of black, negative and huge values, bit
/// for bit.
void require_read_back(const std::string& file, const std::string& path, const Chain& chain);

/// Throws Error(output), about `path`, unless OpenColorIO reads the config and finds it valid.
void require_config(const std::string& text, const std::string& path);

}  // namespace scotopic
