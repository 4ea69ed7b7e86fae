// The text in front of a Radiance picture: "Radiance File Formats" (G. Ward), "Picture Files (.hdr)".
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "io/scan/image_scan.h"

namespace scotopic {
namespace {

constexpr int most_lines = 4096;
const std::string xyz_format = "FORMAT=32-bit_rle_xyze";

/// `count` numbers after the sign of a line that begins with `name`; none for another line. Something else is
/// Error(input): what these lines say changes all pixels.
std::vector<double> numbers_of(const std::string& line, const std::string& name, std::size_t count,
                               const std::string& file) {
  std::vector<double> out;
  if (line.rfind(name, 0) != 0) return out;
  std::istringstream stream(line.substr(name.size()));
  for (double value; stream >> value;) out.push_back(value);
  if (out.size() != count || !stream.eof())
    throw Error(ExitCode::input, file,
                "is damaged: its " + name.substr(0, name.size() - 1) + " is not " +
                    (count == 1 ? "a number" : std::to_string(count) + " numbers"));
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

/// Exif's orientation of pixels in that order. Radiance counts x to the right and y upwards (resolu.h), so
/// "-Y" is down. OpenImageIO takes "+X +Y" for "-X -Y", and the reverse.
int orientation_of(const std::string& first, const std::string& second) {
  static constexpr std::array<std::pair<std::string_view, int>, 8> orders = {{{"-Y+X", 1},
                                                                              {"-Y-X", 2},
                                                                              {"+Y-X", 3},
                                                                              {"+Y+X", 4},
                                                                              {"+X-Y", 5},
                                                                              {"-X-Y", 6},
                                                                              {"-X+Y", 7},
                                                                              {"+X+Y", 8}}};
  for (const auto& [order, orientation] : orders)
    if (first + second == order) return orientation;
  return 1;
}

/// "-Y 480 +X 640", or the columns first.
void read_resolution(const std::string& line, ImageScan& scan) {
  std::istringstream stream(line);
  std::string first, second;
  std::int64_t a = 0, b = 0;
  if (!(stream >> first >> a >> second >> b) || first.size() != 2 || second.size() != 2) return;
  scan.width = first[1] == 'X' ? a : b;
  scan.height = first[1] == 'X' ? b : a;
  scan.orientation = orientation_of(first, second);
}

/// One that tells of pixels.
void read_line(const std::string& line, const std::string& file, ImageScan& scan) {
  const auto numbers = [&](const char* name, std::size_t count) {
    return numbers_of(line, name, count, file);
  };
  // Each of them may come several times: they multiply.
  if (const auto n = numbers("EXPOSURE=", 1); !n.empty()) scan.exposure *= n[0];
  if (const auto n = numbers("COLORCORR=", 3); !n.empty())
    for (std::size_t c = 0; c < 3; ++c) scan.correction[c] *= n[c];
  // Zeros state none: ImageMagick's, of linear pictures.
  if (const auto n = numbers("PRIMARIES=", 8); !n.empty() && n != std::vector<double>(8))
    scan.colour.primaries = Primaries{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
  if (const auto n = numbers("GAMMA=", 1); !n.empty()) set_gamma(n[0], scan);
  if (const auto n = numbers("PIXASPECT=", 1); !n.empty()) scan.pixel_aspect /= n[0];
}

}  // namespace

ImageScan scan_hdr(const std::string& file) {
  ImageScan scan;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::uint64_t at = 0;
  for (int i = 0; i < most_lines && std::getline(in, line) && !line.empty() && line != "\r"; ++i) {
    read_line(line, file, scan);
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
