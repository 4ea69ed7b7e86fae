// An instance of the plug-in in a host: its panel, its clips, and the operator that the panel says.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "host/operator.h"
#include "ofx/api.h"
#include "ofx/panel.h"
#include "ofx/suites.h"

namespace scotopic::ofx {

/// Where and when something is asked for.
struct Moment {
  Time time = 0;
  double scale_x = 1, scale_y = 1;  ///< of a proxy
};

/// Any number of threads may render at once.
class Instance {
 public:
  explicit Instance(ImageEffect effect);

  /// Writes the window of the output.
  void render(const Moment& moment, const RectI& window);
  /// Whether the input is the output, as far as no pixel is needed to know.
  bool is_identity(const Moment& moment);
  /// What of the source `wanted` needs, in canonical coordinates; nullopt: the same region.
  std::optional<RectD> source_region(const Moment& moment, const RectD& wanted);
  /// The colour space that the source is asked for in; nullptr: any.
  const char* preferred_space() const;
  /// Of the output, for a host that manages colour; empty for others.
  std::string output_space();

 private:
  std::shared_ptr<const HostOperator> operator_for(const Parameters& parameters);
  /// The parameters, and the job without its pixels.
  PanelState ask(const Moment& moment, MemoryJob& job) const;
  /// As the host has it; empty where it says nothing.
  std::string source_space() const;
  TrackedAdaptation track(const PanelState& panel, Time time) const;
  Properties properties() const;
  double frame_rate() const;
  double pixel_aspect() const;

  ImageEffect effect_;
  Panel panel_;
  Clip source_ = nullptr, output_ = nullptr;
  PropertySet source_properties_ = nullptr;
  std::mutex lock_;
  Parameters current_parameters_;
  std::shared_ptr<const HostOperator> current_;
};

}  // namespace scotopic::ofx
