// A chain as OCIO runs it.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include "bake/chain.h"

namespace scotopic {

/// Step by step, forward.
OCIO_NAMESPACE::GroupTransformRcPtr ocio_transform(const Chain& chain);

/// Lossless optimisation only; float in and out.
OCIO_NAMESPACE::ConstCPUProcessorRcPtr cpu_processor(const OCIO_NAMESPACE::ConstTransformRcPtr& transform,
                                                     const OCIO_NAMESPACE::ConstConfigRcPtr& config);

}  // namespace scotopic
