#include "io/scan/image_scan.h"

#include <algorithm>
#include <string_view>

#include "base/error.h"
#include "color/icc/icc_check.h"

namespace scotopic {
namespace {

constexpr int deepest = 64;

/// What each tag of an XML text does to the depth.
class DepthCount {
 public:
  explicit DepthCount(std::string_view text) : text_(text) {}

  int deepest() {
    int depth = 0, most = 0;
    while (const char* kind = next_tag()) {
      depth += *kind == '+' ? 1 : *kind == '-' ? -1 : 0;
      most = std::max(most, depth);
    }
    return most;
  }

 private:
  /// "+" of one that opens, "-" closes, "0" neither; nullptr at the end.
  const char* next_tag() {
    at_ = text_.find('<', at_);
    if (at_ == std::string_view::npos || at_ + 1 >= text_.size()) return nullptr;
    const char first = text_[at_ + 1];
    if (text_.substr(at_, 4) == "<!--") return skip("-->"), "0";
    if (text_.substr(at_, 9) == "<![CDATA[") return skip("]]>"), "0";
    const std::size_t end = end_of_tag();
    const bool empty = end < text_.size() && end > at_ && text_[end - 1] == '/';
    at_ = end;
    if (first == '/') return "-";
    return first == '?' || first == '!' || empty ? "0" : "+";
  }

  /// Of the > that ends it, not one within quotes.
  std::size_t end_of_tag() const {
    char quote = 0;
    for (std::size_t i = at_; i < text_.size(); ++i) {
      const char c = text_[i];
      if (quote ? c == quote : c == '"' || c == '\'') quote = quote ? 0 : c;
      if (!quote && c == '>') return i;
    }
    return text_.size();
  }

  void skip(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    at_ = found == std::string_view::npos ? text_.size() : found;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Of a property, whether it is written as an attribute or as an element; empty: it is not there.
std::string_view xmp_value(std::string_view text, std::string_view name) {
  const std::size_t at = text.find(name);
  if (at == std::string_view::npos) return {};
  const std::size_t from = text.find_first_of("\"'>", at + name.size());
  if (from == std::string_view::npos) return {};
  return text.substr(from + 1, text.find_first_of("\"'<", from + 1) - from - 1);
}

/// "Photo Sphere XMP Metadata" (Google): a whole turn, where it was not cropped.
bool is_whole_panorama(std::string_view text) {
  return xmp_value(text, "GPano:ProjectionType") == "equirectangular" &&
         xmp_value(text, "GPano:FullPanoWidthPixels") == xmp_value(text, "GPano:CroppedAreaImageWidthPixels");
}

}  // namespace

void keep_profile(std::vector<std::byte> profile, const std::string& file, ImageScan& scan) {
  const std::string fault = fault_of_icc(profile);
  if (!fault.empty()) throw Error(ExitCode::input, file, "its ICC profile is damaged: " + fault);
  scan.colour.icc = std::make_shared<const std::vector<std::byte>>(std::move(profile));
}

void check_xmp(std::span<const std::byte> packet, const std::string& file, ImageScan& scan) {
  const std::string_view text(reinterpret_cast<const char*>(packet.data()), packet.size());
  if (DepthCount(text).deepest() > deepest)
    throw Error(ExitCode::input, file, "is damaged: its XMP nests deeper than 64 elements");
  for (const char* sign : {"hdrgm:", "GainMap", "hdrgainmap"})  // Adobe; Google and Apple; Apple
    scan.gain_map = scan.gain_map || text.find(sign) != std::string_view::npos;
  scan.panorama = scan.panorama || is_whole_panorama(text);
}

std::vector<ImageScan> scan_image(const std::string& file, const std::string& format) {
  if (format == "png") return {scan_png(file)};
  if (format == "jpeg") return {scan_jpeg(file)};
  if (format == "tiff") return scan_tiff(file);
  if (format == "hdr") return {scan_hdr(file)};
  return {};
}

}  // namespace scotopic
