// A look's chain, run by OCIO.
#pragma once

#include "looks/chain/ocio_chain.h"

namespace scotopic::test {

inline OCIO_NAMESPACE::ConstCPUProcessorRcPtr processor_of(const Chain& chain) {
  return cpu_processor(ocio_transform(chain), OCIO_NAMESPACE::Config::CreateRaw());
}

}  // namespace scotopic::test
