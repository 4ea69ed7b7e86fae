#include "host/operator.h"

#include <algorithm>
#include <utility>

#include "bake/bake_options.h"
#include "report/scene_json.h"
#include "pipeline/memory/kept_filters.h"
#include "pipeline/stages/display_stages.h"

namespace scotopic {
namespace {

/// The same, with stages that tell what they have done.
ImageSettings measuring(const ImageSettings& settings) {
  ImageSettings out = settings;
  out.measure = true;
  out.frame_stages.clear();
  out.light_stages.clear();
  out.filter_stages.clear();
  out.point_stages.clear();
  add_stages(out);
  return out;
}

/// What stages would be told before a pixel is read, La as given or 1.
StageScene scene_without_pixels(const ImageSettings& s, const MemoryJob& job) {
  StageScene out;
  const double adaptation = job.adaptation ? job.adaptation->luminance : s.choice.adaptation.value_or(1);
  out.parameters = parameters_of(s.choice, adaptation);
  out.resolution = resolution_in_memory(s, job);
  out.sequence = job.frame.has_value();
  out.tracked = job.adaptation.has_value();
  return out;
}

template <class Stages>
bool any_asked(const Stages& stages, const StageScene& scene) {
  return std::any_of(stages.begin(), stages.end(),
                     [&](const auto& stage) { return stage->decide(scene).asked; });
}

template <class Stages>
bool any_runs(const Stages& stages, const StageScene& scene) {
  return std::any_of(stages.begin(), stages.end(),
                     [&](const auto& stage) { return stage->decide(scene).runs(); });
}

bool is_metered(const ImageSettings& s, const MemoryJob& job) {
  return !job.adaptation && !s.choice.adaptation;
}

bool is_adapting(const ImageSettings& s, const MemoryJob& job) {
  return !s.time.history.empty() || (job.adaptation && job.adaptation->state);
}

/// What bake shares with apply.
BakeOptions bake_options(const ApplyOptions& options) {
  BakeOptions out;
  out.appearance = options.scene.appearance;
  out.adaptations = {out.appearance.adaptation};
  out.colourspace = options.scene.image.colourspace;
  out.colour_config = options.scene.image.config;
  out.working_primaries = options.scene.image.working_primaries;
  out.limits = options.scene.image.limits;
  return out;
}

/// Nothing after the stages, nor the way there, changes a value.
bool values_stay(const ImageSettings& s) {
  const ImageRequest& r = s.request;
  return !s.display.tone && r.night != NightDisplayMode::always && !r.view && !r.output_colourspace &&
         r.exposure == 0 && s.non_finite == NonFinite::keep;
}

}  // namespace

HostOperator::HostOperator(const Parameters& parameters)
    : parameters_(parameters),
      options_(options_of(parameters)),
      evaluators_(parse(options_.precision)),
      settings_(parse(options_)) {
  check_view(settings_.request, settings_.config, {});
  settings_.filter_stages = kept_filters(settings_.filter_stages);
}

ImageReport HostOperator::apply(const MemoryJob& job, const Notes& notes) const {
  return run_image(job, settings_, *evaluators_, notes);
}

nlohmann::ordered_json HostOperator::explain(const MemoryJob& job, const Notes& notes) const {
  return explain_json(job.header.name,
                      read_scene(job, measuring(settings_), Statistics::of_all_pixels, notes));
}

SceneReport HostOperator::plan(const MemoryJob& job, const Notes& notes) const {
  return read_scene(job, settings_, Statistics::where_needed, notes);
}

bool HostOperator::changes_nothing(const MemoryJob& job) const {
  if (!values_stay(settings_) || is_metered(settings_, job) || is_adapting(settings_, job)) return false;
  const StageScene scene = scene_without_pixels(settings_, job);
  if (any_asked(settings_.frame_stages, scene)) return false;
  const SceneNumbers numbers = {scene.parameters.adaptation, scene.parameters.white_luminance, "", ""};
  return plan_for(settings_, numbers, scene.resolution, nullptr).nothing() &&
         !any_runs(settings_.light_stages, scene) && !any_runs(settings_.point_stages, scene);
}

std::optional<int> HostOperator::reach(const MemoryJob& job) const {
  if (is_metered(settings_, job) || settings_.display.tone) return std::nullopt;
  const StageScene scene = scene_without_pixels(settings_, job);
  if (any_asked(settings_.frame_stages, scene)) return std::nullopt;
  int out = 0;
  for (const auto& stage : settings_.filter_stages) {
    if (!stage->decide(scene).runs()) continue;
    // What a filter does then is known only with the image's moment; a panorama goes on at its other side.
    if (is_adapting(settings_, job) || settings_.viewing.panorama.value_or(false)) return std::nullopt;
    out += stage->make(scene, {})->halo();
  }
  return out;
}

std::optional<ColourSpace> HostOperator::new_space() const { return new_space_in_memory(settings_); }

nlohmann::ordered_json HostOperator::bake(const std::string& path, const std::string& size,
                                          const std::string& max_error, const Notes& notes) const {
  BakeOptions o = bake_options(options_);
  o.output = path;
  o.size = size;
  o.max_error = max_error;
  return bake_luts(o, Console(o.common, [&](const std::string& line) { notes.note(line); }));
}

std::string HostOperator::shader(const std::string& language) const {
  BakeOptions o = bake_options(options_);
  o.shader = language;
  o.display = options_.display.display;
  return shader_text_of(o);
}

}  // namespace scotopic
