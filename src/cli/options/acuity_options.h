// The options of the acuity filter, and how much detail a picture's pixels can hold.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "stages/acuity/filter.h"
#include "stages/shared/parameters.h"
#include "cli/console.h"
#include "pipeline/apply_image.h"

namespace scotopic {

/// As typed.
struct AcuityOptions {
  std::string acuity = "off";
  std::string strength = "1";
  std::string space = "light";
  std::string quality = "normal";
  std::string range = "15";
  std::string pixels_per_degree;
  std::string field_of_view;
  std::string projection;
};

/// As understood.
struct AcuityChoice {
  std::optional<bool> panorama;  ///< nullopt: as the file says
  bool asked = false;
  bool local = false;           ///< sigma follows each pixel's own surroundings
  AcuityParameters parameters;  ///< sigma, white and primaries are not set yet
  std::optional<double> pixels_per_degree;
  std::optional<double> field_of_view;  ///< degrees, of the width of the display window
};

/// Pixels per degree, and how they are known.
struct AngularResolution {
  double pixels_per_degree = 60.0;
  bool known = false;
  std::string source;
  double pixel_aspect = 1;  ///< width over height of a pixel; the above is across
};

void add_acuity_options(CLI::App& verb, AcuityOptions& options);

/// Error(usage) for a value that is not understood, and for --ppd or --fov given without use or both.
AcuityChoice understand(const AcuityOptions& options);

/// --ppd, else --fov, else the camera's 35 mm equivalent focal length in the file, else 60: a display on
/// which a pixel is one arc minute.
AngularResolution angular_resolution(const AcuityChoice& choice, const PixelSource& source,
                                     const ImageLayout& layout);

/// Whether its left side lies beside its right one: --projection, else what an EXR's envmap says.
bool is_panorama(const AcuityChoice& choice, const PixelSource& source, const ImageLayout& layout);

/// The filter of a scene, for a plan that runs it.
std::unique_ptr<SpatialFilter> acuity_filter(const AcuityChoice& choice, const AppearanceParameters& scene,
                                             const AngularResolution& resolution, const Console& console);

}  // namespace scotopic
