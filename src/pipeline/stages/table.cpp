// The stages, in the order in which light passes. An effect of the eye is its folder in src/stages and its
// line here.
#include "pipeline/stages/stage_values.h"
#include "pipeline/stages/stages.h"
#include "stages/chroma/description.h"
#include "stages/detail/description.h"
#include "stages/display/description.h"
#include "stages/glare/description.h"
#include "stages/lamp/description.h"
#include "stages/luminance/description.h"
#include "stages/noise/description.h"
#include "stages/shift/description.h"
#include "stages/time/description.h"

namespace scotopic {
namespace {

/// The strength of a pixel stage: 0 where it is not wished for.
double strength(const StageValues& values, const StageDescription& stage) {
  return values.wish(stage.name) == EffectWish::no ? 0 : values.number(stage.parameters.front().name);
}

void set_shift(const StageValues& values, AppearanceParameters& p) {
  p.strength.shift = strength(values, shift_description);
}
void set_luminance(const StageValues& values, AppearanceParameters& p) {
  p.strength.luminance = strength(values, luminance_description);
}
void set_chroma(const StageValues& values, AppearanceParameters& p) {
  p.strength.chroma = strength(values, chroma_description);
}

constexpr StageEntry table[] = {
    {&glare_description, nullptr, add_glare},   {&lamp_description, nullptr, add_lamp},
    {&shift_description, set_shift, nullptr},   {&luminance_description, set_luminance, nullptr},
    {&chroma_description, set_chroma, nullptr}, {&time_description, nullptr, add_time},
    {&detail_description, nullptr, add_detail}, {&noise_description, nullptr, add_noise},
    {&display_description, nullptr, nullptr},
};

}  // namespace

StageTable shipped_stages() noexcept { return table; }

}  // namespace scotopic
