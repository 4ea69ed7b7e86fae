// scotopic time: what accuracy costs.
#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "batch/batch.h"
#include "looks/verify/contenders.h"
#include "options/image_options.h"
#include "options/operator_options.h"
#include "cli/program.h"
#include "pipeline/apply_image.h"
#include "pipeline/scene/scene_numbers.h"
#include "options/spectral_options.h"
#include "report/time_report.h"
#include "options/values.h"
#include "pipeline/rows/light_rows.h"

namespace scotopic {
namespace {

constexpr std::size_t frame_width = 3840, frame_height = 2160;
constexpr std::size_t colours_compared = 100000;

struct TimeOptions {
  std::string input;
  std::string pixels = "8294400";
  std::string rounds = "7";
  bool csv = false;
  OperatorOptions appearance;
  ImageOptions image;
  CommonOptions common;
};

/// What evaluators are timed on, and compared over.
struct Subject {
  AppearanceParameters parameters;
  TimedPicture picture;
  Colours colours;
  TimeConditions conditions;
};

TimedPicture read_picture(PixelSource& source, const ImageLayout& layout, const ColourConfig& config) {
  TimedPicture out;
  each_light_row(source, layout, config, [&](const LightRow& row) {
    out.width = row.r.size();
    out.pixels.r.insert(out.pixels.r.end(), row.r.begin(), row.r.end());
    out.pixels.g.insert(out.pixels.g.end(), row.g.begin(), row.g.end());
    out.pixels.b.insert(out.pixels.b.end(), row.b.begin(), row.b.end());
  });
  return out;
}

/// Finite pixels, evenly spread, no more than colours_compared.
Colours colours_of(const Colours& pixels) {
  Colours out;
  const std::size_t step = (pixels.size() + colours_compared - 1) / colours_compared;
  for (std::size_t i = 0; i < pixels.size(); i += step) {
    if (!std::isfinite(pixels.r[i] + pixels.g[i] + pixels.b[i])) continue;
    out.r.push_back(pixels.r[i]);
    out.g.push_back(pixels.g[i]);
    out.b.push_back(pixels.b[i]);
  }
  return out;
}

Subject subject_by_formula(const OperatorChoice& choice) {
  Subject out;
  const AppearanceParameters p = parameters_of(choice, choice.adaptation.value_or(0.1));
  out.picture = night_picture(frame_width, frame_height, p);
  out.colours = stop_colours(colours_compared, p.xyz_from_rgb, p.xyz_from_rgb);
  out.conditions.picture = fmt::format("a night by formula, adaptation {:g} cd/m2", p.adaptation);
  out.conditions.colours = fmt::format("{} colours of the working gamut, 28 stops", out.colours.size());
  out.parameters = p;
  return out;
}

Subject subject_of_image(const TimeOptions& options, const OperatorChoice& choice, const ColourConfig& config,
                         const Console& console) {
  const std::unique_ptr<PixelSource> source = open_source(options.input, options.image.limits);
  const ImageLayout layout = read_layout(*source, config, parse(options.image));
  const Window& w = source->subimages()[layout.light.front().index].data;
  check_limit(source->file(), "bytes of memory planned", 12 * std::int64_t{w.width()} * w.height(),
              options.image.limits.memory, "--max-memory");
  const KnownNumbers known = known_numbers(choice, *source, layout, console.notes());
  double log_average = 0;
  if (needs_measurement(known, source->file()))
    log_average = metered(measure_image(*source, layout, config, choice.parameters, choice.metering.region),
                          choice.metering);
  const SceneNumbers numbers = resolve_numbers(known, log_average, source->file());
  console.note(source->file() + ": " + describe(numbers));
  Subject out;
  out.parameters = parameters_of(choice, numbers.adaptation, numbers.white_luminance);
  out.picture = read_picture(*source, layout, config);
  out.colours = colours_of(out.picture.pixels);
  out.conditions.picture = fmt::format("{}, adaptation {:.3g} cd/m2", options.input, numbers.adaptation);
  out.conditions.colours = fmt::format("{} of its pixels", out.colours.size());
  out.conditions.outside_ap1 = outside_ap1(out.colours, out.parameters.xyz_from_rgb);
  return out;
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

double system_load() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

/// A line that is written over, on a terminal.
std::function<void(int, int)> progress_line(const TimeOptions& options) {
  if (isatty(STDERR_FILENO) == 0 || options.common.quiet || options.common.json) return nullptr;
  return [](int round, int rounds) {
    std::fputs(round < rounds ? fmt::format("\rround {} of {} ", round + 1, rounds).c_str() : "\r\x1b[K",
               stderr);
  };
}

int run_time(const TimeOptions& options) {
  const Console console(options.common);
  OperatorChoice choice = parse(options.appearance);
  const auto pixels = static_cast<std::size_t>(
      number_in("--pixels", options.pixels, 1 << 16, 1 << 28, "a count of 65536 to 268435456"));
  const auto rounds =
      static_cast<int>(number_in("--rounds", options.rounds, 1, 1000, "a count of 1 to 1000"));
  const ColourConfig config = config_in_force(options.image);
  set_primaries(choice, config);
  set_threads(options.common.threads);
  // A picture to restore from, and four at work.
  check_limit("", "bytes of memory planned", static_cast<std::int64_t>(pixels) * 5 * 12,
              options.image.limits.memory, "--max-memory");
  Subject subject =
      options.input.empty() ? subject_by_formula(choice) : subject_of_image(options, choice, config, console);
  const TimedPicture picture = repeated(subject.picture, pixels);
  const int threads = options.common.threads > 0
                          ? options.common.threads
                          : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));

  std::vector<Contender> contenders =
      operator_contenders(subject.parameters, picture, subject.colours, threads);
  for (auto& more :
       {spectral_contenders(subject.parameters), acuity_contenders(subject.parameters, subject.picture)})
    contenders.insert(contenders.end(), more.begin(), more.end());

  TimeConditions& c = subject.conditions;
  c.machine = fmt::format("{}, {}", processor_name(), simd_target());
  c.ocio = OCIO_NAMESPACE::GetVersion();
  c.pixels = picture.pixels.size();
  c.rounds = rounds;
  const std::vector<EvaluatorRow> rows =
      time_contenders(contenders, c.pixels, rounds, progress_line(options));
  c.load = system_load();
  if (options.csv)
    std::fputs(time_csv(rows).c_str(), stdout);
  else if (!console.json())
    std::fputs(time_text(rows, c).c_str(), stdout);
  console.result(time_json(rows, c));
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_time(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<TimeOptions>();
  CLI::App& verb =
      *program.add_subcommand("time", "What accuracy costs: every way to compute, its error and its time");
  verb.footer("Example: scotopic time night.exr --adaptation 0.05 --csv > cost.csv");
  verb.add_option("input", options->input,
                  "Image to time on; else a night by formula, adaptation 0.1 unless given")
      ->type_name("IN");
  verb.add_option("--pixels", options->pixels, "Times are taken on so many, the image repeated")
      ->check(whole_number(1, 1 << 30))
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--rounds", options->rounds, "Each way in turn, so often; medians are shown")
      ->check(whole_number(1, 10000))
      ->type_name("N")
      ->capture_default_str();
  CLI::Option* const csv =
      verb.add_flag("--csv", options->csv, "Comma-separated values in place of the table");
  add_operator_options(verb, options->appearance);
  add_input_options(verb, options->image);
  add_common_options(verb, options->common);
  csv->excludes(verb.get_option("--json"));
  on_command_line(verb, invocation, options, run_time);
}

}  // namespace scotopic
