#include "options/viewing_options.h"

#include "options/values.h"

namespace scotopic {

void add_viewing_options(CLI::App& verb, ViewingOptions& o) {
  const TextOptions add{verb, "Viewing"};
  add("--ppd", o.pixels_per_degree, "Pixels per degree of the viewer's field", "X");
  add("--fov", o.field_of_view, "Degrees that the picture's width fills of it, instead of --ppd", "DEG");
  add("--projection", o.projection,
      "flat or latlong (360 degrees wide); default: what the file says (envmap, GPano), else flat", "NAME");
}

ViewingChoice parse(const ViewingOptions& o) {
  ViewingChoice out;
  if (!o.pixels_per_degree.empty()) {
    if (!o.field_of_view.empty()) fail_value("--fov", o.field_of_view, "either --ppd or --fov, not both");
    out.pixels_per_degree =
        number_in("--ppd", o.pixels_per_degree, 0.01, 1e5, "pixels per degree, 0.01 to 1e5");
  }
  if (!o.field_of_view.empty())
    out.field_of_view = number_in("--fov", o.field_of_view, 0.01, 179, "degrees, 0.01 to 179");
  if (!o.projection.empty())
    out.panorama = choice<bool>("--projection", o.projection, {{"flat", false}, {"latlong", true}});
  return out;
}

}  // namespace scotopic
