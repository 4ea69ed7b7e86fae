// What is installed of the operator (scotopic/operator.h), over what hosts use here.
#include "report/scene_json.h"
#include "host/operator.h"
#include "pipeline/rows/threads.h"
#include "scotopic/operator.h"

namespace scotopic {
namespace {

MemoryJob job_of(const Frame& frame) {
  MemoryJob job;
  job.in = frame.in;
  job.out = frame.out;
  job.header.data = job.header.display = job.window = {0, 0, frame.in.width, frame.in.height};
  job.header.straight = frame.straight;
  job.header.pixel_aspect = frame.pixel_aspect;
  job.frame = frame.frame;
  return job;
}

Plan plan_of_scene(const SceneReport& scene) {
  Plan out;
  out.adaptation = scene.numbers.adaptation;
  out.white_luminance = scene.numbers.white_luminance;
  out.adaptation_source = scene.numbers.adaptation_source;
  out.white_luminance_source = scene.numbers.white_luminance_source;
  for (const EffectDecision& d : scene.plan.effects)
    out.stages.push_back({std::string(d.effect), d.asked, d.needed, d.runs(), d.number, d.threshold,
                          std::string(d.unit), d.reason, d.share});
  return out;
}

}  // namespace

Operator::Operator(const Parameters& parameters) : host_(std::make_shared<const HostOperator>(parameters)) {}

Plan Operator::apply(const Frame& frame, const NoteSink& note) const {
  return plan_of_scene(host_->apply(job_of(frame), {note, nullptr}).scene);
}

Plan Operator::plan(const Frame& frame) const { return plan_of_scene(host_->plan(job_of(frame), {})); }

std::string Operator::explain(const Frame& frame) const { return host_->explain(job_of(frame), {}).dump(); }

void Operator::bake(const std::string& path, int nodes) const {
  (void)host_->bake(path, std::to_string(nodes), "", {});
}

std::string Operator::shader(const std::string& language) const { return host_->shader(language); }

void use_threads(int count) { set_threads(count); }

}  // namespace scotopic
