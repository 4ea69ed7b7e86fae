// scotopic bake: the operator as a LUT, as a config of looks, or as looks added to a studio's config.
#include <fmt/format.h>

#include <filesystem>

#include "looks/lut/baked_look.h"
#include "looks/chain/chain_text.h"
#include "looks/config/config_merge.h"
#include "looks/verify/inspect.h"
#include "looks/lut/ladder.h"
#include "looks/lut/look_chain.h"
#include "looks/config/look_set.h"
#include "looks/chain/read_back.h"
#include "cli/options/image_options.h"
#include "cli/options/operator_options.h"
#include "cli/program.h"
#include "cli/options/values.h"
#include "io/atomic/output_set.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

struct BakeOptions {
  OperatorOptions appearance;
  CommonOptions common;
  std::vector<std::string> adaptations;
  std::string output;
  std::string format;
  std::string size = "33";
  std::string colourspace;
  std::string colour_config;
  std::string new_config;
  std::string luts;
  std::string into;
  bool dry_run = false;
  Limits limits;
  std::string beside;
  std::string max_error;
};

enum class Format { clf, ctf, spi3d, cube };

const std::vector<std::pair<std::string, Format>>& formats() {
  static const std::vector<std::pair<std::string, Format>> names = {
      {"clf", Format::clf}, {"ctf", Format::ctf}, {"spi3d", Format::spi3d}, {"cube", Format::cube}};
  return names;
}

Format format_of(const BakeOptions& o) {
  if (!o.format.empty()) return choice("--format", o.format, formats());
  const std::string extension = fs::path(o.output).extension().string();
  for (const auto& [name, format] : formats())
    if (extension == "." + name) return format;
  throw Error(ExitCode::usage, o.output,
              "no LUT format goes by that name: clf, ctf, spi3d or cube, or give --format");
}

std::size_t edge_of(const BakeOptions& o) {
  return choice<std::size_t>("--size", o.size, {{"17", 17}, {"33", 33}, {"65", 65}, {"129", 129}});
}

/// Every luminance asked for, in the order given.
std::vector<double> adaptations_of(const BakeOptions& o) {
  std::vector<double> out;
  for (const std::string& text : o.adaptations) {
    if (text == "ladder")
      for (const LadderStep& step : ladder) out.push_back(step.adaptation);
    else if (text == "auto")
      fail_value("--adaptation", text, "luminances in cd/m2, or ladder: a LUT does not see the image");
    else
      out.push_back(adaptation_value(text));
  }
  if (out.empty()) throw Error(ExitCode::usage, "", "--adaptation is needed: luminances in cd/m2, or ladder");
  return out;
}

/// --effects auto is all: what a scene calls for is decided pixel by pixel, in the LUT.
OperatorChoice operator_choice(const OperatorOptions& o) {
  const OperatorChoice out = understand(o);
  if (out.acuity == EffectWish::yes)
    fail_value("--effects", o.effects,
               "shift, luminance and chroma: acuity needs a pixel's neighbours, which no LUT sees");
  return out;
}

LookSpec spec_for(OperatorChoice choice, const BakeOptions& o, const ColourConfig& config,
                  double adaptation) {
  set_primaries(choice, config);
  LookSpec spec;
  spec.parameters = parameters_of(choice, adaptation);
  spec.gamut = choice.gamut;
  spec.edge = edge_of(o);
  spec.space = o.colourspace.empty() ? config.working_space() : config.resolve(o.colourspace);
  const std::optional<Matrix3<double>> linear = linear_space_matrix(config, spec.space);
  spec.encoded = !linear;
  if (linear) {
    // The operator works in the primaries that the look is given.
    spec.parameters.xyz_from_rgb = *linear;
    if (spec.gamut == "working") spec.parameters.xyz_from_gamut = *linear;
  }
  return spec;
}

void refuse_linear(const LookSpec& spec, Format format) {
  if (spec.encoded || format == Format::clf || format == Format::ctf) return;
  throw Error(
      ExitCode::usage, "",
      fmt::format("'{}' is linear light, whose dark end evenly spaced nodes miss (errors of 60 % and more): "
                  "give --colorspace a log or display encoding, or bake a .clf",
                  spec.space));
}

std::string lut_text(const BakedLook& look, Format format) {
  switch (format) {
    case Format::ctf:
      return xml_text(look.chain, ChainFormat::ctf);
    case Format::spi3d:
      return spi3d_text(only_lut3d(look.chain));
    case Format::cube:
      return cube_text(look.chain);
    case Format::clf:
      break;
  }
  return xml_text(look.chain, ChainFormat::clf);
}

void check_error(const BakeOptions& o, const BakedLook& look) {
  if (o.max_error.empty()) return;
  const double limit = number_in("--max-error", o.max_error, 0, 1000, "a CIEDE2000 from 0 to 1000");
  if (look.error.max <= limit) return;
  throw Error(ExitCode::check_failed, "",
              fmt::format("{}: largest error {:.3g} exceeds {:.3g}; a larger --size helps", look.chain.name,
                          look.error.max, limit));
}

nlohmann::ordered_json json_of(const BakedLook& look) {
  return {{"look", look.chain.name},        {"adaptation", look.spec.parameters.adaptation},
          {"size", look.spec.edge},         {"mean", look.error.mean},
          {"p99", look.error.p99},          {"max", look.error.max},
          {"worstColour", look.error.worst}};
}

std::string said(const BakedLook& look) {
  const bool hdr = look.spec.night && look.spec.night->peak > display_white;
  return fmt::format("{}{}: {} to the operator: {}, at ({:.4g}, {:.4g}, {:.4g})", look.chain.name,
                     look.spec.night ? " for a display of " + look.spec.display : "", hdr ? "delta E ITP" : "CIEDE2000",
                     error_text(look.error), look.error.worst[0], look.error.worst[1], look.error.worst[2]);
}

/// With several luminances, "night.clf" becomes "night_0.1.clf" and so on.
std::string numbered(const std::string& output, double adaptation) {
  const fs::path path(output);
  return (path.parent_path() /
          (path.stem().string() + "_" + adaptation_text(adaptation) + path.extension().string()))
      .string();
}

int bake_files(const BakeOptions& o, const ColourConfig& config, const Console& console) {
  const Format format = format_of(o);
  const std::vector<double> adaptations = adaptations_of(o);
  const OperatorChoice choice = operator_choice(o.appearance);
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  std::vector<std::string> lines;
  OutputSet set;
  std::vector<OutputFile*> files;
  std::vector<LookSpec> specs;
  for (const double adaptation : adaptations) {
    specs.push_back(spec_for(choice, o, config, adaptation));
    refuse_linear(specs.back(), format);
    files.push_back(&set.open(adaptations.size() > 1 ? numbered(o.output, adaptation) : o.output));
  }
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const BakedLook look = bake_look(specs[i], config, SCOTOPIC_VERSION);
    check_error(o, look);
    OutputSet::write(*files[i], lut_text(look, format));
    require_read_back(files[i]->open_name(), files[i]->path(), look.chain);
    lines.push_back(files[i]->path() + ": " + said(look));
    results.push_back(json_of(look));
    results.back()["output"] = files[i]->path();
  }
  set.commit();
  for (const std::string& line : lines) console.note(line);
  console.result({{"luts", results}});
  return static_cast<int>(ExitCode::done);
}

std::vector<LookSpec> specs_for_config(const BakeOptions& o, const ColourConfig& config) {
  std::vector<LookSpec> specs;
  OperatorChoice choice = operator_choice(o.appearance);
  for (const double adaptation : adaptations_of(o)) specs.push_back(spec_for(choice, o, config, adaptation));
  if (!o.beside.empty()) {
    OperatorOptions other = o.appearance;
    other.model = o.beside;
    choice = operator_choice(other);
    for (const double adaptation : adaptations_of(o)) {
      const LookSpec spec = spec_for(choice, o, config, adaptation);
      if (!is_identity(spec.parameters)) specs.push_back(spec);
    }
  }
  for (const LookSpec& spec : specs)
    if (spec.encoded)
      throw Error(ExitCode::usage, "", "looks of a config work on linear light: no --colorspace");
  return specs;
}

std::string command_of(const BakeOptions& o) {
  std::string text = "scotopic bake";
  for (const std::string& a : o.adaptations) text += " --adaptation " + a;
  if (!o.beside.empty()) text += " --beside " + o.beside;
  text += " --model " + o.appearance.model + " --size " + o.size +
          (o.into.empty() ? " --config DIR" : " --into CONFIG");
  return o.luts.empty() ? text : text + " --luts LUTS";
}

bool has_whole_ladder(const std::vector<LookSpec>& specs) {
  for (const LadderStep& step : ladder) {
    bool found = false;
    for (const LookSpec& spec : specs) found |= spec.parameters.adaptation == step.adaptation;
    if (!found) return false;
  }
  return true;
}

/// LUTs are read back before any of them takes its place: the baked ones against what was measured.
void add_luts(OutputSet& files, const std::string& folder, const LookSet& set) {
  for (std::size_t i = 0; i < set.luts.size(); ++i) {
    const OutputFile& file = files.add(folder + "/" + set.luts[i].name, set.luts[i].text);
    const BakedLook& look = i < set.looks.size() ? set.looks[i] : set.night_luts[i - set.looks.size()];
    require_read_back(file.open_name(), file.path(), look.chain);
  }
}

int bake_config(const BakeOptions& o, const ColourConfig& config, const Console& console) {
  const std::vector<LookSpec> specs = specs_for_config(o, config);
  const std::string luts = o.luts.empty() ? o.new_config + "/luts" : o.luts;
  require_writable_folder(o.new_config);
  require_writable_folder(luts);
  LookSet set = bake_set(specs, config, SCOTOPIC_VERSION, has_whole_ladder(specs));
  add_nights(set, specs, config, SCOTOPIC_VERSION);
  for (const auto* baked : {&set.looks, &set.night_luts})
    for (const BakedLook& look : *baked) {
      check_error(o, look);
      console.note(said(look));
    }
  const std::string text = look_config_text(set);
  require_config(text, o.new_config + "/config.ocio");
  OutputSet files;
  files.make_folder(o.new_config);
  files.make_folder(luts);
  // The config last: it is never there without its files.
  add_luts(files, luts, set);
  files.add(luts + "/MANIFEST", manifest_text(set, SCOTOPIC_VERSION, command_of(o)));
  files.add(o.new_config + "/config.ocio", text);
  files.commit();
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  for (const BakedLook& look : set.looks) results.push_back(json_of(look));
  console.result({{"config", o.new_config + "/config.ocio"}, {"looks", results}});
  return static_cast<int>(ExitCode::done);
}

/// The config as it was stays beside the new one; an older such copy is never overwritten.
void keep_original(OutputSet& files, const std::string& file, const std::string& text) {
  const std::string copy = file + ".before_scotopic";
  if (!fs::exists(copy)) files.add(copy, text);
}

int bake_into(const BakeOptions& o, const Console& console) {
  const ColourConfig config = ColourConfig::from_file(o.into, o.limits);
  const std::vector<LookSpec> specs = specs_for_config(o, config);
  const std::string original = text_of(o.into);
  if (!o.dry_run) require_writable_folder(fs::absolute(o.into).parent_path().string());
  const LookSet set = bake_set(specs, config, SCOTOPIC_VERSION, false);
  for (const BakedLook& look : set.looks) check_error(o, look);
  const MergedConfig merged = merge_looks(config, set.entries);
  if (merged.rewritten)
    console.note(o.into + ": its layout is unusual: OpenColorIO writes the config anew, comments are lost");
  if (o.dry_run) {
    std::fputs(line_diff(original, merged.text).c_str(), stdout);
    for (const TextFile& lut : set.luts) console.note("would write " + merged.lut_folder + "/" + lut.name);
    return static_cast<int>(ExitCode::done);
  }
  require_config(merged.text, o.into);
  OutputSet files;
  files.make_folder(merged.lut_folder);
  add_luts(files, merged.lut_folder, set);
  files.add(merged.lut_folder + "/MANIFEST", manifest_text(set, SCOTOPIC_VERSION, command_of(o)));
  keep_original(files, o.into, original);
  files.add(o.into, merged.text);
  if (text_of(o.into) != original)
    throw Error(ExitCode::config, o.into, "was changed by another program meanwhile: run this again");
  files.commit();
  for (const BakedLook& look : set.looks) console.note(said(look));
  console.result({{"config", o.into}, {"luts", merged.lut_folder}, {"looks", set.looks.size()}});
  return static_cast<int>(ExitCode::done);
}

int run_bake(const BakeOptions& o) {
  const Console console(o.common);
  if ((o.output.empty() ? 0 : 1) + (o.new_config.empty() ? 0 : 1) + (o.into.empty() ? 0 : 1) != 1)
    throw Error(ExitCode::usage, "",
                "give one of -o FILE (a LUT), --config DIR (a whole config), --into CONFIG");
  const auto goes_with = [](bool given, bool allowed, const char* what) {
    if (given && !allowed) throw Error(ExitCode::usage, "", what);
  };
  goes_with(o.dry_run, !o.into.empty(), "--dry-run goes with --into");
  goes_with(!o.luts.empty(), !o.new_config.empty(), "--luts goes with --config");
  goes_with(!o.beside.empty(), o.output.empty(), "--beside goes with --config or --into");
  goes_with(!o.colour_config.empty(), !o.output.empty(), "--iconfig goes with -o");
  goes_with(!o.format.empty(), !o.output.empty(), "--format goes with -o");
  (void)edge_of(o);
  (void)adaptations_of(o);
  (void)operator_choice(o.appearance);
  if (!o.new_config.empty()) return bake_config(o, ColourConfig::own(), console);
  if (!o.into.empty()) return bake_into(o, console);
  (void)format_of(o);
  return bake_files(o, ColourConfig::in_force(o.colour_config, o.limits), console);
}

}  // namespace

void add_bake(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<BakeOptions>();
  BakeOptions& o = *options;
  CLI::App& verb = *program.add_subcommand("bake", "The operator as a LUT, or as a config full of looks");
  verb.footer(
      "Examples:\n"
      "  scotopic bake --adaptation 0.1 -o street.clf\n"
      "  scotopic bake --adaptation 0.1 --size 65 --max-error 0.6 -o street.clf\n"
      "  scotopic bake --adaptation 0.01 --colorspace ACEScct -o moon.cube\n"
      "  scotopic bake --adaptation ladder --beside kirk2011 --config looks/\n"
      "  scotopic bake --adaptation 0.1 --adaptation 0.01 --into studio/config.ocio --dry-run");
  const auto add = [&](const char* name, std::string& value, const char* text, const char* kind) {
    return verb.add_option(name, value, text)->type_name(kind);
  };
  add("-o,--output", o.output, "The LUT: .clf, .ctf, .spi3d or .cube", "FILE");
  add("--format", o.format,
      "clf, ctf, spi3d, cube; else by the extension. spi3d and cube only for encoded spaces", "NAME");
  add("--size", o.size, "Nodes a side: 17, 33 (default), 65, 129", "N");
  add("--colorspace", o.colourspace, "What the LUT takes and gives; else the config's scene_linear", "NAME");
  add("--iconfig", o.colour_config, "The config that --colorspace is of; else $OCIO, else the program's own",
      "FILE");
  add("--config", o.new_config, "Write a whole config here: config.ocio, luts/",
      "NEW_DIR");
  add("--luts", o.luts, "With --config: the LUTs' folder, where it is not luts/ beside the config", "DIR");
  add("--into", o.into, "Add the looks to this config; its former text is kept beside it", "STUDIO_CONFIG");
  verb.add_flag("--dry-run", o.dry_run, "With --into: print what would change, write nothing");
  add("--beside", o.beside, "With --config or --into: the same looks by a second model, too", "MODEL");
  add("--max-error", o.max_error, "Fail if the largest measured error exceeds this", "DE00");
  add_operator_options(verb, o.appearance);
  verb.remove_option(verb.get_option("--adaptation"));
  verb.add_option("--adaptation", o.adaptations,
                  "Luminance the eye is adapted to; repeatable; or ladder: all that ship")
      ->type_name("CDM2")
      ->group("What is seen");
  add_config_limits(verb, o.limits);
  add_common_options(verb, o.common);
  on_command_line(verb, invocation, options, run_bake);
}

}  // namespace scotopic
