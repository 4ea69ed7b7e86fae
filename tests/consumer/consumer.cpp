// Uses the installed headers and libraries, and nothing else: an image through the operator, its plan, a
// mistake.
#include <scotopic/controls.h>
#include <scotopic/operator.h>
#include <scotopic/version.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace {

scotopic::MemoryPixels pixels(std::vector<float>& rgb, int width, int height) {
  scotopic::MemoryPixels out;
  out.data = reinterpret_cast<std::byte*>(rgb.data());
  out.width = width;
  out.height = height;
  out.channel_stride = sizeof(float);
  out.pixel_stride = 3 * out.channel_stride;
  out.row_stride = width * out.pixel_stride;
  return out;
}

bool refuses(const scotopic::Parameters& parameters) {
  try {
    const scotopic::Operator made(parameters);
    return false;
  } catch (const scotopic::Error& error) {
    return error.code() == scotopic::ExitCode::usage;
  }
}

}  // namespace

int main() {
  std::vector<float> red(8 * 4 * 3), seen(red.size());
  for (std::size_t i = 0; i < red.size(); i += 3) red[i] = 0.5f;
  scotopic::Frame frame;
  frame.in = pixels(red, 8, 4);
  frame.out = pixels(seen, 8, 4);
  const scotopic::Operator moon({{"adaptation", "moon"}, {"white_luminance", "0.1"}});
  const scotopic::Plan plan = moon.apply(frame);
  std::printf("scotopic %s, %zu controls: red %.4f -> %.4f %.4f %.4f at %g cd/m2\n", SCOTOPIC_VERSION_TEXT,
              scotopic::controls().size(), red[0], seen[0], seen[1], seen[2], plan.adaptation);
  for (const scotopic::PlannedStage& stage : plan.stages)
    std::printf("%-10s %s\n", stage.name.c_str(), stage.runs ? "runs" : "");
  const bool darker = seen[0] < red[0],
             planned = !plan.nothing() && moon.plan(frame).stages.size() == plan.stages.size();
  const bool shader = moon.shader("glsl").size() > 1000,
             explained = moon.explain(frame).find("spRatio") != std::string::npos;
  return darker && planned && shader && explained && refuses({{"adaptation", "-1"}}) &&
                 refuses({{"light", "1"}})
             ? 0
             : 1;
}
