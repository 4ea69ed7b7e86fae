// The text in front of a Radiance picture: "Radiance File Formats" (G. Ward), "Picture Files (.hdr)".
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "io/scan/image_scan.h"

namespace scotopic {
namespace {

constexpr int most_lines = 4096;
const std::string xyz_format = "FORMAT=32-bit_rle_xyze";

/// Numbers after the sign of a line that begins with `name`.
std::vector<double> numbers_of(const std::string& line, const std::string& name) {
  std::vector<double> out;
  if (line.rfind(name, 0) != 0) return out;
  std::istringstream stream(line.substr(name.size()));
  for (double value; stream >> value;) out.push_back(value);
  return out;
}

/// ImageMagick's, and of rgbe.c (B. Walter), that light was encoded with; by some its reciprocal is written.
void set_gamma(double gamma, ImageScan& scan) {
  if (!(gamma > 0) || std::abs(gamma - 1) < 1e-3) return;
  scan.colour.gamma = gamma < 1 ? 1 / gamma : gamma;
  scan.colour.radiance = true;
}

/// Exposure is of light: of encoded values it is what becomes of it on that way.
void encode_exposure(ImageScan& scan) {
  if (!scan.colour.gamma) return;
  scan.exposure = std::pow(scan.exposure, 1 / *scan.colour.gamma);
  for (double& factor : scan.correction) factor = std::pow(factor, 1 / *scan.colour.gamma);
}

/// "-Y 480 +X 640", or the columns first.
void read_resolution(const std::string& line, ImageScan& scan) {
  std::istringstream stream(line);
  std::string first, second;
  std::int64_t a = 0, b = 0;
  if (!(stream >> first >> a >> second >> b) || first.size() != 2 || second.size() != 2) return;
  scan.width = first[1] == 'X' ? a : b;
  scan.height = first[1] == 'X' ? b : a;
}

}  // namespace

ImageScan scan_hdr(const std::string& file) {
  ImageScan scan;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::uint64_t at = 0;
  for (int i = 0; i < most_lines && std::getline(in, line) && !line.empty() && line != "\r"; ++i) {
    // Each of them may come several times: they multiply.
    if (const auto n = numbers_of(line, "EXPOSURE="); n.size() == 1) scan.exposure *= n[0];
    if (const auto n = numbers_of(line, "COLORCORR="); n.size() == 3)
      for (std::size_t c = 0; c < 3; ++c) scan.correction[c] *= n[c];
    // Zeros state none: ImageMagick's, of linear pictures.
    if (const auto n = numbers_of(line, "PRIMARIES="); n.size() == 8 && n != std::vector<double>(8))
      scan.colour.primaries = Primaries{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
    if (const auto n = numbers_of(line, "GAMMA="); n.size() == 1) set_gamma(n[0], scan);
    if (const auto n = numbers_of(line, "PIXASPECT="); n.size() == 1) scan.pixel_aspect /= n[0];
    if (line.rfind(xyz_format, 0) == 0) scan.xyze_at = at + xyz_format.size() - 4;
    at += line.size() + 1;
  }
  if (std::getline(in, line)) read_resolution(line, scan);
  for (const double factor : {scan.exposure, scan.correction[0], scan.correction[1], scan.correction[2]})
    if (!(std::isfinite(factor) && factor >= 1e-30 && factor <= 1e30))
      throw Error(ExitCode::input, file, "is damaged: its EXPOSURE or COLORCORR is no factor");
  if (scan.xyze_at > 0) scan.colour.gamma.reset();  // X, Y, Z are light
  encode_exposure(scan);
  return scan;
}

}  // namespace scotopic
