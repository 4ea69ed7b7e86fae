// A light's spectrum from text.
#include <cmath>

#include "fuzz/target.h"
#include "base/error.h"
#include "io/spectral/spectrum_file.h"

namespace scotopic::fuzz {

std::vector<Bytes> seeds() {
  return {bytes_of("# a lamp\nnm,power\n400,0.1\n500,1\n600,.7\n700,0\n"),
          bytes_of("400;0.1\n400.1;0.2\n500;3e-4\n"), bytes_of("380 1\n780 1\n"),
          bytes_of("nm\tvalue\n1e2\t0\n9e2\t1\n")};
}

}  // namespace scotopic::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scotopic;
  try {
    const Spectrum spectrum = spectrum_from_text(fuzz::text_of(data, size), "file");
    for (const double v : spectrum.values) fuzz::expect(std::isfinite(v));
  } catch (const Error&) {
  }
  return 0;
}
