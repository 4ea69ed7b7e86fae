// Compiled together with SHADER, a Blink kernel, into a library: run() is what the host does for each pixel.
#include <cstddef>

#include "blink.h"
#include SHADER

namespace {
Scotopic& the_kernel() {
  static Scotopic one;
  return one;
}
}  // namespace

/// A slider; nullptr: there is none of that name.
extern "C" float* slider(const char* name) {
  if (the_kernel().parameters.empty()) the_kernel().define();
  const auto found = the_kernel().parameters.find(name);
  return found == the_kernel().parameters.end() ? nullptr : found->second;
}

extern "C" void run(const float* in, float* out, std::size_t count) {
  Scotopic& k = the_kernel();
  k.init();
  for (std::size_t i = 0; i < 3 * count; i += 3) {
    k.src() = float4(in[i], in[i + 1], in[i + 2], 0.25f);
    k.process();
    const float4 seen = k.dst();
    out[i] = seen.x;
    out[i + 1] = seen.y;
    out[i + 2] = seen.w == 0.25f ? seen.z : NAN;
  }
}
