// One image from file to file: open, layout, meter, plan, stages, write. What the verbs, and any other way
// in, call with values that are parsed already; nothing is printed here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/apply_image.h"
#include "pipeline/evaluator.h"
#include "pipeline/notes.h"
#include "pipeline/scene/angular_resolution.h"
#include "pipeline/scene/open_image.h"
#include "pipeline/scene/scene_numbers.h"
#include "pipeline/settings.h"
#include "pipeline/stages/display_stages.h"
#include "scene/plan.h"

namespace scotopic {

/// What an adaptation track says of one frame.
struct TrackedAdaptation {
  double luminance = 0;                  ///< cd/m2
  std::string source;                    ///< how it is known, in words
  std::optional<AdaptationState> state;  ///< of an eye that is not adapted to it yet
};

/// One image to be made.
struct ImageJob {
  std::string input;
  std::string output;
  std::string provenance;                       ///< stamped on the output where not empty
  Moment moment;                                ///< its seconds follow from the frame
  std::optional<TrackedAdaptation> adaptation;  ///< in place of the settings'
  Progress progress;                            ///< of its rows
};

/// A scene as it was metered, and what it calls for.
struct SceneReport {
  SceneNumbers numbers;
  /// Of all pixels, or of the metered region alone; nullopt where nothing depends on them.
  std::optional<SceneStatistics> statistics;
  NonFinitePixels non_finite;  ///< where all pixels were looked at
  AppearanceParameters asked;  ///< before the plan
  ScenePlan plan;
  AngularResolution resolution;
  std::optional<AdaptationTrace> adapting;
  double frame_rate = 24;
  std::optional<SpectralReport> spectral;
};

/// What was read, done and written.
struct ImageReport {
  std::string input, output;
  std::string input_space, input_space_reason, output_space;
  std::vector<std::string> notes;  ///< what the output cannot hold
  SceneReport scene;
  std::vector<Attribute> stamps;
  NonFinitePixels non_finite;
  double clipped = 0;  ///< share of pixels that the output's type cannot hold
  std::shared_ptr<const Evaluator> evaluator;
  std::optional<ToneReport> tone;
  std::optional<NightReport> night;
};

/// Where an image comes from and goes to, if not from file to file.
class ImageEnds {
 public:
  virtual ~ImageEnds() = default;
  /// Called once, first.
  virtual OpenImage open(const ImageSettings& settings, const Notes& notes) = 0;
  /// Runs the stages; called once, last. See apply_image().
  virtual NonFinitePixels write(OpenImage& image, const ColourConfig& config, const ImageStages& stages,
                                const Progress& progress) = 0;
};

/// Writes one image, whole or not at all. Any number of threads at once. The input is decoded once to be
/// written, and once before where the adaptation is metered, frame stages run, or a tone map measures its
/// range. Throws Error.
ImageReport run_image(const ImageJob& job, const ImageSettings& settings, EvaluatorSource& evaluators,
                      const Notes& notes);

/// The same between other ends; the job's names are those of reports.
ImageReport run_image(const ImageJob& job, ImageEnds& ends, const ImageSettings& settings,
                      EvaluatorSource& evaluators, const Notes& notes);

/// Which statistics are wanted of an image that is only read.
enum class Statistics { of_all_pixels, where_needed };

/// Opens an image to read it, meters it and plans; decodes it once at most.
SceneReport read_scene(const ImageJob& job, const ImageSettings& settings, Statistics wanted,
                       const Notes& notes);

/// The same of an image that is open; the job's input is not looked at.
SceneReport read_scene(OpenImage& image, const ImageJob& job, const ImageSettings& settings,
                       Statistics wanted, const Notes& notes);

/// Frames a second, --fps, else the file's framesPerSecond, else 24; and which of these, in words.
struct FrameRate {
  double rate = 24;
  std::string source = "assumed";
};
FrameRate frame_rate(const StageValues& values, const PixelSource& source);

/// The plan for a scene whose numbers are known: without statistics by those alone.
ScenePlan plan_for(const ImageSettings& settings, const SceneNumbers& numbers,
                   const AngularResolution& resolution, const SceneStatistics* statistics);

}  // namespace scotopic
