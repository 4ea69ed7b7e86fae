// Which reader a file is for: told by its first bytes.
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "io/oiio/formats_module.h"
#include "base/input_file.h"
#include "io/pixel_source.h"

namespace scotopic {
namespace {

using namespace std::string_view_literals;

/// The first bytes that each format we test begins with.
struct Magic {
  std::string_view bytes;
  const char* format;
};
constexpr std::array<Magic, 9> magics = {{{"\x76\x2f\x31\x01"sv, "openexr"},
                                          {"\x89PNG\r\n\x1a\n"sv, "png"},
                                          {"\xff\xd8\xff"sv, "jpeg"},
                                          {"II*\0"sv, "tiff"},
                                          {"MM\0*"sv, "tiff"},
                                          {"II+\0"sv, "tiff"},
                                          {"MM\0+"sv, "tiff"},
                                          {"#?RADIANCE"sv, "hdr"},
                                          {"#?RGBE"sv, "hdr"}}};

std::string format_of(const std::string& file) {
  (void)check_input_file(file, ExitCode::input, INT64_MAX, "");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(ExitCode::input, file, std::string("cannot be read: ") + std::strerror(errno));
  std::array<char, 16> start{};
  stream.read(start.data(), start.size());
  if (stream.bad())
    throw Error(ExitCode::input, file, std::string("cannot be read: ") + std::strerror(errno));
  const std::string_view head(start.data(), static_cast<std::size_t>(stream.gcount()));
  for (const Magic& magic : magics)
    if (head.substr(0, magic.bytes.size()) == magic.bytes) return magic.format;
  if (head.size() >= 8 && head.substr(4, 4) == "ftyp")
    throw Error(
        ExitCode::input, file,
        "is HEIF, AVIF or a film, which is not read: convert it to PNG or TIFF first (of an HDR picture "
        "with a gain map that keeps the rendition for SDR displays)");
  throw Error(ExitCode::input, file,
              head.empty() ? "is empty" : "is not an image (of OpenEXR, TIFF, PNG, JPEG, HDR)");
}

}  // namespace

std::unique_ptr<PixelSource> open_source(const std::string& file, const Limits& limits) {
  const std::string format = format_of(file);
  return format == "openexr" ? open_exr_source(file, limits)
                             : formats_module(file).open_source(file, format, limits);
}

}  // namespace scotopic
