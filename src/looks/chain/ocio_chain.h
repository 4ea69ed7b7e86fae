// A chain as OCIO runs it.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include "looks/chain/chain.h"

namespace scotopic {

/// Step by step, forward; 3D LUTs read tetrahedrally, or as said.
OCIO_NAMESPACE::GroupTransformRcPtr ocio_transform(
    const Chain& chain, OCIO_NAMESPACE::Interpolation reading = OCIO_NAMESPACE::INTERP_TETRAHEDRAL);

/// Lossless optimisation only; float in and out. LogStep: log2 of every positive normal float to 1 ulp, of 1
/// at least; antilog2 from -80 to 24 to 1 ulp (tests/properties).
OCIO_NAMESPACE::ConstCPUProcessorRcPtr cpu_processor(const OCIO_NAMESPACE::ConstTransformRcPtr& transform,
                                                     const OCIO_NAMESPACE::ConstConfigRcPtr& config);

}  // namespace scotopic
