#include "ofx/colour.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/error.h"

namespace scotopic::ofx {
namespace {

// Style Core: the spaces that are one space each.
constexpr std::array core_spaces = {"ACEScg",
                                    "ACES2065-1",
                                    "lin_rec709_srgb",
                                    "lin_rec2020",
                                    "lin_p3d65",
                                    "ACEScc",
                                    "ACEScct",
                                    "srgb_tx",
                                    "g18_rec709_tx",
                                    "g22_rec709_tx",
                                    "g24_rec709_tx",
                                    "g22_ap1_tx",
                                    "srgb_display",
                                    "displayp3_display",
                                    "rec1886_rec709_display",
                                    "rec1886_rec2020_display",
                                    "p3d65_display",
                                    "rec2100_hlg_display",
                                    "rec2100_pq_display",
                                    "st2084_p3d65_display",
                                    "srgb_encoded_ap1_tx",
                                    "srgb_encoded_p3d65_tx"};

// Roles and kinds: what they stand for, or why they tell nothing.
struct Kind {
  std::string_view identifier;
  std::string_view space;    ///< of a config; empty: the working space
  std::string_view problem;  ///< if not empty
};
constexpr std::string_view of_no_colour = "says that its values are no colours";
constexpr std::string_view of_many_logs = "may be any log encoding";
constexpr std::string_view of_many_displays = "may be any display's encoding";
constexpr std::array kinds = {Kind{colour::scene_linear, "", ""},
                              Kind{"scene_linear", "", ""},
                              Kind{"aces_interchange", "ACES2065-1", ""},
                              Kind{"cie_xyz_d65_interchange", "CIE-XYZ-D65", ""},
                              Kind{colour::scene_log, "", of_many_logs},
                              Kind{"compositing_log", "", of_many_logs},
                              Kind{"color_timing", "", of_many_logs},
                              Kind{"matte_paint", "", of_many_logs},
                              Kind{"texture_paint", "", "may be any encoding of textures"},
                              Kind{"color_picking", "", of_many_displays},
                              Kind{colour::display_sdr, "", of_many_displays},
                              Kind{colour::display_hdr, "", of_many_displays},
                              Kind{colour::raw, "", of_no_colour},
                              Kind{"data", "", of_no_colour},
                              Kind{"Raw", "", of_no_colour}};

[[noreturn]] void refuse(const std::string& identifier, std::string_view problem) {
  throw Error(ExitCode::config, "",
              "the host's colour space '" + identifier + "' " + std::string(problem) +
                  ": have it send scene-linear light, or choose the space under Colorspace");
}

/// Of the space that a display is sent under a view: the config's name of it.
std::string name_of(const ColourSpace& space, const ColourConfig& config) {
  if (!space.view) return space.name;
  const std::string name =
      config.ocio()->getDisplayViewColorSpaceName(space.view->display.c_str(), space.view->view.c_str());
  return name == "<USE_DISPLAY_NAME>" ? space.view->display : name;
}

const char* kind_of(const ColourSpace& space, const std::string& name, const ColourConfig& config) {
  const auto known = config.ocio()->getColorSpace(name.c_str());
  if (!known || known->isData()) return colour::raw;
  const std::string encoding = known->getEncoding();
  if (encoding == "sdr-video") return colour::display_sdr;
  if (encoding == "hdr-video") return colour::display_hdr;
  if (encoding == "log") return colour::scene_log;
  if (encoding == "scene-linear" || (!space.view && config.linear_xyz(space))) return colour::scene_linear;
  return colour::raw;
}

}  // namespace

const std::optional<ColourConfig>& config_in_force() {
  static const std::optional<ColourConfig> config = []() -> std::optional<ColourConfig> {
    try {
      return ColourConfig::in_force("");
    } catch (const Error&) {
      return std::nullopt;
    }
  }();
  return config;
}

void describe_colour(const Properties& effect) {
  const std::string offered = host_properties().text(property::colour_style);
  if (offered.empty() || offered == colour::none) return;
  effect.set(property::colour_style, colour::core);
  effect.set(property::colour_configs, colour::native_config);
}

ColourStyle colour_style(const Properties& instance) {
  const std::string style = instance.text(property::colour_style);
  if (style.empty() || style == colour::none) return ColourStyle::none;
  return style == colour::basic ? ColourStyle::basic : ColourStyle::core;
}

std::string space_for(const std::string& identifier, const ColourConfig& config) {
  std::string name = identifier;
  for (const Kind& kind : kinds) {
    if (kind.identifier != identifier) continue;
    if (!kind.problem.empty()) refuse(identifier, kind.problem);
    if (kind.space.empty()) return "";
    name = kind.space;
  }
  if (!config.has_space(name))
    refuse(identifier, "is not in the colour config" + (config.file().empty() ? "" : " " + config.file()));
  return name;
}

std::string identifier_of(const ColourSpace& space, const ColourConfig& config, ColourStyle style) {
  const std::string name = name_of(space, config);
  if (style == ColourStyle::core && config.has_space(name))
    for (const char* identifier : core_spaces)
      if (config.has_space(identifier) && config.resolve(identifier) == config.resolve(name))
        return identifier;
  return kind_of(space, name, config);
}

}  // namespace scotopic::ofx
