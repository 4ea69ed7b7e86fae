// Stages that the fused loop of pixel stages does not hold: of whole subimages before it, of single pixels
// after those that look around. Both are told the scene.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adaptation/time/dark_adaptation.h"
#include "batch/batch.h"
#include "io/subimage.h"
#include "pipeline/notes.h"
#include "scene/plan.h"
#include "stages/acuity/filter.h"
#include "stages/shared/parallel_for.h"
#include "stages/shared/parameters.h"
#include "stages/shared/row_context.h"

namespace scotopic {

/// Pixels per degree, and how they are known.
struct AngularResolution {
  double pixels_per_degree = 60.0;
  bool known = false;
  std::string source;
  double pixel_aspect = 1;  ///< width over height of a pixel; the above is across
};

/// Where an eye stands that is still adapting, and what follows from it.
struct AdaptationTrace {
  AdaptationState state;
  AdaptationThresholds thresholds;
};

/// What a stage may know of the scene. Of a frame stage: adaptation and unit as given, or as metered on the
/// subimage before it; of a stage after the others, as they were used.
struct StageScene {
  AppearanceParameters parameters;
  AngularResolution resolution;
  bool wraps = false;                       ///< a panorama: its last column lies beside its first
  bool sequence = false;                    ///< a frame of one
  bool tracked = false;                     ///< whose adaptation changes from frame to frame
  Precision precision = Precision::single;  ///< of the pixel stages
  /// Of an eye that is not adapted yet; nullopt: it is.
  std::optional<AdaptationTrace> adapting;
};

/// A stage of an image, apart from its pixels.
class SceneStage {
 public:
  virtual ~SceneStage() = default;
  /// As options, plans and stamps have it.
  virtual std::string_view name() const noexcept = 0;
  /// Whether it was asked for, whether the scene calls for it, and why. Error(usage) where it cannot do what
  /// was asked for by name.
  virtual EffectDecision decide(const StageScene& scene) const = 0;
  /// What an output that it has changed says of it.
  virtual std::vector<Attribute> stamps(const StageScene& scene) const = 0;
};

/// A whole subimage's light: linear working RGB, and receptor signals where the file brings its own.
struct FramePlanes {
  std::array<float*, 3> rgb{};
  std::array<float*, 4> receptors{};  ///< L, M, S, rods; null where they follow from RGB
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;  ///< floats from row to row
  RowContext corner;          ///< of the first pixel
  /// Of each row, at least its greatest finite component of RGB; null where it is not known.
  const float* greatest = nullptr;

  /// Planes that are there: 3 or 7.
  int count() const noexcept { return receptors[0] ? 7 : 3; }
};

/// What a subimage is, as far as its header tells: enough to plan memory by.
struct FrameSize {
  int width = 0;
  int height = 0;
  int planes = 3;
  int threads = 1;
};

/// Whether a subimage was changed, and why or why not.
struct FrameOutcome {
  bool ran = false;
  std::string reason;  ///< in words, with the number
  double number = 0;   ///< what decided; added up over the subimages of an image
};

/// A stage that needs the whole subimage, as light that scatters in the eye does: before the pixel stages, in
/// place. Immutable: any number of subimages at once. Smaller resolutions of a subimage do not go through it.
class FrameStage : public SceneStage {
 public:
  /// Without a pixel, when adaptation and unit are not known yet: what the scene calls for is for run() to
  /// say.
  EffectDecision decide(const StageScene& scene) const override = 0;
  /// What run() allocates at most, the planes not counted.
  virtual std::int64_t bytes(const FrameSize& size, const StageScene& scene) const = 0;
  /// Changes `light`, if the scene calls for it. The result depends on no number of threads.
  virtual FrameOutcome run(const FramePlanes& light, const StageScene& scene,
                           const ParallelFor& parallel_for) const = 0;
};

using FrameStages = std::vector<std::shared_ptr<const FrameStage>>;

/// What a stage keeps from one row to the next, for itself.
class RowMemory {
 public:
  virtual ~RowMemory() = default;
};

/// What a stage of rows may look at besides the light that it changes.
struct RowSight {
  RowContext at;
  /// The row as the pixel stages saw it, receptors' signals included where the file has them; no pixels where
  /// the stage does not ask.
  PixelRows scene;
  /// What memory() made, for this thread alone: rows come whole, eight and more downwards at a time.
  RowMemory* memory = nullptr;
};

/// A stage of single pixels. Immutable: any number of threads. Results must not depend on how pixels are
/// grouped into rows.
class RowStage {
 public:
  virtual ~RowStage() = default;
  /// Whether it asks for RowSight::scene.
  virtual bool asks_for_scene() const noexcept { return false; }
  /// For a thread, where something is worth keeping.
  virtual std::unique_ptr<RowMemory> memory() const { return nullptr; }
  /// In place. Sets touched[i] to 1 where pixel i changes and leaves it elsewhere.
  virtual void apply(const PixelRows& rows, const RowSight& sight, std::uint8_t* touched) const = 0;
};

/// On light before the receptors: linear working RGB, and L, M, S where the file has them. Rods keep theirs.
struct LightMatrices {
  Matrix3<double> rgb = identity3<double>();
  Matrix3<double> lms = identity3<double>();
  Vec3<double> luminance = {0.2126, 0.7152,
                            0.0722};  ///< of RGB; what leaves the gamut fades at constant luminance
};

/// A stage that is a matrix on the light that the receptors get. Metering does not see it.
class LightStage : public SceneStage {
 public:
  /// For a scene that calls for it.
  virtual LightMatrices matrices(const StageScene& scene) const = 0;
};

/// A stage that looks at the pixels around each, after the pixel stages.
class FilterStage : public SceneStage {
 public:
  /// For a scene that calls for it.
  virtual std::unique_ptr<SpatialFilter> make(const StageScene& scene, const Notes& notes) const = 0;
};

/// A stage of single pixels after those.
class PointStage : public SceneStage {
 public:
  /// For a scene that calls for it.
  virtual std::unique_ptr<const RowStage> make(const StageScene& scene, const Notes& notes) const = 0;
};

using LightStages = std::vector<std::shared_ptr<const LightStage>>;
using FilterStages = std::vector<std::shared_ptr<const FilterStage>>;
using PointStages = std::vector<std::shared_ptr<const PointStage>>;

}  // namespace scotopic
