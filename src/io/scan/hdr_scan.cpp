// The text in front of a Radiance picture: "Radiance File Formats" (G. Ward), "Picture Files (.hdr)".
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "io/scan/image_scan.h"

namespace scotopic {
namespace {

constexpr int most_lines = 4096;

/// Numbers after the sign of a line that begins with `name`.
std::vector<double> numbers_of(const std::string& line, const std::string& name) {
  std::vector<double> out;
  if (line.rfind(name, 0) != 0) return out;
  std::istringstream stream(line.substr(name.size()));
  for (double value; stream >> value;) out.push_back(value);
  return out;
}

}  // namespace

ImageScan scan_hdr(const std::string& file) {
  ImageScan scan;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  for (int i = 0; i < most_lines && std::getline(in, line) && !line.empty() && line != "\r"; ++i) {
    // Each of them may come several times: they multiply.
    if (const auto n = numbers_of(line, "EXPOSURE="); n.size() == 1) scan.exposure *= n[0];
    if (const auto n = numbers_of(line, "COLORCORR="); n.size() == 3)
      for (std::size_t c = 0; c < 3; ++c) scan.correction[c] *= n[c];
    if (const auto n = numbers_of(line, "PRIMARIES="); n.size() == 8)
      scan.colour.primaries = Primaries{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
    if (line.rfind("FORMAT=32-bit_rle_xyze", 0) == 0) scan.xyz = true;
  }
  for (const double factor : {scan.exposure, scan.correction[0], scan.correction[1], scan.correction[2]})
    if (!(std::isfinite(factor) && factor >= 1e-30 && factor <= 1e30))
      throw Error(ExitCode::input, file, "is damaged: its EXPOSURE or COLORCORR is no factor");
  return scan;
}

}  // namespace scotopic
