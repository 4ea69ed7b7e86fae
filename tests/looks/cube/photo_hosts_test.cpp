// Photographers' programs that take a cube or a Hald image of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "looks/cube/cube_hosts.h"

namespace scotopic {
namespace {

using test::CubeHosts;

// darktable's lut3d module, parameters of version 3: the file's name, the space, the reading, what G'MIC's
// compressed LUTs need.
constexpr std::size_t lut3d_name = 512, lut3d_rest = 4 + 2048 * 2 * 3 + 128;
enum class Lut3dReading : unsigned char { tetrahedral, trilinear };

std::string in_hexadecimal(const std::vector<unsigned char>& bytes) {
  std::string out;
  for (const unsigned char byte : bytes) out += fmt::format("{:02x}", byte);
  return out;
}

/// A sidecar with that module alone, on codes of sRGB, which a picture without a profile has.
void write_sidecar(const std::string& file, Lut3dReading reading) {
  std::vector<unsigned char> parameters(lut3d_name + 8 + lut3d_rest);
  const std::string name = "street.cube";
  std::memcpy(parameters.data(), name.data(), name.size());
  parameters[lut3d_name + 4] = static_cast<unsigned char>(reading);
  std::ofstream(file) << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                         "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
                         "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description "
                         "rdf:about=\"\" xmlns:darktable=\"http://darktable.sf.net/\" "
                         "darktable:xmp_version=\"5\" darktable:auto_presets_applied=\"1\" "
                         "darktable:history_end=\"1\" darktable:iop_order_version=\"2\"><darktable:history>"
                         "<rdf:Seq><rdf:li darktable:num=\"0\" darktable:operation=\"lut3d\" "
                         "darktable:enabled=\"1\" darktable:modversion=\"3\" darktable:params=\""
                      << in_hexadecimal(parameters)
                      << "\" darktable:multi_name=\"\" darktable:multi_priority=\"0\"/></rdf:Seq>"
                         "</darktable:history></rdf:Description></rdf:RDF></x:xmpmeta>\n";
}

std::string darktable_in(const std::string& folder) {
  return "rm -rf settings && mkdir settings && HOME=" + folder +
         "/settings darktable-cli in.png lut.xmp out.png --icc-type SRGB --apply-custom-presets false --core "
         "--disable-opencl --configdir settings --cachedir settings --library :memory: --conf "
         "plugins/darkroom/lut3d/def_path=" +
         folder + " --conf plugins/darkroom/workflow=none --conf plugins/imageio/format/png/bpp=16";
}

TEST_F(CubeHosts, darktable_lut3d) {
  NEEDS("darktable-cli");
  constexpr double own = 2e-4;  // its codes go through linear light and back, in float
  write_sidecar(folder(acescct) + "/lut.xmp", Lut3dReading::tetrahedral);
  expect("darktable lut3d tetrahedral", darktable_in(folder(acescct)),
         {Reading::tetrahedral, own, 0.08, 0.65});
  write_sidecar(folder(davinci) + "/lut.xmp", Lut3dReading::tetrahedral);
  expect("darktable lut3d tetrahedral", darktable_in(folder(davinci)),
         {Reading::tetrahedral, own, 0.085, 0.85}, davinci);
  write_sidecar(folder(acescct) + "/lut.xmp", Lut3dReading::trilinear);
  expect("darktable lut3d trilinear", darktable_in(folder(acescct)), {Reading::trilinear, own, 0.08, 0.65});
}

TEST_F(CubeHosts, rawtherapee_film_simulation) {
  NEEDS("ffmpeg");
  NEEDS("rawtherapee-cli");
  std::ofstream(folder(acescct) + "/lut.pp3")
      << "[Version]\nAppVersion=5.9\nVersion=349\n[Film Simulation]\nEnabled=true\nClutFilename="
      << folder(acescct)
      << "/hald.png\nStrength=100\n[Color Management]\nInputProfile=(camera)\nWorkingProfile=sRGB\n"
         "OutputProfile=RTv4_sRGB\n";
  expect("RawTherapee film simulation, 64 nodes",
         hald() + " && ffmpeg -v error -y -i in.png in.tif && HOME=" + folder(acescct) +
             " rawtherapee-cli -q -o out.tif -p lut.pp3 -b16 -t -Y -c in.tif",
         {Reading::trilinear, 0.004, 0.1, 0.8}, acescct, "out.tif");
}

}  // namespace
}  // namespace scotopic
