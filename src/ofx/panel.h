// The plug-in's panel: which parameters it has, and what they say at a time as the operator's own.
#pragma once

#include <map>
#include <string>

#include "host/parameters.h"
#include "ofx/api.h"

namespace scotopic::ofx {

/// What no parameter of the operator is.
struct PanelState {
  Parameters parameters;
  double slider = 0;       ///< adaptation luminance of the slider, cd/m2
  bool by_slider = true;   ///< and no name, nor metering
  bool moves = true;       ///< images are frames of a sequence
  bool adapts = false;     ///< the eye follows the slider in time
  bool host_space = true;  ///< the host's word on the input's colour space is taken
};

/// The parameter that says whose it is.
inline constexpr const char* colour_space = "colorspace";

/// Defines all of it.
void define_panel(ParamSet set);

/// Handles of an instance's parameters.
class Panel {
 public:
  explicit Panel(ParamSet set);

  /// At a time of the host's; `scale` is that of a proxy, which pixels per degree follow.
  PanelState at(Time time, double scale) const;
  /// The slider alone, cd/m2.
  double slider(Time time) const;

 private:
  Param handle(const std::string& name) const;
  double number(const std::string& name, Time time) const;
  int integer(const std::string& name, Time time) const;
  std::string text(const std::string& name, Time time) const;
  std::string effects(Time time) const;

  std::map<std::string, Param> handles_;
};

}  // namespace scotopic::ofx
