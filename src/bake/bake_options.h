// scotopic bake: its options, and the looks they ask for.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "options/operator_options.h"
#include "io/atomic/output_set.h"
#include "looks/config/look_set.h"
#include "report/console.h"

namespace scotopic {

/// As typed.
struct BakeOptions {
  OperatorOptions appearance;
  CommonOptions common;
  std::vector<std::string> adaptations;
  std::string output;
  std::string format;
  std::string size;
  std::string colourspace;
  std::string colour_config;
  std::string new_config;
  std::string luts;
  std::string into;
  std::string working_primaries;
  bool dry_run = false;
  bool force = false;
  Limits limits;
  std::string beside;
  std::string max_error;
  std::string display;
  std::string peak;
  std::string shader;
  std::string visibility;
};

/// Nodes a side; 0: what --size auto, and none for encoded values, leave to the error.
std::size_t edge_of(const BakeOptions& o);
/// Every luminance asked for, in the order given.
std::vector<double> adaptations_of(const BakeOptions& o);
/// --effects auto is all: what a scene calls for is decided pixel by pixel, in the LUT.
OperatorChoice operator_choice(const OperatorOptions& o);
/// One look.
LookSpec spec_for(OperatorChoice choice, const BakeOptions& o, const ColourConfig& config, double adaptation);
/// The looks of a config, those of --beside last. Error(usage) for encoded ones.
std::vector<LookSpec> specs_for_config(const BakeOptions& o, const ColourConfig& config);

/// Error(check_failed) where the error is over --max-error.
void check_error(const BakeOptions& o, const BakedLook& look);
/// A look and its error, for results and for people.
nlohmann::ordered_json json_of(const BakedLook& look);
std::string said(const BakedLook& look);
/// What a MANIFEST says it was made by.
std::string command_of(const BakeOptions& o);

/// LUTs are read back before any of them takes its place: the baked ones against what was measured.
void add_luts(OutputSet& files, const std::string& folder, const LookSet& set);

/// bake -o FILE, for each adaptation; what --json says of the LUTs.
nlohmann::ordered_json bake_luts(const BakeOptions& o, const Console& console);
/// bake --config DIR.
int bake_config(const BakeOptions& o, const Console& console);
/// bake --into CONFIG.
int bake_into(const BakeOptions& o, const Console& console);
/// Error(usage) for what makes no sense with --shader.
void check_shader_options(const BakeOptions& o);
/// The text that bake --shader writes.
std::string shader_text_of(const BakeOptions& o);
/// bake --shader LANGUAGE.
int bake_shader(const BakeOptions& o, const Console& console);

}  // namespace scotopic
