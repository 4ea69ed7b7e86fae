#include "cli/scene/way_keeper.h"

#include <tuple>

namespace scotopic {
namespace {

/// What a scene or its plan may change of the parameters; the rest is the command's.
auto of_scene(const AppearanceParameters& p) {
  return std::make_tuple(p.adaptation, p.white_luminance, p.luminance, p.strength.all, p.strength.shift,
                         p.strength.luminance, p.strength.chroma);
}

}  // namespace

ChosenWay WayKeeper::way(const AppearanceParameters& parameters, bool receptors, const Console& console) {
  const std::lock_guard guard(lock_);
  if (kept_ && receptors == receptors_ && of_scene(parameters) == of_scene(parameters_)) return *kept_;
  ChosenWay way = settle(choice_, parameters, receptors, console);
  if (!choice_.way) choice_.way = &way_named(way.name);
  parameters_ = parameters;
  receptors_ = receptors;
  kept_ = std::move(way);
  return *kept_;
}

}  // namespace scotopic
