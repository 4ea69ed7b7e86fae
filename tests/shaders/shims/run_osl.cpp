// Compiled together with SHADER, the text of an OSL shader that osl_host() has made C++ of: its parameters
// are variables.
#include <cstddef>

#include "osl.h"
#include SHADER

extern "C" void run(const float* in, float* out, std::size_t count) {
  for (std::size_t i = 0; i < 3 * count; i += 3) {
    color seen;
    scotopic(color(in[i], in[i + 1], in[i + 2]), seen);
    for (int c = 0; c < 3; ++c) out[i + static_cast<std::size_t>(c)] = seen[c];
  }
}
