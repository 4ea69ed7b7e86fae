#include "looks/config/look_set.h"

#include <fmt/format.h>

#include <cmath>

#include "stages/shared/constants.h"
#include "looks/chain/chain_text.h"
#include "adaptation/thresholds.h"
#include "color/primaries.h"
#include "looks/lut/look_chain.h"
#include "looks/lut/shipped_looks.h"
#include "looks/lut/look_matrix.h"
#include "base/digest.h"

namespace scotopic {
namespace {

/// "0.1 cd/m2".
std::string adapted_text(const LookSpec& spec) {
  const std::string text = adaptation_text(spec.parameters.adaptation) + " cd/m2";
  if (!spec.lamp) return text;
  return text + fmt::format(" and to {:.3g} of the colour of a lamp (x {:.4f} y {:.4f})",
                            lamp_degree(*spec.lamp, spec.parameters), spec.lamp->x(), spec.lamp->y());
}

LookEntry entry_of(const BakedLook& look) {
  const AppearanceParameters& p = look.spec.parameters;
  LookEntry entry;
  entry.name = look_name(look.spec);
  entry.file = look_file_stem(look.spec) + ".clf";
  entry.description = fmt::format(
      "Adapted to {}, model {}; value 1 stands for {:.4g} cd/m2. Forward only: the inverse does "
      "nothing. CIEDE2000 to the "
      "operator: {}",
      adapted_text(look.spec), name_of(p.model), p.white_luminance, error_text(look.error));
  return entry;
}

LookEntry context_entry(const LookSpec& spec) {
  LookEntry entry;
  entry.name = std::string("Mesopic by ") + context_variable;
  entry.file =
      std::string(name_of(spec.parameters.model)) + "_$" + context_variable + lamp_stem(spec) + ".clf";
  entry.description = std::string("Adapted to the luminance in context variable ") + context_variable +
                      " (cd/m2, one of the ladder's). For pipelines: a value without a file is an error";
  entry.view = false;
  return entry;
}

/// The loss of colour alone, with the global weight: the one effect that is a matrix, so exact and free of
/// cost.
LookEntry chroma_entry(const AppearanceParameters& p) {
  AppearanceParameters chroma = p;
  chroma.weight = Weight::global;
  chroma.strength = {.all = 1, .shift = 0, .luminance = 0, .chroma = 1};
  LookEntry entry;
  entry.name = fmt::format("Chroma {} nit (global weight matrix)", adaptation_text(p.adaptation));
  entry.description =
      fmt::format("Loss of colour alone, global weight, exact: a matrix that keeps {:.4g} of the chroma",
                  chroma_factor(p.adaptation));
  entry.matrix = look_matrix(chroma);
  entry.view = false;
  return entry;
}

/// The operator's light as dark as the eye sees it, without a shoulder: for those who keep a view of their
/// own.
LookEntry night_entry(const LookEntry& look, const LookSpec& spec) {
  const double stops = visibility_stops(spec.parameters.adaptation, NightDisplayParameters().rule);
  LookEntry entry;
  entry.name = night_name(spec);
  entry.description = fmt::format(
      "{}, {:.2f} stops darker: what is just visible in the scene is just visible on a display. "
      "Scene-linear: under a view of your own",
      look.name, -stops);
  entry.file = look.file;
  const double gain = std::exp2(stops);
  entry.gain = gain;
  entry.view = false;
  return entry;
}

/// Primaries and peaks of the own config's displays.
struct DisplayKind {
  const char* gamut;
  double peak;
};
constexpr DisplayKind display_kinds[] = {{"rec709", display_white}, {"p3", display_white}, {"rec2020", 1000}};

}  // namespace

LookSet bake_set(const std::vector<LookSpec>& specs, const ColourConfig& config, const std::string& version,
                 bool context) {
  LookSet set;
  for (const LookSpec& spec : specs) {
    set.looks.push_back(bake_look(spec, config, version));
    set.entries.push_back(entry_of(set.looks.back()));
    set.luts.push_back({set.entries.back().file, xml_text(set.looks.back().chain, ChainFormat::clf)});
  }
  if (specs.empty()) return set;
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (specs[i].parameters.model == specs.front().parameters.model)
      set.entries.push_back(night_entry(set.entries[i], specs[i]));
  if (context) set.entries.push_back(context_entry(specs.front()));
  const Model model = specs.front().parameters.model;
  for (const LookSpec& spec : specs)
    if (spec.parameters.model == model && !spec.lamp && !is_identity(spec.parameters))
      set.entries.push_back(chroma_entry(spec.parameters));
  return set;
}

void add_nights(LookSet& set, const std::vector<LookSpec>& specs, const ColourConfig& config,
                const std::string& version) {
  for (const DisplayKind& kind : display_kinds)
    for (LookSpec spec : specs) {
      if (spec.parameters.model != specs.front().parameters.model) continue;
      NightDisplayParameters& display = spec.night.emplace();
      display.peak = kind.peak;
      display.xyz_from_display = gamut_xyz_matrix(kind.gamut).value();
      spec.display = kind.gamut;
      const BakedLook& look = set.night_luts.emplace_back(bake_look(spec, config, version));
      const std::string file = night_file_stem(spec) + ".clf";
      set.luts.push_back({file, xml_text(look.chain, ChainFormat::clf)});
      set.nights.push_back(
          {look.chain.name,
           fmt::format("Adapted to {}, as dark as the eye sees it; value 1 stands for "
                       "{:.4g} cd/m2. {} to the program's own: {}",
                       adapted_text(spec), spec.parameters.white_luminance,
                       kind.peak > display_white ? "Delta E ITP" : "CIEDE2000", error_text(look.error)),
           file, kind.gamut});
    }
}

std::string manifest_text(const LookSet& set, const std::string& version, const std::string& command) {
  std::string text =
      fmt::format("# Made by scotopic {}: {}\n# Check with: sha256sum -c MANIFEST\n", version, command);
  for (std::size_t i = 0; i < set.luts.size(); ++i) {
    const BakedLook& look = i < set.looks.size() ? set.looks[i] : set.night_luts[i - set.looks.size()];
    text +=
        fmt::format("# {}: {} to the operator, {}\n", look.chain.name,
                    look.spec.night && look.spec.night->peak > display_white ? "delta E ITP" : "CIEDE2000",
                    error_text(look.error));
    text += sha256(set.luts[i].text) + "  " + set.luts[i].name + "\n";
  }
  return text;
}

std::string look_config_text(const LookSet& set, const std::string& search_path) {
  return config_text(*make_look_config(set.entries, set.nights, search_path));
}

}  // namespace scotopic
