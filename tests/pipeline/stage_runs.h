// A stage on a whole image: what the tests of stages share.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "color/colour_config.h"
#include "pipeline/run.h"
#include "support/exr_files.h"

namespace scotopic::test {

inline TestPart picture(int width = 300, int height = 83) {
  TestPart part;
  part.finite = true;
  part.data = part.display = {0, 0, width, height};
  for (const char* name : {"R", "G", "B"}) part.channels.push_back({name, PixelType::float32});
  return part;
}

inline ImageSettings settings(double adaptation, const std::string& effects) {
  ImageSettings s(ColourConfig::own());
  s.choice.adaptation = adaptation;
  s.choice.white_luminance = adaptation / 0.18;
  s.choice.plan_effects = effects == "auto";
  s.choice.stages.set_effects(effects);
  s.choice.stages.set_pixel_stages(s.choice.parameters);
  s.viewing.pixels_per_degree = 30;
  set_primaries(s.choice, s.config);
  return s;
}

inline ImageReport run(const std::string& in, const std::string& out, ImageSettings s, int frame = 0) {
  add_stages(s);
  ImageJob job;
  job.input = in;
  job.output = out;
  job.moment.frame = frame;
  ExactEvaluators evaluators;
  return run_image(job, s, evaluators, {});
}

inline std::vector<std::uint32_t> bits(const std::string& file) { return read_bits(file, 0, 0, 0, "G"); }

}  // namespace scotopic::test
