// scotopic bake: the operator as a LUT, as a shader, as a config of looks, or as looks added to a studio's
// config.
#include <fmt/format.h>

#include <filesystem>

#include "cli/bake/bake_options.h"
#include "cli/options/image_options.h"
#include "cli/options/values.h"
#include "cli/program.h"
#include "looks/chain/chain_text.h"
#include "looks/chain/read_back.h"
#include "looks/lut/baked_look.h"
#include "looks/lut/shipped_looks.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

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

/// With several luminances, "night.clf" becomes "night_0.1.clf" and so on.
std::string numbered(const std::string& output, double adaptation) {
  const fs::path path(output);
  return (path.parent_path() /
          (path.stem().string() + "_" + adaptation_text(adaptation) + path.extension().string()))
      .string();
}

nlohmann::ordered_json bake_files(const BakeOptions& o, const ColourConfig& config, const Console& console) {
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
    const std::string warning = look.cube ? warning_of(*look.cube) : "";
    if (!warning.empty()) lines.push_back(files[i]->path() + ": " + warning);
    results.push_back(json_of(look));
    results.back()["output"] = files[i]->path();
  }
  set.commit();
  for (const std::string& line : lines) console.note(line);
  return results;
}

int run_bake(const BakeOptions& o) {
  const Console console(o.common);
  if ((o.output.empty() ? 0 : 1) + (o.new_config.empty() ? 0 : 1) + (o.into.empty() ? 0 : 1) != 1)
    throw Error(ExitCode::usage, "",
                "give one of -o FILE (a LUT or a shader), --config DIR (a whole config), --into CONFIG");
  const auto goes_with = [](bool given, bool allowed, const char* what) {
    if (given && !allowed) throw Error(ExitCode::usage, "", what);
  };
  goes_with(o.dry_run, !o.into.empty(), "--dry-run goes with --into");
  goes_with(o.force, o.output.empty(), "--force goes with --config or --into");
  goes_with(!o.working_primaries.empty(), o.new_config.empty(), "--working-primaries goes with -o or --into");
  goes_with(!o.luts.empty(), !o.new_config.empty(), "--luts goes with --config");
  goes_with(!o.beside.empty(), o.output.empty(), "--beside goes with --config or --into");
  goes_with(!o.colour_config.empty(), !o.output.empty(), "--iconfig goes with -o");
  goes_with(!o.format.empty(), !o.output.empty(), "--format goes with -o");
  goes_with(!o.display.empty(), !o.output.empty(), "--display goes with -o");
  goes_with(!o.peak.empty(), !o.display.empty(), "--peak goes with --display");
  goes_with(!o.shader.empty(), !o.output.empty(), "--shader goes with -o");
  goes_with(!o.visibility.empty(), !o.shader.empty() && !o.display.empty(),
            "--visibility goes with --shader and --display night");
  if (!o.shader.empty()) {
    check_shader_options(o);
    return bake_shader(o, console);
  }
  (void)edge_of(o);
  (void)adaptations_of(o);
  (void)operator_choice(o.appearance);
  if (!o.new_config.empty()) return bake_config(o, console);
  if (!o.into.empty()) return bake_into(o, console);
  console.result({{"luts", bake_luts(o, console)}});
  return static_cast<int>(ExitCode::done);
}

}  // namespace

nlohmann::ordered_json bake_luts(const BakeOptions& o, const Console& console) {
  (void)format_of(o);
  return bake_files(
      o, ColourConfig::in_force(o.colour_config, o.limits, working_primaries(o.working_primaries)), console);
}

void add_bake(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<BakeOptions>();
  BakeOptions& o = *options;
  CLI::App& verb =
      *program.add_subcommand("bake", "The operator as a LUT, as a shader, or as a config full of looks");
  verb.footer(
      "Examples:\n"
      "  scotopic bake --adaptation 0.1 -o street.clf\n"
      "  scotopic bake --adaptation 0.1 --size 65 --max-error 0.6 -o street.clf\n"
      "  scotopic bake --shader dctl --colorspace \"Linear Rec.709 (sRGB)\" -o scotopic.dctl\n"
      "  scotopic bake --adaptation 0.01 --colorspace ACEScct -o moon.cube\n"
      "  scotopic bake --adaptation 0.1 --colorspace \"ARRI LogC4\" --display \"night:Rec.1886 Rec.709 - "
      "Display\" -o night.cube\n"
      "  scotopic bake --adaptation ladder --beside kirk2011 --config looks/\n"
      "  scotopic bake --adaptation 0.1 --adaptation 0.01 --into studio/config.ocio --dry-run");
  const auto add = [&](const char* name, std::string& value, const char* text, const char* kind) {
    return verb.add_option(name, value, text)->type_name(kind);
  };
  add("-o,--output", o.output, "The LUT: .clf, .ctf, .spi3d or .cube; or the shader", "FILE");
  add("--format", o.format,
      "clf, ctf, spi3d, cube; else by the extension. spi3d and cube only for encoded spaces", "NAME");
  add("--size", o.size,
      "Nodes a side: 17, 33, 65, 129, or auto: 33, and for encoded values 65 where 33 are too few (default)",
      "N");
  add("--display", o.display,
      "night[:DISPLAY]: with --shader, or with --colorspace of an encoding: as dark as the eye sees it, for "
      "this display of the config",
      "WHAT");
  add("--peak", o.peak,
      "With --display: greatest luminance of the display (default 100; 1000 where it is for HDR)", "CDM2");
  add("--shader", o.shader,
      "Instead of a LUT the text of a shader, exact, with sliders: dctl (DaVinci Resolve), blink (Nuke), "
      "glsl (Flame), osl (renderers) or hlsl (ReShade)",
      "NAME");
  add("--visibility", o.visibility, "With --shader and --display: hdrvdp2 (default) or ward1997", "RULE");
  add("--colorspace", o.colourspace, "What the LUT takes and gives; else the config's scene_linear", "NAME");
  add("--iconfig", o.colour_config, "The config that --colorspace is of; else $OCIO, else the program's own",
      "FILE");
  add("--new-config,--config", o.new_config, "Write a whole config here: config.ocio, luts/", "NEW_DIR");
  add("--luts", o.luts, "With --config: the LUTs' folder, where it is not luts/ beside the config", "DIR");
  add("--into", o.into, "Add the looks to this config; its former text is kept beside it", "STUDIO_CONFIG");
  verb.add_flag("--dry-run", o.dry_run, "With --into: print what would change, write nothing");
  verb.add_flag("--force", o.force,
                "With --config: replace a config that bake did not write, which stays beside; with --into: "
                "replace other LUTs");
  add("--beside", o.beside, "With --config or --into: the same looks by a second model, too", "MODEL");
  add("--max-error", o.max_error, "Fail if the largest measured error exceeds this", "DE00");
  add_operator_options(verb, o.appearance, StagesShown::look);
  verb.remove_option(verb.get_option("--adaptation"));
  verb.add_option("--adaptation", o.adaptations,
                  "Luminance the eye is adapted to; repeatable; or ladder: all that ship")
      ->type_name("CDM2")
      ->group("What is seen");
  add_working_primaries(verb, o.working_primaries);
  add_config_limits(verb, o.limits);
  add_common_options(verb, o.common);
  on_command_line(verb, invocation, options, run_bake);
}

}  // namespace scotopic
