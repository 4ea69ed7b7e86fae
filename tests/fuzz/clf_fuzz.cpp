// Texts of LUT files (CLF, CTF): opened as check does, and one pixel put through.
#include "looks/verify/inspect.h"
#include "fuzz/target.h"
#include "base/error.h"

namespace scotopic::fuzz {

std::vector<Bytes> seeds() {
  return {bytes_of(R"(<?xml version="1.0" encoding="UTF-8"?>
<ProcessList compCLFversion="3" id="a">
  <Range inBitDepth="32f" outBitDepth="32f"><minInValue>0</minInValue><minOutValue>0</minOutValue></Range>
  <Matrix inBitDepth="32f" outBitDepth="32f"><Array dim="3 3">1 0 0 0 1 0 0 0 1</Array></Matrix>
  <Log inBitDepth="32f" outBitDepth="32f" style="log2"></Log>
  <LUT1D inBitDepth="32f" outBitDepth="32f"><Array dim="2 1">0 1</Array></LUT1D>
  <LUT3D inBitDepth="32f" outBitDepth="32f" interpolation="tetrahedral"><Array dim="2 2 2 3">
0 0 0 0 0 1 0 1 0 0 1 1 1 0 0 1 0 1 1 1 0 1 1 1</Array></LUT3D>
</ProcessList>
)"),
          shipped("luts/filament2021_10.clf")};
}

}  // namespace scotopic::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scotopic;
  const std::string file = fuzz::scratch_file("look.clf", data, size);
  try {
    const auto processor = lut_processor(file);
    float pixel[3] = {0.1f, 0.2f, 0.3f};
    processor->applyRGB(pixel);
  } catch (const Error&) {
  }
  try {
    inspect_lut(file, ColourConfig::own());
  } catch (const Error&) {
  }
  return 0;
}
