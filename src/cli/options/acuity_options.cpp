#include "cli/options/acuity_options.h"

#include "cli/options/values.h"

namespace scotopic {
namespace {

const std::vector<std::pair<std::string, AcuitySpace>> spaces = {{"light", AcuitySpace::light},
                                                                 {"lab", AcuitySpace::lab}};
const std::vector<std::pair<std::string, AcuityQuality>> qualities = {
    {"draft", AcuityQuality::draft}, {"normal", AcuityQuality::normal}, {"fine", AcuityQuality::fine}};

const std::vector<std::pair<std::string, std::string>> modes = {
    {"global", "global"}, {"local", "local"}, {"off", "off"}};

}  // namespace

void add_acuity_options(CLI::App& verb, AcuityOptions& o) {
  const std::string group = "Acuity";
  const auto add = [&](const char* name, std::string& value, const std::string& text, const char* kind) {
    verb.add_option(name, value, text)->type_name(kind)->group(group);
  };
  verb.add_flag("--acuity{global}", o.acuity,
                "Take away the detail that the dark-adapted eye does not resolve; --acuity local: less "
                "around lamps")
      ->group(group);
  add("--ppd", o.pixels_per_degree, "Pixels per degree of the viewer's field", "X");
  add("--fov", o.field_of_view, "Degrees that the picture's width fills of it, instead of --ppd", "DEG");
  add("--projection", o.projection, "flat or latlong (360 degrees wide); default: what an EXR's envmap says, else flat",
      "NAME");
  add("--strength-acuity", o.strength, "0 to 1", "X");
  add("--acuity-space", o.space, "What is averaged: light (default) or lab", "NAME");
  add("--acuity-range", o.range, "Differences that count as edges, CIELAB (default 15)", "X");
  add("--acuity-quality", o.quality, "draft, normal (default), fine", "NAME");
}

AcuityChoice understand(const AcuityOptions& o) {
  AcuityChoice out;
  const std::string mode = choice("--acuity", o.acuity, modes);
  out.asked = mode != "off";
  out.local = mode == "local";
  if (!o.pixels_per_degree.empty()) {
    if (!o.field_of_view.empty()) fail_value("--fov", o.field_of_view, "either --ppd or --fov, not both");
    out.pixels_per_degree =
        number_in("--ppd", o.pixels_per_degree, 0.01, 1e5, "pixels per degree, 0.01 to 1e5");
  }
  if (!o.field_of_view.empty())
    out.field_of_view = number_in("--fov", o.field_of_view, 0.01, 179, "degrees, 0.01 to 179");
  if (!o.projection.empty())
    out.panorama = choice<bool>("--projection", o.projection, {{"flat", false}, {"latlong", true}});
  out.parameters.strength = number_in("--strength-acuity", o.strength, 0, 1, "a strength from 0 (off) to 1");
  out.parameters.range_sigma = number_in("--acuity-range", o.range, 0.1, 1000, "CIELAB units, 0.1 to 1000");
  out.parameters.space = choice("--acuity-space", o.space, spaces);
  out.parameters.quality = choice("--acuity-quality", o.quality, qualities);
  return out;
}

}  // namespace scotopic
