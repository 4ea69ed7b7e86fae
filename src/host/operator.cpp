#include "host/operator.h"

#include <utility>

#include "cli/bake/bake_options.h"
#include "cli/report/scene_json.h"
#include "pipeline/stages/display_stages.h"

namespace scotopic {
namespace {

/// The same, with stages that tell what they have done.
ImageSettings measuring(const ImageSettings& settings) {
  ImageSettings out = settings;
  out.measure = true;
  out.frame_stages.clear();
  out.filter_stages.clear();
  out.point_stages.clear();
  add_stages(out);
  return out;
}

}  // namespace

HostOperator::HostOperator(const Parameters& parameters)
    : parameters_(parameters),
      options_(options_of(parameters)),
      evaluators_(understand(options_.precision)),
      settings_(understand(options_)) {
  check_view(settings_.request, settings_.config, {});
}

ImageReport HostOperator::apply(const MemoryJob& job, const Notes& notes) const {
  return run_image(job, settings_, *evaluators_, notes);
}

nlohmann::ordered_json HostOperator::explain(const MemoryJob& job, const Notes& notes) const {
  return explain_json(job.header.name, read_scene(job, measuring(settings_), Statistics::of_all_pixels, notes));
}

SceneReport HostOperator::plan(const MemoryJob& job, const Notes& notes) const {
  return read_scene(job, settings_, Statistics::where_needed, notes);
}

nlohmann::ordered_json HostOperator::bake(const std::string& path, const std::string& size,
                                          const std::string& max_error, const Notes& notes) const {
  BakeOptions o;
  o.appearance = options_.scene.appearance;
  o.adaptations = {o.appearance.adaptation};
  o.output = path;
  o.size = size;
  o.max_error = max_error;
  o.colourspace = options_.scene.image.colourspace;
  o.colour_config = options_.scene.image.config;
  o.working_primaries = options_.scene.image.working_primaries;
  o.limits = options_.scene.image.limits;
  return bake_luts(o, Console(o.common, [&](const std::string& line) { notes.note(line); }));
}

}  // namespace scotopic
