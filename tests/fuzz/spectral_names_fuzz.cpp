// Channel names, one a line, "name" or "name=metres": the layout of spectral bands among them.
#include <cmath>
#include <sstream>

#include "fuzz/target.h"
#include "base/error.h"
#include "io/spectral/spectral_channels.h"

namespace scotopic::fuzz {

std::vector<Bytes> seeds() {
  return {bytes_of("S0.400,0nm\nS0.500,0nm\nS0.6,5e2nm\nR\nG\nB\n"),
          bytes_of("T.0,45um\nT.550nm\nT.666,2THz\nA\n"),
          bytes_of("S0.400nm\nS1.400nm\nS2.400nm\nS3.400nm\nS0.500nm\nS1.500nm\nS2.500nm\nS3.500nm\n"),
          bytes_of("wl0=4e-7\nwl1=5e-7\nwl2=6e-7\n"),
          bytes_of("left.S0.400nm\nleft.S0.500nm\nright.S0.400nm\nright.S0.500nm\n"),
          bytes_of("S0.-400nm\nS0.nm\nS0.1e999nm\nS0.4,0,0nm\n")};
}

}  // namespace scotopic::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scotopic;
  std::vector<ChannelName> names;
  std::istringstream lines(fuzz::text_of(data, size));
  for (std::string line; std::getline(lines, line);) {
    const auto equals = line.rfind('=');
    ChannelName channel{line.substr(0, equals), std::nullopt};
    if (equals != std::string::npos) channel.wavelength_m = std::strtod(line.c_str() + equals + 1, nullptr);
    names.push_back(channel);
    is_spectral_channel(channel.name);
    try {
      const double nm = wavelength_from_text(channel.name, channel.name);
      fuzz::expect(std::isfinite(nm) && nm > 0);
    } catch (const Error&) {
    }
  }
  try {
    const auto layout = find_spectral_layout(names, "", "file");
    if (!layout) return 0;
    fuzz::expect(!layout->bands.empty());
    for (std::size_t i = 0; i < layout->bands.size(); ++i) {
      const SpectralBand& band = layout->bands[i];
      fuzz::expect(band.channel < names.size() && std::isfinite(band.nm) && band.nm > 0);
      if (i > 0) fuzz::expect(band.nm > layout->bands[i - 1].nm);
    }
  } catch (const Error&) {
  }
  return 0;
}
