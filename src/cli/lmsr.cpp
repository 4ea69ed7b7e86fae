// scotopic lmsr: an image as the signals of cones and rods.
#include <fmt/format.h>

#include "cli/image_options.h"
#include "cli/program.h"
#include "cli/spectral_options.h"
#include "cli/values.h"
#include "image/lmsr_image.h"

namespace scotopic {
namespace {

constexpr const char* receptor_set = "Stockman & Sharpe 2000 2 degree cones, CIE 1951 rods";

struct LmsrOptions {
  std::string input;
  std::string output;
  std::string illuminant = "d65";
  std::string rods = "linear";
  std::string accumulation = "double";
  std::string white_luminance;
  BandOptions bands;
  ImageOptions image;
  CommonOptions common;
};

struct Unit {
  std::optional<double> cdm2;
  std::string source = "unknown: values are relative";
};

/// cd/m2 that a signal of 1 stands for.
Unit unit_of(const LmsrOptions& options, const Picture& picture, ColourChannels::Kind kind) {
  using Kind = ColourChannels::Kind;
  if (!options.white_luminance.empty())
    return {luminance_value("--white-luminance", options.white_luminance), "--white-luminance"};
  if (kind == Kind::lmsr && picture.lmsr_unit) return {picture.lmsr_unit, "the file's scotopic:lmsrUnit"};
  if (picture.white_luminance)
    return {picture.white_luminance,
            kind == Kind::computed ? "spectral radiance is absolute" : "the file's whiteLuminance"};
  return {};
}

std::vector<Attribute> stamps_of(const Unit& unit, const std::string& rods) {
  std::vector<Attribute> stamps = {{"scotopic:version", std::string(SCOTOPIC_VERSION)},
                                   {"scotopic:receptors", std::string(receptor_set)},
                                   {"scotopic:rods", rods}};
  if (unit.cdm2) {
    stamps.push_back({"scotopic:lmsrUnit", *unit.cdm2});
    stamps.push_back({"whiteLuminance", *unit.cdm2});
  }
  return stamps;
}

int run_lmsr(const LmsrOptions& options) {
  const Console console(options.common);
  const IlluminantChoice illuminant = understand_illuminant(options.illuminant);
  RodChoice rods;
  rods.estimate = choice<RodEstimate>(
      "--rods", options.rods, {{"linear", RodEstimate::linear}, {"quadratic", RodEstimate::quadratic}});
  rods.sp_ratio = illuminant.sp_ratio;
  SpectralOptions spectral = understand(options.bands, illuminant, options.image.layer);
  spectral.accumulation = choice<Accumulation>(
      "--precision", options.accumulation, {{"double", Accumulation::dual}, {"float", Accumulation::single}});
  spectral.xyz = false;
  const ImageRequest request = understand(options.image);
  if (!options.white_luminance.empty()) (void)luminance_value("--white-luminance", options.white_luminance);
  if (output_format(options.output) != "openexr")
    throw Error(ExitCode::usage, options.output, "receptor signals are written as OpenEXR only");
  const ColourConfig config = ColourConfig::in_force(options.image.config, options.image.limits);
  check_spaces(request, config);
  set_threads(options.common.threads);
  OutputFile file(options.output);
  const std::unique_ptr<PixelSource> source =
      open_input(options.input, spectral, options.image.limits, console);
  ImageLayout layout = plan_layout(*source, options.output, config, request);
  make_lmsr_layout(layout, options.output);

  const LightPicture& light = layout.light.front();
  const bool estimated =
      light.channels.kind == ColourChannels::Kind::rgb || light.channels.kind == ColourChannels::Kind::grey;
  const std::string rods_from =
      estimated ? fmt::format("{} estimate from colour, S/P {:.4g}", options.rods, rods.sp_ratio)
                : std::string("from the file's spectra or signals");
  const Unit unit = unit_of(options, source->pictures()[light.index], light.channels.kind);
  for (const std::string& note : layout.notes) console.note(source->file() + ": " + note);
  console.note(
      unit.cdm2 ? fmt::format("{}: signal 1 is {:.4g} cd/m2 ({}); rods {}", source->file(), *unit.cdm2,
                              unit.source, rods_from)
                : fmt::format("{}: cd/m2 of signal 1 {}; rods {}", source->file(), unit.source, rods_from));
  set_stamps(layout, stamps_of(unit, rods_from));
  write_lmsr(*source, layout, config, rods, file);

  nlohmann::ordered_json result = {{"input", options.input}, {"output", options.output}};
  result["lmsrUnit"] = unit.cdm2 ? nlohmann::ordered_json(*unit.cdm2) : nlohmann::ordered_json(nullptr);
  result["lmsrUnitSource"] = unit.source;
  result["rods"] = rods_from;
  result["spectral"] = spectral_report(*source);
  console.result(result);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_lmsr(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<LmsrOptions>();
  CLI::App& verb = *program.add_subcommand("lmsr", "An image as the signals of cones and rods");
  verb.footer("Example: scotopic lmsr spectral.exr -o lmsr.exr -d half");
  verb.add_option("input", options->input,
                  "Spectral EXR, a pattern like night_%d.exr (nm), or any image in colour")
      ->required()
      ->type_name("IN");
  verb.add_option("-o,--output", options->output, "EXR with channels L, M, S, R")
      ->required()
      ->type_name("OUT");
  verb.add_option("-d", options->image.type, "Type of the signals: half, float; else the input's")
      ->type_name("TYPE");
  verb.add_option("--white-luminance", options->white_luminance,
                  "What image value 1 stands for; overrides the file")
      ->type_name("CDM2");
  verb.add_option("--illuminant", options->illuminant,
                  "Lights reflectance; its S/P ratio tells rods from colour")
      ->type_name("NAME|S/P|FILE");
  verb.add_option("--rods", options->rods, "Rods from colour: linear (default) or quadratic")
      ->type_name("NAME");
  verb.add_option("--precision", options->accumulation, "Sums over bands in double (default) or float")
      ->type_name("NAME");
  add_band_options(verb, options->bands);
  add_input_options(verb, options->image);
  add_common_options(verb, options->common);
  on_command_line(verb, invocation, options, run_lmsr);
}

}  // namespace scotopic
