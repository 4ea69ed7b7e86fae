// The LUT files that a transform of a config names, looked at before OpenColorIO reads them.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <string>

#include "base/limits.h"

namespace scotopic {

/// Throws Error(config) where a file that `transform` leads to, through colour spaces and looks too, is no
/// regular file (a pipe would hold us, a device be without end) or a way leads through itself, and
/// Error(limit) where one is larger than limits.lut. Files that are not there are left to OpenColorIO to
/// name.
void check_lut_files(const OCIO_NAMESPACE::ConstConfigRcPtr& config,
                     const OCIO_NAMESPACE::ConstTransformRcPtr& transform, const Limits& limits);

/// Throws Error(config), about `file`, where a LUT of the processor has less than two nodes a side:
/// OpenColorIO 2.1 never ends inverting such a one.
void require_usable_luts(const OCIO_NAMESPACE::ConstProcessorRcPtr& processor, const std::string& file);

}  // namespace scotopic
