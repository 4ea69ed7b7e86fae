#include "pipeline/scene/angular_resolution.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "stages/acuity/cutoff.h"

namespace scotopic {
namespace {

int display_width(const PixelSource& source, const ImageLayout& layout) {
  return source.subimages()[layout.light.front().index].display.width();
}

/// Horizontal degrees of a lens by Exif's 35 mm equivalent: the frame is 36 mm wide.
std::optional<double> camera_field_of_view(const PixelSource& source, const ImageLayout& layout) {
  for (const Attribute& a : source.attributes(layout.light.front().index)) {
    if (a.name != "Exif:FocalLengthIn35mmFilm") continue;
    const double millimetres = std::holds_alternative<int>(a.value)      ? std::get<int>(a.value)
                               : std::holds_alternative<double>(a.value) ? std::get<double>(a.value)
                                                                         : 0.0;
    if (millimetres >= 1.0 && millimetres <= 10000.0)
      return 2.0 * std::atan(18.0 / millimetres) * 180.0 / std::numbers::pi;
  }
  return std::nullopt;
}

/// What a subimage on a desk or a wall fills of its viewer's field (our choice: a lens of 50 mm).
constexpr double assumed_degrees = 40;

/// OpenEXR's envmap; the same as OpenImageIO writes it where it is told by its own name; and that of maketx
/// --envlatl.
bool is_lat_long(const PixelSource& source, const ImageLayout& layout) {
  static const std::map<std::string, std::string> signs = {
      {"envmap", "latlong"}, {"openexr:envmap", "latlong"}, {"textureformat", "LatLong Environment"}};
  for (const Attribute& a : source.attributes(layout.light.front().index)) {
    const auto sign = signs.find(a.name);
    const auto* text = std::get_if<std::string>(&a.value);
    if (sign != signs.end() && text && *text == sign->second) return true;
  }
  return source.subimages()[layout.light.front().index].panorama;
}

double pixels_per_degree_of_panorama(double width) { return width / 360; }

}  // namespace

namespace {

AngularResolution resolution_across(const ViewingChoice& choice, const PixelSource& source,
                                    const ImageLayout& layout) {
  if (choice.pixels_per_degree) return {*choice.pixels_per_degree, true, "--ppd"};
  const double width = display_width(source, layout);
  if (choice.field_of_view) return {pixels_per_degree(width, *choice.field_of_view), true, "--fov"};
  if (const std::optional<double> camera = camera_field_of_view(source, layout))
    return {pixels_per_degree(width, *camera), true,
            fmt::format("the camera's focal length, {:.3g} degrees wide", *camera)};
  if (is_panorama(choice, source, layout))
    return {pixels_per_degree_of_panorama(width), true, "a panorama: 360 degrees wide"};
  if (layout.night || layout.output_space.for_a_device())
    return {pixels_per_degree(width, assumed_degrees), true,
            fmt::format("assumed: the picture is {:g} degrees wide; --fov or --ppd tells", assumed_degrees)};
  return {60.0, false, "not known: --fov or --ppd tells"};
}

}  // namespace

bool is_panorama(const ViewingChoice& choice, const PixelSource& source, const ImageLayout& layout) {
  return choice.panorama.value_or(is_lat_long(source, layout));
}

AngularResolution angular_resolution(const ViewingChoice& choice, const PixelSource& source,
                                     const ImageLayout& layout) {
  AngularResolution out = resolution_across(choice, source, layout);
  out.pixel_aspect = source.subimages()[layout.light.front().index].pixel_aspect;
  return out;
}

}  // namespace scotopic
