// Compiled together with SHADER, a DCTL, into a library: run() is what the host does for each pixel.
#include <cstddef>

#include "dctl.h"
#include SHADER

extern "C" void run(const float* in, float* out, std::size_t count) {
  for (std::size_t i = 0; i < 3 * count; i += 3) {
    const float3 seen = transform(1, 1, 0, 0, in[i], in[i + 1], in[i + 2]);
    out[i] = seen.x;
    out[i + 1] = seen.y;
    out[i + 2] = seen.z;
  }
}
