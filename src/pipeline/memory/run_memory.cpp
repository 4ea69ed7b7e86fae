#include "pipeline/memory/run_memory.h"

#include <cstddef>
#include <utility>

#include "base/error.h"
#include "pipeline/memory/tile_filter.h"

namespace scotopic {
namespace {

/// Its extension says which of a config's rules are for it.
constexpr const char* stands_for = "image.exr";

ImageRequest request_of(const ImageSettings& settings) {
  ImageRequest out = settings.request;
  if (!out.colourspace) out.colourspace = settings.config.working_space();
  return out;
}

OpenImage open_memory(const MemoryJob& job, const ImageSettings& settings, const Notes& notes,
                      bool to_write) {
  OpenImage image;
  image.source = std::make_unique<MemorySource>(job.in, job.header);
  const ImageRequest request = request_of(settings);
  image.layout = to_write ? plan_layout(*image.source, stands_for, settings.config, request)
                          : read_layout(*image.source, settings.config, request);
  for (LightSubimage& light : image.layout.light)
    if (!settings.request.colourspace) light.space_reason = "the working space";
  for (OutputSubimage& out : image.layout.outputs) out.subimage.unassociated_alpha = job.header.straight;
  image.layout.notes.clear();  // about files
  image.layout.wraps = is_panorama(settings.viewing, *image.source, image.layout);
  image.known = known_numbers(settings.choice, *image.source, image.layout, notes);
  return image;
}

class MemoryEnds : public ImageEnds {
 public:
  explicit MemoryEnds(const MemoryJob& job) : job_(job) {}
  OpenImage open(const ImageSettings& settings, const Notes& notes) override {
    return open_memory(job_, settings, notes, true);
  }
  NonFinitePixels write(OpenImage& image, const ColourConfig& config, const ImageStages& stages,
                        const Progress& progress) override {
    MemorySink sink(job_.in, job_.header.data, job_.out, job_.window);
    return write_subimages(*image.source, image.layout, config, stages, sink, progress);
  }

 private:
  const MemoryJob& job_;
};

ImageJob named(const MemoryJob& job) {
  ImageJob out;
  out.input = out.output = job.header.name;
  out.moment.frame = job.frame.value_or(0);
  out.adaptation = job.adaptation;
  out.progress = job.progress;
  return out;
}

ImageSettings settings_for(const MemoryJob& job, const ImageSettings& settings) {
  ImageSettings out = settings;
  out.sequence = job.frame.has_value();
  if (job.header.whole)
    out.filter_stages = stages_on_tile(settings.filter_stages, job.header.data, *job.header.whole);
  return out;
}

void check(const MemoryJob& job) {
  const MemoryPixels &in = job.in, &out = job.out;
  const bool fits = in.channels == out.channels && in.type == out.type && job.window.width() == out.width &&
                    job.window.height() == out.height && job.header.data.width() == in.width &&
                    job.header.data.height() == in.height;
  if (!fits) throw Error(ExitCode::internal, "", "input and output in memory do not fit");
  if (!same_place(in, out) && overlap(in, out))
    throw Error(ExitCode::usage, "", "the output overlaps the input without being the same");
}

}  // namespace

ImageReport run_image(const MemoryJob& job, const ImageSettings& settings, EvaluatorSource& evaluators,
                      const Notes& notes) {
  check(job);
  MemoryEnds ends(job);
  return run_image(named(job), ends, settings_for(job, settings), evaluators, notes);
}

AngularResolution resolution_in_memory(const ImageSettings& settings, const MemoryJob& job) {
  const OpenImage image = open_memory(job, settings, {}, true);
  return angular_resolution(settings.viewing, *image.source, image.layout);
}

std::optional<ColourSpace> new_space_in_memory(const ImageSettings& settings) {
  std::byte none[12] = {};
  MemoryJob job;
  job.in = {none, 1, 1, 3, 12, 12, 4, SampleType::float32};
  job.header.data = job.header.display = {0, 0, 1, 1};
  const ImageLayout layout = open_memory(job, settings, {}, true).layout;
  if (settings.config.same(layout.light.front().space, layout.output_space)) return std::nullopt;
  return layout.output_space;
}

SceneReport read_scene(const MemoryJob& job, const ImageSettings& settings, Statistics wanted,
                       const Notes& notes) {
  OpenImage image = open_memory(job, settings, notes, false);
  return read_scene(image, named(job), settings_for(job, settings), wanted, notes);
}

}  // namespace scotopic
