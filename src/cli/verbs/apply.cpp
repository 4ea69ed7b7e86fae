// scotopic apply: an image as the dark-adapted eye sees it.
#include <fmt/format.h>

#include "report/image_report.h"
#include "cli/program.h"
#include "cli/sequence/provenance.h"
#include "cli/sequence/run_frames.h"
#include "options/scene/apply_settings.h"
#include "cli/sequence/shot_adaptation.h"
#include "pipeline/run.h"
#include "pipeline/stages/display_stages.h"

namespace scotopic {
namespace {

struct ApplyWords {
  std::string input;
  std::string output;
  ApplyOptions stages;
  std::string adaptation_from;
  FrameOptions frames;
  CommonOptions common;
};

class ApplyJob : public FrameJob {
 public:
  ApplyJob(const ApplyOptions& options, bool sequence, const Console& console);

  ImageSettings& scene() { return settings_; }
  void follow(std::optional<AdaptationTrack> track) { track_ = std::move(track); }
  /// Whether the tone map of each image follows that image.
  bool measures_display() const { return settings_.display.tone && !settings_.display.range; }
  std::string settings() const override;
  const Limits& limits() const override { return settings_.limits; }
  nlohmann::ordered_json run(const ImageJob& job, const Console& console) override;

 private:
  std::unique_ptr<EvaluatorSource> evaluators_;
  ImageSettings settings_;
  std::optional<AdaptationTrack> track_;
};

ApplyJob::ApplyJob(const ApplyOptions& o, bool sequence, const Console& console)
    : evaluators_(parse(o.precision)), settings_(parse(o)) {
  settings_.sequence = sequence;
  check_view(settings_.request, settings_.config, console.notes());
  if (const std::string idle = without_effect(o.scene.appearance, settings_.choice); !idle.empty())
    console.note("without effect under --model safko2019: " + idle);
}

std::string ApplyJob::settings() const {
  const std::optional<double>& adaptation = settings_.choice.adaptation;
  return colour_identity(settings_.config) + (adaptation ? fmt::format(" {:a}", *adaptation) : "") +
         (track_ ? track_->identity() : "");
}

nlohmann::ordered_json ApplyJob::run(const ImageJob& asked, const Console& console) {
  ImageJob job = asked;
  if (track_) job.adaptation = track_->at(job.moment.frame);
  const ImageReport report = run_image(job, settings_, *evaluators_, console.notes());
  tell_non_finite(
      report.non_finite, job.input,
      settings_.non_finite == NonFinite::clean ? "cleaned" : "passed on without the operator (--nonfinite)",
      console);
  return image_json(report);
}

int run_apply(const ApplyWords& options) {
  const Console console(options.common);
  (void)output_format(options.output);
  const std::vector<Frame> frames = frames_of(options.frames, options.input, options.output);
  ApplyJob job(options.stages, !options.frames.frames.empty(), console);
  set_threads(options.common.threads);
  check_shot_adaptation(options.adaptation_from, job.scene().choice, frames);
  check_places(frames, options.frames);
  job.follow(resolve_shot_adaptation(options.adaptation_from, job.scene(), frames, options.frames, console));
  if (frames.size() > 1 && job.measures_display())
    console.note(
        "each frame's range is mapped to the display by itself, which can flicker: --display-range holds "
        "one");
  return run_frames("apply", job, frames, options.frames, console);
}

}  // namespace

void add_apply(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<ApplyWords>();
  CLI::App& verb = *program.add_subcommand("apply", "An image as the dark-adapted eye sees it");
  verb.footer(
      "Examples:\n"
      "  scotopic apply night.exr -o seen.exr --adaptation 0.05\n"
      "  scotopic apply in.####.exr -o seen.####.exr --frames 1-240 --adaptation-from frames "
      "--white-luminance 5");
  verb.add_option("input", options->input, "EXR, TIFF, PNG, JPEG or HDR: RGB, L, M, S, R, or spectral bands")
      ->required()
      ->type_name("IN");
  verb.add_option("-o,--output", options->output, "EXR, TIFF, PNG or JPEG, by its extension")
      ->required()
      ->type_name("OUT");
  SceneOptions& scene = options->stages.scene;
  scene.appearance.stages.table = invocation.stages;
  add_scene_options(verb, scene);
  add_adaptation_from_option(verb, options->adaptation_from);
  add_frame_options(verb, options->frames);
  add_apply_options(verb, options->stages);
  add_input_options(verb, scene.image);
  add_layers_option(verb, scene.image,
                    "Several of them, treated alike; RGB: the topmost. Adaptation is the beauty's");
  add_output_options(verb, scene.image);
  add_icc_options(verb, options->stages.icc);
  add_common_options(verb, options->common);
  on_command_line(verb, invocation, options, run_apply);
}

}  // namespace scotopic
