#include "options/image_options.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/input_file.h"
#include "color/primaries.h"
#include "options/values.h"

namespace scotopic {

namespace {

constexpr std::int64_t primaries_file_size = 4096;

void add_limit(CLI::App& verb, const char* name, std::int64_t& value, const char* text) {
  verb.add_option(name, value, text)
      ->check(whole_number(1, std::int64_t{1} << 62))
      ->group("Limits")
      ->capture_default_str();
}

}  // namespace

void add_config_limits(CLI::App& verb, Limits& limits) {
  add_limit(verb, "--max-config-size", limits.config, "Bytes of a config");
  add_limit(verb, "--max-lut-size", limits.lut, "Bytes of a LUT");
}

void add_input_options(CLI::App& verb, ImageOptions& o) {
  const TextOptions add{verb, "Input"};
  add("--config", o.config, "OpenColorIO config; else $OCIO, else the program's own", "FILE");
  add_working_primaries(verb, o.working_primaries);
  add("--colorspace", o.colourspace,
      "Of the input; else what the file says (identifier, chromaticities, profile, tags), else the config's "
      "rules",
      "NAME");
  add("--layer", o.layer, "Which layer, part or view holds the colour", "NAME");
  const auto limit = [&](const char* name, std::int64_t& value, const char* text) {
    add_limit(verb, name, value, text);
  };
  limit("--max-side", o.limits.side, "Pixels of a row or column");
  limit("--max-pixels", o.limits.pixels, "Pixels of a picture");
  limit("--max-channels", o.limits.channels, "Channels of a picture");
  limit("--max-bands", o.limits.bands, "Bands of a spectrum");
  limit("--max-memory", o.limits.memory, "Bytes planned for pixels on their way");
  add_config_limits(verb, o.limits);
}

void add_layers_option(CLI::App& verb, ImageOptions& o, const char* text) {
  verb.add_option("--layers", o.layers, text)->type_name("A,B,...")->group("Input")->excludes("--layer");
}

void add_output_options(CLI::App& verb, ImageOptions& o) {
  const TextOptions add{verb, "Output"};
  add("--output-colorspace", o.output_colourspace,
      "Of the output; else the input's, or what its file type calls for", "NAME");
  add("-d", o.type, "Type of colour channels: half, float, uint8, uint16; else the input's", "TYPE");
  add("--exposure", o.exposure, "Applied to the result, not to the scene: value 1 then stands for less light",
      "EV");
}

void add_working_primaries(CLI::App& verb, std::string& value) {
  verb.add_option("--working-primaries", value,
                  "Of the config's scene_linear, where its roles do not say: rec709, rec2020, p3, ap1, ap0, "
                  "or a file of x y "
                  "of red, green, blue, white")
      ->type_name("NAME|FILE")
      ->group("Input");
}

std::optional<Matrix3<double>> working_primaries(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (const auto known = gamut_xyz_matrix(text)) return known;
  const auto refuse = [&] {
    fail_value(
        "--working-primaries", text,
        "rec709, rec2020, p3, ap1, ap0, or a file of eight numbers: x y of red, green, blue and white");
  };
  std::error_code error;
  if (!std::filesystem::exists(text, error)) refuse();
  std::istringstream in(read_input_file(text, ExitCode::usage, primaries_file_size, ""));
  std::vector<double> numbers;
  for (std::string word; in >> word;) {
    const std::optional<double> number = parse_number(word);
    if (!number) refuse();
    numbers.push_back(*number);
  }
  if (numbers.size() != 8 || !(numbers[7] > 0)) refuse();
  const auto xy = [&](std::size_t i) { return Xy{numbers[2 * i], numbers[2 * i + 1]}; };
  return xyz_d65_from_rgb({xy(0), xy(1), xy(2), xy(3)});
}

ColourConfig config_in_force(const ImageOptions& o) {
  return ColourConfig::in_force(o.config, o.limits, working_primaries(o.working_primaries));
}

ColourConfig config_at(const std::string& file, const ImageOptions& o) {
  return ColourConfig::from_file(file, o.limits, working_primaries(o.working_primaries));
}

/// Names between commas.
std::vector<std::string> layer_list(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at <= text.size() && !text.empty();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    if (comma == at) fail_value("--layers", text, "names of layers, parts or views between commas");
    out.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return out;
}

ImageRequest parse(const ImageOptions& o) {
  ImageRequest out;
  out.layer = o.layer;
  out.layers = layer_list(o.layers);
  if (!o.colourspace.empty()) out.colourspace = o.colourspace;
  if (!o.output_colourspace.empty()) out.output_colourspace = o.output_colourspace;
  if (!o.type.empty())
    out.type = choice<PixelType>("-d", o.type,
                                 {{"half", PixelType::half},
                                  {"float", PixelType::float32},
                                  {"uint8", PixelType::uint8},
                                  {"uint16", PixelType::uint16}});
  out.exposure = number_in("--exposure", o.exposure, -64, 64, "a number of EV from -64 to 64");
  return out;
}

}  // namespace scotopic
