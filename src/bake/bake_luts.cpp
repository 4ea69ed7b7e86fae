// Looks as LUT files, one for each adaptation.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bake/bake_options.h"
#include "looks/chain/chain_text.h"
#include "looks/chain/read_back.h"
#include "looks/lut/baked_look.h"
#include "looks/lut/shipped_looks.h"
#include "options/image_options.h"
#include "options/values.h"

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

}  // namespace

nlohmann::ordered_json bake_luts(const BakeOptions& o, const Console& console) {
  (void)format_of(o);
  return bake_files(
      o, ColourConfig::in_force(o.colour_config, o.limits, working_primaries(o.working_primaries)), console);
}

}  // namespace scotopic
