// scotopic lmsr: an image as the signals of cones and rods.
#include <fmt/format.h>

#include "options/image_options.h"
#include "report/image_report.h"
#include "cli/program.h"
#include "cli/sequence/provenance.h"
#include "cli/sequence/run_frames.h"
#include "options/spectral_options.h"
#include "options/values.h"
#include "pipeline/lmsr_image.h"
#include "pipeline/scene/open_image.h"
#include "pipeline/scene/stamps.h"

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
  FrameOptions frames;
  CommonOptions common;
};

struct Unit {
  std::optional<double> cdm2;
  std::string source = "unknown: values are relative";
};

std::vector<Attribute> stamps_of(const Unit& unit, const std::string& rods, const std::string& provenance) {
  std::vector<Attribute> stamps = {{"scotopic:version", std::string(SCOTOPIC_VERSION)},
                                   {"scotopic:receptors", std::string(receptor_set)},
                                   {"scotopic:rods", rods}};
  if (unit.cdm2) {
    stamps.push_back({"scotopic:lmsrUnit", *unit.cdm2});
    stamps.push_back({"whiteLuminance", *unit.cdm2});
  }
  if (!provenance.empty()) stamps.push_back({provenance_attribute, provenance});
  return stamps;
}

RodChoice resolve_rods(const LmsrOptions& o, const IlluminantChoice& illuminant) {
  return {choice<RodEstimate>("--rods", o.rods,
                              {{"linear", RodEstimate::linear}, {"quadratic", RodEstimate::quadratic}}),
          illuminant.sp_ratio};
}

SpectralOptions resolve_spectral(const LmsrOptions& o, const IlluminantChoice& illuminant) {
  SpectralOptions out = parse(o.bands, illuminant, o.image.layer);
  out.accumulation = choice<Accumulation>("--precision", o.accumulation,
                                          {{"double", Accumulation::dual}, {"float", Accumulation::single}});
  out.xyz = false;
  return out;
}

std::optional<double> resolve_unit(const LmsrOptions& o) {
  if (o.white_luminance.empty()) return std::nullopt;
  return luminance_value("--white-luminance", o.white_luminance);
}

void check_output(const std::string& output) {
  if (output_format(output) != "openexr")
    throw Error(ExitCode::usage, output, "receptor signals are written as OpenEXR only");
}

/// What is the same for every image, worked out once, in the order in which faults are to be told.
class LmsrJob : public FrameJob {
 public:
  explicit LmsrJob(const LmsrOptions& options);
  std::string settings() const override { return colour_identity(config_); }
  const Limits& limits() const override { return limits_; }
  nlohmann::ordered_json run(const ImageJob& job, const Console& console) override;

 private:
  Unit unit_of(const Subimage& subimage, ColourChannels::Kind kind) const;
  std::string rods_of(ColourChannels::Kind kind) const;

  IlluminantChoice illuminant_;
  RodChoice rods_;
  std::string rods_name_;
  SpectralOptions spectral_;
  ImageRequest request_;
  Limits limits_;
  std::optional<double> white_luminance_;
  ColourConfig config_;
};

LmsrJob::LmsrJob(const LmsrOptions& o)
    : illuminant_(parse_illuminant(o.illuminant)),
      rods_(resolve_rods(o, illuminant_)),
      rods_name_(o.rods),
      spectral_(resolve_spectral(o, illuminant_)),
      request_(parse(o.image)),
      limits_(o.image.limits),
      white_luminance_(resolve_unit(o)),
      config_(config_in_force(o.image)) {
  check_spaces(request_, config_);
}

/// cd/m2 that a signal of 1 stands for.
Unit LmsrJob::unit_of(const Subimage& subimage, ColourChannels::Kind kind) const {
  if (white_luminance_) return {white_luminance_, "--white-luminance"};
  const FileUnit unit = file_unit(subimage, kind);
  return unit.luminance ? Unit{unit.luminance, unit.source} : Unit{};
}

std::string LmsrJob::rods_of(ColourChannels::Kind kind) const {
  using Kind = ColourChannels::Kind;
  if (kind != Kind::rgb && kind != Kind::grey) return "from the file's spectra or signals";
  return fmt::format("{} estimate from colour, S/P {:.4g}", rods_name_, rods_.sp_ratio);
}

nlohmann::ordered_json LmsrJob::run(const ImageJob& job, const Console& console) {
  OutputFile file(job.output);
  const std::unique_ptr<PixelSource> source = open_input(job.input, spectral_, limits_, console.notes());
  ImageLayout layout = plan_layout(*source, job.output, config_, request_);
  make_lmsr_layout(layout, job.output);

  const LightSubimage& light = layout.light.front();
  const std::string rods = rods_of(light.channels.kind);
  const Unit unit = unit_of(source->subimages()[light.index], light.channels.kind);
  for (const std::string& note : layout.notes) console.note(source->file() + ": " + note);
  console.note(unit.cdm2
                   ? fmt::format("{}: signal 1 is {:.4g} cd/m2 ({}); rods {}", source->file(), *unit.cdm2,
                                 unit.source, rods)
                   : fmt::format("{}: cd/m2 of signal 1 {}; rods {}", source->file(), unit.source, rods));
  set_stamps(layout, stamps_of(unit, rods, job.provenance));
  const NonFinitePixels non_finite = write_lmsr(*source, layout, config_, rods_, file, job.progress);

  nlohmann::ordered_json result = {{"input", job.input}, {"output", job.output}};
  result["lmsrUnit"] = unit.cdm2 ? nlohmann::ordered_json(*unit.cdm2) : nlohmann::ordered_json(nullptr);
  result["lmsrUnitSource"] = unit.source;
  result["rods"] = rods;
  result["nonFinite"] = non_finite.count;
  tell_non_finite(non_finite, source->file(), "so are their signals", console);
  result["spectral"] = spectral_json(spectral_report_of(*source));
  return result;
}

int run_lmsr(const LmsrOptions& options) {
  const Console console(options.common);
  check_output(options.output);
  const std::vector<Frame> frames = frames_of(options.frames, options.input, options.output);
  LmsrJob job(options);
  set_threads(options.common.threads);
  check_places(frames, options.frames);
  return run_frames("lmsr", job, frames, options.frames, console);
}

}  // namespace

void add_lmsr(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<LmsrOptions>();
  CLI::App& verb = *program.add_subcommand("lmsr", "An image as the signals of cones and rods");
  verb.footer(
      "Examples:\n"
      "  scotopic lmsr spectral.exr -o lmsr.exr -d half\n"
      "  scotopic lmsr night.####_%d.exr -o lmsr.####.exr --frames 1-24");
  verb.add_option(
          "input", options->input,
          "Spectral EXR, a pattern like night_%d.exr (nm), or any image in colour; a pattern with --frames")
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
  add_frame_options(verb, options->frames);
  add_band_options(verb, options->bands);
  add_input_options(verb, options->image);
  add_layers_option(verb, options->image, "Several of them, treated alike; RGB: the topmost");
  add_common_options(verb, options->common);
  on_command_line(verb, invocation, options, run_lmsr);
}

}  // namespace scotopic
