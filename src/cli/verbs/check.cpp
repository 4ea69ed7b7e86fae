// scotopic check: bakes held to the operator again, on test colours or on an image.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "cli/program.h"
#include "looks/config/manifest.h"
#include "looks/lut/shipped_looks.h"
#include "looks/verify/inspect.h"
#include "options/image_options.h"
#include "options/values.h"
#include "pipeline/rows/light_rows.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

struct CheckOptions {
  std::string bake;
  std::string look;
  std::string picture;
  std::string max_error;
  ImageOptions image;
  CommonOptions common;
};

struct OnImage {
  BakeError error;
  std::string where;  ///< the worst pixel
};

/// The look on every pixel of an image with light against the operator on it.
OnImage compare_on_image(const CheckOptions& o, const ColourConfig& config, const LookSpec& spec,
                         const OCIO_NAMESPACE::ConstCPUProcessorRcPtr& processor) {
  const std::unique_ptr<PixelSource> source = open_source(o.picture, o.image.limits);
  const ImageLayout layout = read_layout(*source, config, parse(o.image));
  Comparison comparison(spec.parameters.xyz_from_rgb);
  std::size_t width = 0;
  each_light_row(*source, layout, config, [&](const LightRow& row) {
    const Colours in{row.r, row.g, row.b};
    Colours got = in;
    apply(processor, got);
    comparison.add(in, exact(spec.parameters, seen_under(spec.lamp, spec.parameters, in)), got);
    width = in.size();
  });
  source->require_unchanged();
  const BakeError error = comparison.result();
  return {error, fmt::format(", pixel {} {}", error.worst_index % width, error.worst_index / width)};
}

nlohmann::ordered_json json_of(const Inspected& it) {
  nlohmann::ordered_json out = {{"name", it.name}, {"file", it.file}};
  if (it.error)
    out["error"] = {{"mean", it.error->mean},
                    {"p99", it.error->p99},
                    {"max", it.error->max},
                    {"worst", it.error->worst},
                    {"expected", it.error->expected},
                    {"got", it.error->got},
                    {"samples", it.error->samples},
                    {"outsideAp1", it.error->outside},
                    {"outsideAp1Max", it.error->outside_max}};
  if (it.stated) out["statedMax"] = *it.stated;
  if (it.spec) out["domain"] = it.spec->encoded ? "encoded 0 to 1" : "linear, -65504 to 65504";
  out["oddPixels"] = {{"tested", it.odd.tested}, {"notFinite", it.odd.not_finite}};
  out["problems"] = it.problems;
  return out;
}

/// One line for a look, on stdout: it is what was asked for.
void say(const Inspected& it, const std::string& where) {
  std::string line = it.name;
  if (it.error)
    line += fmt::format(
        ": {}; worst at ({:.4g}, {:.4g}, {:.4g}): ({:.4g}, {:.4g}, {:.4g}) for ({:.4g}, {:.4g}, {:.4g}){}",
        error_text(*it.error), it.error->worst[0], it.error->worst[1], it.error->worst[2], it.error->got[0],
        it.error->got[1], it.error->got[2], it.error->expected[0], it.error->expected[1],
        it.error->expected[2], where);
  if (it.error && it.error->outside > 0)
    line += fmt::format("; besides, {} pixels outside AP1, clamped to its border, max {:.3g}",
                        it.error->outside, it.error->outside_max);
  if (it.spec) line += it.spec->encoded ? "; domain 0 to 1, encoded" : "; domain -65504 to 65504, linear";
  if (it.odd.tested > 0)
    line += fmt::format("; {} odd pixels, {} not finite", it.odd.tested, it.odd.not_finite);
  if (it.cube)
    for (const std::string& figures : error_lines(*it.cube, *it.spec)) line += "\n  " + figures;
  if (!it.error && it.problems.empty()) line += ": sound";  // what has no figures
  for (const std::string& problem : it.problems) line += "\n  FAILED: " + problem;
  std::fputs((line + "\n").c_str(), stdout);
}

std::vector<Inspected> inspect(const CheckOptions& o, const ColourConfig& config, bool is_config) {
  if (!is_config) return {inspect_lut(o.bake, config)};
  std::vector<Inspected> all = inspect_config(config, o.look);
  if (all.empty())
    throw Error(ExitCode::config, o.bake, "has no look that says which operator it was baked from");
  return all;
}

/// A manifest is checked wherever the LUTs have one.
void inspect_manifests(std::vector<Inspected>& all) {
  std::vector<std::string> folders;
  for (const Inspected& it : all) {
    const std::string folder = fs::path(it.file).parent_path().string();
    if (std::find(folders.begin(), folders.end(), folder) == folders.end()) folders.push_back(folder);
  }
  for (const std::string& folder : folders) {
    if (!fs::exists(fs::path(folder) / "MANIFEST")) continue;
    Inspected it;
    it.name = folder + "/MANIFEST";
    it.problems = manifest_problems(folder);
    all.push_back(std::move(it));
  }
}

void check_usage(const CheckOptions& o, bool is_config) {
  if (!is_config && !o.look.empty())
    throw Error(ExitCode::usage, o.bake, "is a LUT: it has no looks to choose from");
  if (is_config && !o.picture.empty() && o.look.empty())
    throw Error(ExitCode::usage, "", "--image needs the name of one look");
}

/// Puts the error on an image in place of that on test colours; says which pixel is worst.
std::string inspect_on_image(const CheckOptions& o, const ColourConfig& config, bool is_config,
                             Inspected& it) {
  if (!it.spec || it.spec->encoded)
    throw Error(ExitCode::config, o.bake,
                "'" + it.name + "' is no look on linear light that says its operator");
  const auto processor = is_config ? look_processor(config, o.look) : lut_processor(o.bake);
  const OnImage on_image = compare_on_image(o, config, *it.spec, processor);
  it.error = on_image.error;
  it.name += " on " + o.picture;
  return on_image.where;
}

int run_check(const CheckOptions& o) {
  const Console console(o.common);
  const bool is_config = fs::path(o.bake).extension() == ".ocio";
  std::optional<double> limit;
  if (!o.max_error.empty())
    limit = number_in("--max-error", o.max_error, 0, 1000, "a CIEDE2000 from 0 to 1000");
  check_usage(o, is_config);
  const ColourConfig config = is_config ? config_at(o.bake, o.image) : config_in_force(o.image);
  std::vector<Inspected> all = inspect(o, config, is_config);
  std::string where;
  if (!o.picture.empty())
    where = inspect_on_image(o, config, is_config, all.front());
  else if (is_config && o.look.empty())
    inspect_manifests(all);
  bool sound = true;
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  for (Inspected& it : all) {
    if (limit && it.error && it.error->max > *limit)
      it.problems.push_back(fmt::format("largest error {:.3g} exceeds {:.3g}", it.error->max, *limit));
    sound &= it.problems.empty();
    results.push_back(json_of(it));
    if (!console.json() && !o.common.quiet) say(it, where);
  }
  console.result({{"checked", results}, {"sound", sound}});
  return static_cast<int>(sound ? ExitCode::done : ExitCode::check_failed);
}

}  // namespace

void add_check(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<CheckOptions>();
  CheckOptions& o = *options;
  CLI::App& verb =
      *program.add_subcommand("check", "Measure baked looks against the operator; exit code 1 if one fails");
  verb.footer(
      "Examples:\n"
      "  scotopic check ocio_config/config.ocio\n"
      "  scotopic check street.clf --max-error 1\n"
      "  scotopic check ocio_config/config.ocio \"Mesopic 0.1 nit (street lighting)\" --image night.exr");
  const TextOptions add{verb};
  add("bake", o.bake, "A config (.ocio), or a LUT that scotopic bake made", "CONFIG|LUT")->required();
  add("look", o.look, "One look of the config; else all", "LOOK");
  add("--image", o.picture, "Compare on this image's pixels instead of test colours", "FILE");
  add("--max-error", o.max_error, "Fail if the largest error exceeds this", "DE00");
  add_input_options(verb, o.image);
  add_common_options(verb, o.common);
  on_command_line(verb, invocation, options, run_check);
}

}  // namespace scotopic
