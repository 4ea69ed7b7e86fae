// scotopic explain: what light a scene holds, and what it calls for.
#include <fmt/format.h>

#include <cstdio>

#include "adaptation/named_adaptations.h"
#include "cli/verbs/explain_config.h"
#include "cli/verbs/explain_frames.h"
#include "report/explain_report.h"
#include "report/scene_json.h"
#include "report/image_report.h"
#include "cli/program.h"
#include "options/scene/scene_settings.h"
#include "pipeline/run.h"

namespace scotopic {
namespace {

struct ExplainOptions {
  std::string input;
  SceneOptions scene;
  FrameOptions frames;
  bool csv = false;
  bool adaptations = false;
  CommonOptions common;
};

void print(const LightNumbers& light, const SceneNumbers& numbers, const SceneStatistics& statistics,
           const ScenePlan& plan, const std::vector<double>& costs) {
  fmt::print("{}\n", describe(numbers));
  fmt::print("photopic luminance   {:.4g} cd/m2 log-average, {:.4g} mean, {:.4g} to {:.4g}\n",
             light.log_average, light.mean, light.least, light.greatest);
  fmt::print("scotopic luminance   {:.4g} cd/m2 mean\n", light.scotopic_mean);
  fmt::print("S/P ratio            {:.4g}\n", light.sp_ratio);
  fmt::print("mesopic luminance    {:.4g} cd/m2 of the mean, coefficient m {:.4g} (1 photopic, 0 scotopic)\n",
             light.mesopic, light.m);
  fmt::print("\n{}\n{}", luminance_text(statistics, numbers.white_luminance), effects_text(plan, costs));
}

bool is_config(const std::string& file) { return file.size() > 5 && file.rfind(".ocio") == file.size() - 5; }

int run_explain_config(const ExplainOptions& options, const Console& console) {
  nlohmann::ordered_json looks = nlohmann::ordered_json::array();
  for (const ExplainedLook& look : explain_looks(config_at(options.input, options.scene.image))) {
    if (!console.json()) fmt::print("{}\n  does {}\n", look.name, look.does);
    if (!console.json() && !look.description.empty()) fmt::print("  {}\n", look.description);
    looks.push_back({{"name", look.name}, {"does", look.does}, {"description", look.description}});
  }
  console.result({{"input", options.input}, {"looks", looks}});
  return static_cast<int>(ExitCode::done);
}

int run_explain_image(const ExplainOptions& options, const ImageSettings& settings, const Console& console) {
  ImageJob job;
  job.input = options.input;
  const SceneReport scene = read_scene(job, settings, Statistics::of_all_pixels, console.notes());
  const SceneStatistics& statistics = *scene.statistics;
  const SceneNumbers& numbers = scene.numbers;
  const std::vector<double> costs = measure_costs(scene.asked, scene.plan, statistics);
  const LightNumbers light = light_of(statistics, numbers);
  if (options.csv)
    std::fputs(luminance_csv(statistics, numbers.white_luminance).c_str(), stdout);
  else if (!console.json())
    print(light, numbers, statistics, scene.plan, costs);
  if (const std::string advice = unit_advice(statistics, numbers.adaptation, numbers.white_luminance);
      !advice.empty())
    console.note(options.input + ": " + advice);
  tell_non_finite(scene.non_finite, options.input, "in none of these numbers", console);
  console.result(explain_json(options.input, light, scene, costs));
  return static_cast<int>(ExitCode::done);
}

int list_adaptations(const Console& console) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const NamedAdaptation& step : named_adaptations) {
    if (!console.json()) fmt::print("{:<10} {:>6g} cd/m2  {}\n", step.name, step.adaptation, step.scene);
    all.push_back({{"name", step.name}, {"adaptation", step.adaptation}, {"scene", step.scene}});
  }
  console.result({{"adaptations", all}});
  return static_cast<int>(ExitCode::done);
}

int run_explain(const ExplainOptions& options) {
  const Console console(options.common);
  if (options.adaptations) return list_adaptations(console);
  if (options.input.empty()) throw Error(ExitCode::usage, "", "IN is required: an image, or an OCIO config");
  if (is_config(options.input)) return run_explain_config(options, console);
  const std::vector<Frame> frames = frames_of(options.frames, options.input, "");
  ImageSettings settings = parse(options.scene);
  settings.sequence = frames.front().number.has_value();
  settings.measure = !settings.sequence;
  add_stages(settings);
  set_threads(options.common.threads);
  check_places(frames, options.frames);
  if (!frames.front().number) return run_explain_image(options, settings, console);
  const FramesTable table = options.csv      ? FramesTable::csv
                            : console.json() ? FramesTable::none
                                             : FramesTable::bars;
  return explain_frames(settings, frames, options.frames, table, console);
}

}  // namespace

void add_explain(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App& verb = *program.add_subcommand("explain", "What light a scene holds, and what it calls for");
  verb.footer(
      "Examples:\n"
      "  scotopic explain night.exr --white-luminance 10\n"
      "  scotopic explain in.####.exr --frames 1-240 --white-luminance 10 --csv > shot.csv\n"
      "  scotopic explain ocio_config/config.ocio");
  verb.add_option("input", options->input, "As for apply; or an OCIO config (.ocio): what its looks do")
      ->type_name("IN|CONFIG");
  verb.add_flag("--adaptations", options->adaptations, "List the names that --adaptation takes");
  options->scene.appearance.stages.table = invocation.stages;
  add_scene_options(verb, options->scene);
  add_reading_frame_options(verb, options->frames);
  add_band_options(verb, options->scene.bands);
  add_input_options(verb, options->scene.image);
  add_layers_option(verb, options->scene.image,
                    "Several of them, looked at as apply does; RGB: the topmost. Adaptation is the beauty's");
  CLI::Option* const csv =
      verb.add_flag("--csv", options->csv,
                    "The luminance histogram, or a sequence's adaptation, as comma-separated values");
  add_common_options(verb, options->common);
  csv->excludes(verb.get_option("--json"));
  on_command_line(verb, invocation, options, run_explain);
}

}  // namespace scotopic
