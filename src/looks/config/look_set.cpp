#include "looks/config/look_set.h"

#include <fmt/format.h>

#include "stages/shared/constants.h"
#include "looks/chain/chain_text.h"
#include "looks/lut/highlights.h"
#include "looks/lut/ladder.h"
#include "looks/lut/look_matrix.h"
#include "looks/config/sha256.h"

namespace scotopic {
namespace {

constexpr const char* highlight_file = "highlight_safe.clf";

LookEntry entry_of(const BakedLook& look) {
  const AppearanceParameters& p = look.spec.parameters;
  LookEntry entry;
  entry.name = look_name(p);
  entry.file = look_file_stem(p) + ".clf";
  entry.description = fmt::format(
      "Adapted to {} cd/m2, model {}; value 1 stands for {:.4g} cd/m2. Forward only: the inverse does "
      "nothing. CIEDE2000 to the "
      "operator: {}",
      adaptation_text(p.adaptation), name_of(p.model), p.white_luminance, error_text(look.error));
  return entry;
}

LookEntry context_entry(const LookSpec& spec) {
  LookEntry entry;
  entry.name = std::string("Mesopic by ") + context_variable;
  entry.file = std::string(name_of(spec.parameters.model)) + "_$" + context_variable + ".clf";
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
  entry.description = fmt::format(
      "Loss of colour alone, global weight, exact: a matrix that keeps {:.4g} of the chroma",
      chroma_factor(p.adaptation));
  entry.matrix = look_matrix(chroma);
  entry.view = false;
  return entry;
}

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
  if (context) set.entries.push_back(context_entry(specs.front()));
  const Model model = specs.front().parameters.model;
  for (const LookSpec& spec : specs)
    if (spec.parameters.model == model && !is_identity(spec.parameters))
      set.entries.push_back(chroma_entry(spec.parameters));
  return set;
}

void add_highlights(LookSet& set, const std::string& version) {
  set.luts.push_back({highlight_file, xml_text(highlight_chain(version), ChainFormat::clf)});
}

std::string manifest_text(const LookSet& set, const std::string& version, const std::string& command) {
  std::string text =
      fmt::format("# Made by scotopic {}: {}\n# Check with: sha256sum -c MANIFEST\n", version, command);
  for (std::size_t i = 0; i < set.luts.size(); ++i) {
    if (i < set.looks.size())
      text += fmt::format("# {}: CIEDE2000 to the operator, {}\n", set.entries[i].name,
                          error_text(set.looks[i].error));
    text += sha256(set.luts[i].text) + "  " + set.luts[i].name + "\n";
  }
  return text;
}

std::string look_config_text(const LookSet& set) {
  return config_text(*make_look_config(set.entries, highlight_file, lut_search_path));
}

}  // namespace scotopic
