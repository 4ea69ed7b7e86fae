// The operator as a host holds it: parameters, understood once, for any number of images.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "host/parameters.h"
#include "pipeline/memory/run_memory.h"
#include "pipeline/scene/angular_resolution.h"

namespace scotopic {

/// Immutable; any number of threads at once.
class HostOperator {
 public:
  /// Reads the colour config. Error as the program has it for the same options.
  explicit HostOperator(const Parameters& parameters);

  /// See run_image(MemoryJob).
  ImageReport apply(const MemoryJob& job, const Notes& notes) const;
  /// What `scotopic explain --json` says of such an image.
  nlohmann::ordered_json explain(const MemoryJob& job, const Notes& notes) const;
  /// What would run on the image, and why, without running it.
  SceneReport plan(const MemoryJob& job, const Notes& notes) const;
  /// Whether such an image comes out as it is, as far as that is known without a look at its pixels.
  bool changes_nothing(const MemoryJob& job) const;
  /// Pixels around each that its result depends on; nullopt: all of the image.
  std::optional<int> reach(const MemoryJob& job) const;
  /// The space that results are in, where that is another than the input's.
  std::optional<ColourSpace> new_space() const;
  /// The pixel stages as a LUT file, as `scotopic bake` writes it: `size` nodes a side, `max_error` may be
  /// empty. Returns what bake --json says. Needs an adaptation.
  nlohmann::ordered_json bake(const std::string& path, const std::string& size, const std::string& max_error,
                              const Notes& notes) const;
  /// The pixel stages, and with parameter display night its stage, as the text of a shader: dctl, glsl,
  /// blink, hlsl, osl, as `scotopic bake --shader` writes it.
  std::string shader(const std::string& language) const;

  const ImageSettings& settings() const noexcept { return settings_; }

 private:
  Parameters parameters_;
  ApplyOptions options_;
  std::unique_ptr<EvaluatorSource> evaluators_;
  ImageSettings settings_;
};

}  // namespace scotopic
