// What is asked for, as values: made by whoever parses options, keywords or parameters; the same for all
// images.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adaptation/time/dark_adaptation.h"
#include "base/limits.h"
#include "color/colour_config.h"
#include "io/spectral/spectral_source.h"
#include "pipeline/layout/layout.h"
#include "pipeline/rows/non_finite.h"
#include "pipeline/rows/stages.h"
#include "pipeline/stages/stage_values.h"
#include "stages/display/local/display.h"
#include "stages/lamp/lamp.h"
#include "stages/shared/parameters.h"

namespace scotopic {

/// What of a picture the eye is taken to be adapted to, where that is metered.
struct AdaptationMethod {
  std::optional<double> quantile;  ///< of luminance, 0 to 1; absent: log-average
  std::optional<Window> region;    ///< only these pixels are metered, in coordinates of the display window
  std::string description = "log-average of the picture";
};

/// A light by its name, its S/P ratio alone, or a file with its spectrum.
struct IlluminantChoice {
  std::string name;
  double sp_ratio = sp_ratio_d65;
  std::optional<Spectrum> spectrum;
};

/// The pixel stages. Adaptation, white luminance and primaries in `parameters` are those of a scene; see
/// parameters_of().
struct OperatorChoice {
  AppearanceParameters parameters;
  std::optional<double> adaptation;  ///< cd/m2; nullopt: auto, by `metering`
  std::string adaptation_source = "--adaptation";
  AdaptationMethod metering;
  std::optional<double> white_luminance;  ///< cd/m2; nullopt: the file's, or from the adaptation
  bool plan_effects = false;              ///< --effects auto
  StageValues stages;                     ///< wishes and values of all stages
  std::string gamut = "working";
  IlluminantChoice illuminant;
  std::optional<Vec3<double>> lamp;  ///< XYZ of the lamp that the eye is used to, any scale
};

/// How large a pixel is to the viewer.
struct ViewingChoice {
  std::optional<bool> panorama;  ///< nullopt: as the file says
  std::optional<double> pixels_per_degree;
  std::optional<double> field_of_view;  ///< degrees, of the width of the display window
};

/// Light that the eye was in before.
struct TimeChoice {
  std::vector<AdaptationPeriod> history;  ///< before frame 0; empty: ever in the scene's own light
};

/// What a display is sent by the tone map; the display stage is one of the table. The scene's numbers are not
/// set yet.
struct DisplayChoice {
  bool tone = false;                  ///< the local tone map runs
  DisplayParameters parameters;       ///< of the tone map
  std::optional<DisplayRange> range;  ///< nullopt: measured
  std::string of_night;               ///< an option given that only the display stage knows; empty: none
};

/// Everything.
struct ImageSettings {
  explicit ImageSettings(ColourConfig in_force) : config(std::move(in_force)) {}

  OperatorChoice choice;
  ViewingChoice viewing;
  TimeChoice time;
  DisplayChoice display;
  ImageRequest request;
  NonFinite non_finite = NonFinite::keep;
  Limits limits;
  SpectralOptions spectral;
  ColourConfig config;
  bool sequence = false;       ///< images are frames of one
  bool measure = false;        ///< stages measure what they have done, to tell of it
  FrameStages frame_stages;    ///< before the pixel stages, in this order
  LightStages light_stages;    ///< on what the receptors get
  FilterStages filter_stages;  ///< after the pixel stages
  PointStages point_stages;    ///< after those that look around, before the display
};

/// Adds the stages of choice.stages: when all else is set.
void add_stages(ImageSettings& settings);

/// Sets the primaries: those of the config's working space, and of the gamut chosen.
void set_primaries(OperatorChoice& choice, const ColourConfig& config);

/// The operator's parameters in a scene: adaptation and what image value 1 stands for, both in cd/m2.
AppearanceParameters parameters_of(const OperatorChoice& choice, double adaptation, double white_luminance);
/// Without a picture: the unit is as asked for, else such that middle grey is what the eye is adapted to.
AppearanceParameters parameters_of(const OperatorChoice& choice, double adaptation);

/// The lamp that the eye is used to, as the stage has it.
std::optional<Lamp> lamp_of(const OperatorChoice& choice);

/// Error(config) for a space that the config does not have: before any file is opened.
void check_spaces(const ImageRequest& request, const ColourConfig& config);

}  // namespace scotopic
