#include "io/scan/stale_metadata.h"

#include <algorithm>
#include <array>

namespace scotopic {
namespace {

// OpenImageIO, "maketx": what ImageCache goes by.
constexpr std::array<std::string_view, 7> pixel_names = {
    "oiio:SHA-1", "oiio:AverageColor", "oiio:ConstantColor", "oiio:ConstantAlpha",
    "SHA-1",      "AverageColor",      "ConstantColor"};

constexpr std::array<std::string_view, 14> colour_names = {
    "chromaticities",     "adoptedNeutral",  "colorInteropID", "acesImageContainerFlag",
    "oiio:ColorSpace",    "oiio:Gamma",      "ICCProfile",     "Exif:ColorSpace",
    "Exif:Gamma",         "png:gAMA",        "CICP",           "colorSpace",
    "renderingTransform", "lookModTransform"};

template <std::size_t n>
bool listed(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

bool describes_pixels(std::string_view name) {
  return listed(pixel_names, name) || name == "preview" || name.rfind("thumbnail", 0) == 0 ||
         name.rfind("Thumb::", 0) == 0;
}

bool describes_colours(std::string_view name) {
  return listed(colour_names, name) || name.rfind("ICCProfile:", 0) == 0;
}

std::string without_pixel_facts(const std::string& description) {
  std::string out = description;
  for (const std::string_view name : pixel_names) {
    const std::string key = std::string(name) + "=";
    for (std::size_t at = out.find(key); at != std::string::npos; at = out.find(key, at)) {
      const bool starts = at == 0 || out[at - 1] == ' ' || out[at - 1] == '\n';
      const std::size_t end = std::min(out.find_first_of(" \n", at), out.size());
      if (starts)
        out.erase(at, end - at + (end < out.size() ? 1 : 0));
      else
        at = end;
    }
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

}  // namespace scotopic
