// scotopic bake: the operator as a LUT, as a shader, as a config of looks, or as looks added to a studio's
// config.
#include <memory>
#include <string>

#include "bake/bake_options.h"
#include "cli/program.h"
#include "options/image_options.h"
#include "options/values.h"

namespace scotopic {
namespace {

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
  const TextOptions add{verb};
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
