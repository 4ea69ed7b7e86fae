// Texts of OCIO configs: opened, every space looked at and converted through.
#include "fuzz/target.h"
#include "color/base_config.h"
#include "color/colour_config.h"
#include "base/error.h"

namespace scotopic::fuzz {

std::vector<Bytes> seeds() {
  return {bytes_of(R"(ocio_profile_version: 2
roles:
  scene_linear: lin
  default: lin
  cie_xyz_d65_interchange: xyz
displays:
  sRGB:
    - !<View> {name: Raw, colorspace: lin}
colorspaces:
  - !<ColorSpace>
    name: lin
  - !<ColorSpace>
    name: xyz
    from_scene_reference: !<MatrixTransform> {matrix: [0.4124, 0.3576, 0.1805, 0, 0.2126, 0.7152, 0.0722, 0, 0.0193, 0.1192, 0.9505, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: enc
    aliases: [e, display]
    to_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055}
)"),
          bytes_of("ocio_profile_version: 1\nroles: {scene_linear: a}\ndisplays: {d: [!<View> {name: v, "
                   "colorspace: a}]}\n"
                   "colorspaces: [!<ColorSpace> {name: a, isdata: true}]\n"),
          shipped("ocio_config/config.ocio")};
}

}  // namespace scotopic::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scotopic;
  const std::string file = fuzz::scratch_file("config.ocio", data, size);
  try {
    const ColourConfig config = ColourConfig::from_file(file);
    std::size_t seen = 0;
    for (const std::string& name : config.names()) {
      if (++seen > 20) break;
      try {
        const ColourSpace space = config.space(name);
        config.linear_xyz(space);
        float r[3] = {0, 0.5f, 1e30f}, g[3] = {-1, 0.5f, 1}, b[3] = {2, 0.5f, 0};
        config.to_working(space).apply(r, g, b, 3);
        config.from_working(space).apply(r, g, b, 3);
      } catch (const Error&) {
      }
    }
  } catch (const Error&) {
  }
  return 0;
}
