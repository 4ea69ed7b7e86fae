// What the output will hold: decided from headers alone.
#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/apply_image.h"
#include "base/error.h"
#include "base/names.h"

namespace scotopic {
namespace {

using Kind = ColourChannels::Kind;

void choose_space(const PixelSource& source, const ColourConfig& config, const ImageRequest& request,
                  LightPicture& light) {
  const Picture& picture = source.pictures()[light.index];
  if (light.channels.kind == Kind::lmsr || light.channels.kind == Kind::computed) {
    light.space = config.space(config.working_space());
    light.space_reason = "receptor signals";
  } else if (request.colourspace) {
    light.space = config.space(*request.colourspace);
    light.space_reason = "--colorspace";
  } else if (picture.primaries && are_cie_xyz(*picture.primaries)) {
    light.space = {"CIE XYZ", bradford(picture.adopted_neutral.value_or(white_d65), white_d65)};
    light.space_reason = picture.adopted_neutral ? "the file's chromaticities and neutral" : "the file's chromaticities";
  } else if (const NamedPrimaries* known =
                 picture.primaries ? match_primaries(*picture.primaries) : nullptr) {
    light.space = {std::string(known->label), xyz_d65_from_rgb(known->primaries)};
    light.space_reason = "the file's chromaticities";
  } else {
    const PixelType type = picture.channels[light.channels.index[0]].type;
    light.space = config.space_of_file(source.file(), is_integer(type));
    light.space_reason = "the config's file rules";
  }
}

/// The light of one picture; one with several candidates tells so in `ambiguous` and counts as having none.
ColourChannels colour_of(const PixelSource& source, std::size_t index, const std::string& layer,
                         std::optional<Error>& ambiguous) {
  try {
    return source.colour(index, layer);
  } catch (const Error& e) {
    if (!ambiguous) ambiguous = e;
    return {};
  }
}

/// Names that --layer could have meant.
std::vector<std::string> layer_names(const PixelSource& source) {
  std::set<std::string> names;
  for (const Picture& picture : source.pictures()) {
    if (!picture.name.empty()) names.insert(picture.name);
    for (const Channel& channel : picture.channels)
      if (const std::size_t dot = channel.name.rfind('.'); dot != std::string::npos)
        names.insert(channel.name.substr(0, dot));
  }
  return {names.begin(), names.end()};
}

[[noreturn]] void fail_without_light(const PixelSource& source, const std::string& layer) {
  if (!layer.empty())
    throw Error(ExitCode::usage, source.file(),
                "has no layer or part '" + layer + "' with R, G, B or L, M, S, R" +
                    did_you_mean(layer, layer_names(source)));
  const bool unreadable = std::any_of(source.pictures().begin(), source.pictures().end(),
                                      [](const Picture& p) { return !p.readable; });
  throw Error(
      ExitCode::input, source.file(),
      unreadable
          ? "has colour only in deep or subsampled (luminance/chroma) channels, which are not supported"
          : "has no channels R, G, B, nor L, M, S, R, nor Y");
}

/// Parts with topmost colour are all of them light (the views of a stereo pair); of parts that have it in
/// layers only, one must be chosen: the others are passes, not pictures.
void keep_pictures(const PixelSource& source, std::vector<LightPicture>& light) {
  const auto layered = [](const LightPicture& p) { return !p.channels.layer.empty(); };
  if (!std::all_of(light.begin(), light.end(), layered)) {
    std::erase_if(light, layered);
    return;
  }
  std::string names;
  std::set<int> parts;
  for (const LightPicture& p : light)
    if (parts.insert(source.pictures()[p.index].part).second)
      names += (names.empty() ? "" : ", ") + p.channels.layer;
  if (parts.size() > 1)
    throw Error(ExitCode::usage, source.file(),
                "has colour in several layers (" + names + "); choose with --layer");
}

/// Pictures that hold light, by the rules of find_colour; a layer may also be the name of a part.
std::vector<LightPicture> find_light(const PixelSource& source, const ColourConfig& config,
                                     const ImageRequest& request) {
  std::vector<LightPicture> out;
  std::optional<Error> ambiguous;
  for (std::size_t i = 0; i < source.pictures().size(); ++i) {
    const Picture& picture = source.pictures()[i];
    if (!picture.readable) continue;
    const bool part_chosen = !request.layer.empty() && picture.name == request.layer;
    LightPicture light;
    light.index = i;
    light.channels = colour_of(source, i, part_chosen ? "" : request.layer, ambiguous);
    if (light.channels.kind != Kind::none) out.push_back(light);
  }
  if (out.empty() && ambiguous) throw *ambiguous;
  if (out.empty()) fail_without_light(source, request.layer);
  if (request.layer.empty()) keep_pictures(source, out);
  for (LightPicture& light : out) choose_space(source, config, request, light);
  return out;
}

std::string listed(const std::vector<PixelType>& types) {
  std::string out;
  for (const PixelType type : types) out += (out.empty() ? "" : ", ") + std::string(name_of(type));
  return out;
}

/// The type a colour channel gets: as asked, else its own, else the nearest that loses nothing the eye sees. What goes
/// to a device is whole numbers, but in OpenEXR.
PixelType output_type(const std::string& format, const std::string& output, PixelType own, const ImageRequest& request) {
  const std::optional<PixelType>& asked = request.type;
  const std::vector<PixelType>& possible = pixel_types_of(format);
  const auto can = [&](PixelType type) {
    return std::find(possible.begin(), possible.end(), type) != possible.end();
  };
  if (asked) {
    if (!can(*asked))
      throw Error(
          ExitCode::usage, output,
          "-d " + std::string(name_of(*asked)) + " does not fit this format (" + listed(possible) + ")");
    return *asked;
  }
  if (format == "tiff" && (request.view || request.profile) && !is_integer(own)) return PixelType::uint16;
  if (can(own)) return own;
  if (format == "jpeg") return PixelType::uint8;
  if (format == "openexr") return own == PixelType::uint8 ? PixelType::half : PixelType::float32;
  return format == "png" ? PixelType::uint16 : PixelType::float32;
}

/// Whether what is written is looked at as it is.
bool is_looked_at(const std::string& format, PixelType out, const ImageRequest& request) {
  if (request.night != NightDisplayMode::where_looked_at) return request.night == NightDisplayMode::always;
  if (request.output_colourspace || request.view || request.profile) return false;
  return format == "png" || format == "jpeg" || (format == "tiff" && is_integer(out));
}

/// Codes that a display takes: 1 is its white.
bool is_display_encoding(const ColourConfig& config, const ColourSpace& space) {
  const auto encoding = config.encoding(space);
  return encoding && std::abs(encoding->white - 1) < 1e-3 && !config.linear_xyz(space);
}

/// The space that the display stage's result is encoded in: as asked, else the input's where that is a display's, else
/// that of the output's name.
ColourSpace night_space(const std::string& output, const ColourConfig& config, const ImageRequest& request,
                        const LightPicture& light, bool from_integer) {
  if (!request.night_display.empty()) return config.display_space(request.night_display);
  if (from_integer && is_display_encoding(config, light.space)) return light.space;
  const ColourSpace named = config.space_of_file(output, true);
  if (is_display_encoding(config, named)) return named;
  throw Error(ExitCode::config, config.file(),
              "says of " + output + " that it holds '" + named.name +
                  "', which is no display's encoding: name a display (--display night:DISPLAY), or --display none");
}

/// The display stage's part of the layout.
NightOutput night_output(const ColourConfig& config, const ColourSpace& space, const LightPicture& light,
                         bool from_integer) {
  NightOutput out;
  const auto encoding = config.encoding(space);
  if (!encoding)
    throw Error(ExitCode::config, config.file(), "'" + space.name + "' is no encoding of a display's R, G, B");
  out.xyz_from_display = encoding->xyz_from_rgb;
  if (!from_integer) return out;
  if (const auto input = config.encoding(light.space)) {
    const Matrix3<double> to_display = inverse(encoding->xyz_from_rgb) * input->xyz_from_rgb;
    for (const Vec3<double>& row : to_display.rows)
      out.greatest = std::max(out.greatest, input->white * (std::max(0.0, row[0]) + std::max(0.0, row[1]) +
                                                            std::max(0.0, row[2])));
  }
  return out;
}

/// Light stays in its space where the output holds the same kind of numbers; else the config's rules for the
/// output's name decide.
ColourSpace choose_output_space(const PixelSource& source, const std::string& output,
                                const ColourConfig& config, const ImageRequest& request,
                                ImageLayout& layout) {
  const LightPicture& light = layout.light.front();
  const Picture& picture = source.pictures()[light.index];
  const bool receptors = light.channels.kind == Kind::lmsr || light.channels.kind == Kind::computed;
  const PixelType in = receptors ? PixelType::float32 : picture.channels[light.channels.index[0]].type;
  const PixelType out = output_type(layout.format, output, in, request);
  if (is_looked_at(layout.format, out, request)) {
    const ColourSpace space = night_space(output, config, request, light, is_integer(in));
    layout.night = night_output(config, space, light, is_integer(in));
    return space;
  }
  if (request.output_colourspace) return config.space(*request.output_colourspace);
  if (request.view) return config.view(*request.view);
  if (request.profile) return {request.profile->description(), std::nullopt, std::nullopt, request.profile};
  if (is_integer(in) == is_integer(out)) return light.space;
  return is_integer(out) ? config.space_of_file(output, true) : config.space(config.working_space());
}

/// Channels of an output: R, G, B in place of what they are made of; the others as they are, or only alpha.
std::vector<Channel> output_channels(const Picture& picture, const LightPicture& light,
                                     const std::string& format, const std::string& output,
                                     const ImageRequest& request, bool keep_others) {
  const ColourChannels& colour = light.channels;
  const std::string prefix = colour.layer.empty() ? "" : colour.layer + ".";
  const auto type_of = [&](std::size_t i) {
    const PixelType own =
        colour.kind == Kind::computed ? PixelType::float32 : picture.channels[colour.index[i]].type;
    return output_type(format, output, own, request);
  };
  std::vector<Channel> out;
  const char* const names[3] = {"R", "G", "B"};
  for (std::size_t i = 0; i < 3; ++i) {
    std::string name = keep_others ? prefix + names[i] : names[i];
    // Its own name, where the file writes it another way.
    if (colour.kind == Kind::rgb && keep_others) name = picture.channels[colour.index[i]].name;
    out.push_back({name, type_of(colour.kind == Kind::grey ? 0 : i)});
  }
  for (std::size_t c = 0; c < picture.channels.size(); ++c) {
    if (colour.is_colour(c)) continue;
    const bool alpha = colour.alpha == c && format != "jpeg";
    if (keep_others || alpha)
      out.push_back({alpha && !keep_others ? "A" : picture.channels[c].name,
                     format == "openexr" && !is_integer(picture.channels[c].type) ? picture.channels[c].type
                     : format == "openexr" && picture.channels[c].type == PixelType::uint32
                         ? PixelType::uint32
                         : out[0].type});
  }
  return out;
}

OutputPicture light_output(const PixelSource& source, const LightPicture& light, const std::string& output,
                           const ColourConfig& config, const ImageRequest& request,
                           const ImageLayout& layout) {
  const Picture& picture = source.pictures()[light.index];
  OutputPicture out;
  out.source = light.index;
  out.picture = picture;
  const bool same_kind = source.format() == layout.format;
  out.picture.channels = output_channels(picture, light, layout.format, output, request,
                                         same_kind ? layout.format == "openexr" || layout.format == "tiff"
                                                   : layout.format == "openexr");
  if (layout.format == "openexr" || layout.format == "jpeg") out.picture.unassociated_alpha = false;
  if (layout.format == "png") out.picture.unassociated_alpha = true;
  const bool receptors = light.channels.kind == Kind::lmsr || light.channels.kind == Kind::computed;
  out.new_space = receptors || !config.same(light.space, layout.output_space);
  const std::optional<Matrix3<double>> xyz = config.linear_xyz(layout.output_space);
  if (const NamedPrimaries* known = xyz ? match_matrix(*xyz) : nullptr) out.primaries = known->primaries;
  if (xyz && is_cie_xyz(*xyz)) {
    out.primaries = cie_xyz_primaries();
    out.adopted_neutral = white_d65;
  }
  out.for_a_device = layout.output_space.for_a_device();
  out.profile = request.profile;
  out.jpeg_quality = request.jpeg_quality;
  out.srgb = config.is_srgb(layout.output_space);
  return out;
}

void note_losses(const PixelSource& source, ImageLayout& layout) {
  if (layout.format == "openexr") return;
  const std::size_t left_out = source.pictures().size() - layout.outputs.size();
  if (left_out > 0)
    layout.notes.push_back(std::to_string(left_out) +
                           " more pictures (parts, resolutions, pages) are not written: " + layout.format +
                           " holds only the first here");
  const OutputPicture& out = layout.outputs.front();
  const Picture& picture = source.pictures()[out.source];
  if (picture.data != picture.display) layout.notes.push_back("only the data window is written");
  const std::size_t colours = layout.light.front().channels.count();
  const std::size_t others = picture.channels.size() - std::min(picture.channels.size(), colours);
  const std::size_t kept = out.picture.channels.size() - 3;
  if (others > kept)
    layout.notes.push_back(std::to_string(others - kept) + " other channels are not written");
}

}  // namespace

const LightPicture* ImageLayout::light_of(std::size_t source_index) const {
  for (const LightPicture& picture : light)
    if (picture.index == source_index) return &picture;
  return nullptr;
}

ImageLayout plan_layout(const PixelSource& source, const std::string& output, const ColourConfig& config,
                        const ImageRequest& request) {
  ImageLayout layout;
  layout.format = output_format(output);
  layout.exposure = request.exposure;
  if (request.profile && layout.format == "openexr")
    throw Error(ExitCode::usage, output, "--icc: OpenEXR holds no profile; TIFF, PNG and JPEG do");
  layout.light = find_light(source, config, request);
  layout.output_space = choose_output_space(source, output, config, request, layout);
  const bool whole = layout.format == "openexr" ? source.format() == "openexr" : false;
  const bool pages = layout.format == "tiff" && source.format() == "tiff";
  if (!whole && !pages) layout.light.resize(1);
  for (std::size_t i = 0; i < source.pictures().size(); ++i) {
    if (const LightPicture* light = layout.light_of(i)) {
      layout.outputs.push_back(light_output(source, *light, output, config, request, layout));
    } else if (whole) {
      OutputPicture copied;
      copied.source = i;
      copied.picture = source.pictures()[i];
      copied.copy = true;
      // Chunks of a part are copied at once, with all its resolutions.
      if (copied.picture.level_x == 0 && copied.picture.level_y == 0) layout.outputs.push_back(copied);
    }
  }
  note_losses(source, layout);
  return layout;
}

void set_stamps(ImageLayout& layout, const std::vector<Attribute>& stamps) {
  for (OutputPicture& out : layout.outputs)
    if (!out.copy) out.stamps = stamps;
}

}  // namespace scotopic
