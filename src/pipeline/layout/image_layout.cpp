// What the output will hold: decided from headers alone.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/names.h"
#include "pipeline/layout/find_light.h"
#include "pipeline/layout/layout.h"
#include "pipeline/layout/light_notes.h"
#include "pipeline/rows/row_codec.h"

namespace scotopic {
namespace {

using Kind = ColourChannels::Kind;

std::string listed(const std::vector<PixelType>& types) {
  std::string out;
  for (const PixelType type : types) add_to_list(out, name_of(type));
  return out;
}

/// The type a colour channel gets: as asked, else its own, else the nearest that loses nothing the eye sees.
/// What goes to a device is whole numbers, but in OpenEXR.
PixelType output_type(const std::string& format, const std::string& output, PixelType own,
                      const ImageRequest& request) {
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

/// The space that the display stage's result is encoded in: as asked, else the input's where that is a
/// display's, else that of the output's name.
ColourSpace night_space(const std::string& output, const ColourConfig& config, const ImageRequest& request,
                        const LightSubimage& light, bool from_integer) {
  if (!request.night_display.empty()) return config.display_space(request.night_display);
  if (from_integer && can_be_stated(light.space, false, false) && is_display_encoding(config, light.space))
    return light.space;
  const ColourSpace named = config.space_of_file(output, true);
  if (is_display_encoding(config, named)) return named;
  throw Error(
      ExitCode::config, config.file(),
      "says of " + output + " that it holds '" + named.name +
          "', which is no display's encoding: name a display (--display night:DISPLAY), or --display none");
}

/// The display stage's part of the layout.
NightOutput night_output(const ColourConfig& config, const ColourSpace& space, const LightSubimage& light,
                         bool from_integer) {
  NightOutput out;
  const auto encoding = config.encoding(space);
  if (!encoding)
    throw Error(ExitCode::config, config.file(),
                "'" + space.name + "' is no encoding of a display's R, G, B");
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
  const LightSubimage& light = layout.light.front();
  const Subimage& subimage = source.subimages()[light.index];
  const bool receptors = has_receptors(light.channels);
  const PixelType in = receptors ? PixelType::float32 : subimage.channels[light.channels.index[0]].type;
  const PixelType out = output_type(layout.format, output, in, request);
  if (is_looked_at(layout.format, out, request)) {
    const ColourSpace space = night_space(output, config, request, light, is_integer(in));
    layout.night = night_output(config, space, light, is_integer(in));
    return space;
  }
  if (request.output_colourspace) return config.space(*request.output_colourspace);
  if (request.view) return config.view(*request.view);
  if (request.profile) return {request.profile->description(), std::nullopt, std::nullopt, request.profile};
  const bool exr = layout.format == "openexr";
  const bool named =
      source.format() == "openexr" && !request.colourspace && !subimage.colour.interop_id.empty();
  const bool stays = !light.channels.xyz && can_be_stated(light.space, exr, named);
  if (is_integer(in) == is_integer(out) && stays) return light.space;
  return is_integer(out) ? config.space_of_file(output, true) : config.space(config.working_space());
}

/// R, G, B that a layer becomes.
void add_colour(const Subimage& subimage, const ColourChannels& colour, const std::string& format,
                const std::string& output, const ImageRequest& request, bool keep_others,
                std::vector<Channel>& out) {
  const std::string prefix = colour.layer.empty() ? "" : colour.layer + ".";
  const auto type_of = [&](std::size_t i) {
    const PixelType own =
        colour.kind == Kind::computed ? PixelType::float32 : subimage.channels[colour.index[i]].type;
    return output_type(format, output, own, request);
  };
  const char* const names[3] = {"R", "G", "B"};
  for (std::size_t i = 0; i < 3; ++i) {
    std::string name = keep_others ? prefix + names[i] : names[i];
    // Its own name, where the file writes it another way.
    if (colour.kind == Kind::rgb && !colour.xyz && keep_others)
      name = subimage.channels[colour.index[i]].name;
    out.push_back({name, type_of(colour.kind == Kind::grey ? 0 : i)});
  }
}

/// Channels of an output: R, G, B of each layer in place of what they are made of; the others as they are, or
/// only alpha.
std::vector<Channel> output_channels(const Subimage& subimage, const std::vector<const LightSubimage*>& light,
                                     const std::string& format, const std::string& output,
                                     const ImageRequest& request, bool keep_others) {
  std::vector<Channel> out;
  for (const LightSubimage* layer : light)
    add_colour(subimage, layer->channels, format, output, request, keep_others, out);
  for (std::size_t c = 0; c < subimage.channels.size(); ++c) {
    if (std::any_of(light.begin(), light.end(),
                    [&](const LightSubimage* layer) { return layer->channels.is_colour(c); }))
      continue;
    const bool alpha = light.front()->channels.alpha == c && format != "jpeg";
    if (keep_others || alpha)
      out.push_back({alpha && !keep_others ? "A" : subimage.channels[c].name,
                     format == "openexr" && !is_integer(subimage.channels[c].type) ? subimage.channels[c].type
                     : format == "openexr" && subimage.channels[c].type == PixelType::uint32
                         ? PixelType::uint32
                         : out[0].type});
  }
  return out;
}

OutputSubimage light_output(const PixelSource& source, std::size_t index, const std::string& output,
                            const ColourConfig& config, const ImageRequest& request,
                            const ImageLayout& layout) {
  const LightSubimage& light = *layout.light_of(index);
  const Subimage& subimage = source.subimages()[light.index];
  OutputSubimage out;
  out.source = light.index;
  out.subimage = subimage;
  const bool same_kind = source.format() == layout.format;
  out.subimage.channels = output_channels(
      subimage, layout.lights_of(index), layout.format, output, request,
      same_kind ? layout.format == "openexr" || layout.format == "tiff" : layout.format == "openexr");
  if (layout.format == "openexr" || layout.format == "jpeg") out.subimage.unassociated_alpha = false;
  if (layout.format == "png") out.subimage.unassociated_alpha = true;
  const bool receptors = has_receptors(light.channels);
  out.new_space = receptors || !config.same(light.space, layout.output_space);
  out.tags = written_tags(layout.output_space, config);
  out.new_tags =
      out.new_space || request.colourspace || !light.conflicts.empty() || source.format() != layout.format;
  out.for_a_device = layout.output_space.for_a_device();
  out.jpeg_quality = request.jpeg_quality;
  return out;
}

void note_losses(const PixelSource& source, ImageLayout& layout) {
  const std::size_t left_out = source.subimages().size() - layout.outputs.size();
  if (left_out > 0)
    layout.notes.push_back(std::to_string(left_out) +
                           " more pictures (parts, resolutions, pages) are not written: " + layout.format +
                           " holds only the first here");
  if (layout.format == "openexr") return;
  const OutputSubimage& out = layout.outputs.front();
  const Subimage& subimage = source.subimages()[out.source];
  const PixelType colour = subimage.channels.empty() ? PixelType::float32 : subimage.channels.front().type;
  if (layout.format == "tiff" && colour == PixelType::half &&
      out.subimage.channels.front().type == PixelType::float32)
    layout.notes.push_back("half becomes float: few programs read a TIFF of half");
  if (subimage.data != subimage.display) layout.notes.push_back("only the data window is written");
  const std::size_t colours = layout.light.front().channels.count();
  const std::size_t others = subimage.channels.size() - std::min(subimage.channels.size(), colours);
  const std::size_t kept = out.subimage.channels.size() - 3;
  if (others > kept)
    layout.notes.push_back(std::to_string(others - kept) + " other channels are not written");
}

void note_alike(ImageLayout& layout) {
  if (std::string note = alike_note(layout.light); !note.empty()) layout.notes.push_back(std::move(note));
}

/// Of the first subimage with light: the others are read in the same way.
void note_reading(const PixelSource& source, ImageLayout& layout) {
  const LightSubimage& light = layout.light.front();
  const std::vector<std::string>& read = source.subimages()[light.index].notes;
  layout.notes.insert(layout.notes.end(), read.begin(), read.end());
  layout.notes.insert(layout.notes.end(), light.conflicts.begin(), light.conflicts.end());
}

void note_colours(ImageLayout& layout) {
  const OutputSubimage& out = layout.outputs.front();
  const bool said = layout.format == "openexr" ? out.tags.linear : out.tags.srgb || out.tags.icc;
  if (out.new_tags && !said && !out.for_a_device)
    layout.notes.push_back("values are written in '" + layout.output_space.name +
                           "', which nothing in the file says");
}

}  // namespace

const LightSubimage* ImageLayout::light_of(std::size_t source_index) const {
  for (const LightSubimage& subimage : light)
    if (subimage.index == source_index) return &subimage;
  return nullptr;
}

std::vector<const LightSubimage*> ImageLayout::lights_of(std::size_t source_index) const {
  std::vector<const LightSubimage*> out;
  for (const LightSubimage& subimage : light)
    if (subimage.index == source_index) out.push_back(&subimage);
  return out;
}

ImageLayout plan_layout(const PixelSource& source, const std::string& output, const ColourConfig& config,
                        const ImageRequest& request) {
  ImageLayout layout;
  layout.format = output_format(output);
  layout.exposure = request.exposure;
  if (request.profile && layout.format == "openexr")
    throw Error(ExitCode::usage, output, "--icc: OpenEXR holds no profile; TIFF, PNG and JPEG do");
  FoundLight found = find_light(source, config, request);
  layout.light = std::move(found.light);
  layout.notes = std::move(found.notes);
  layout.output_space = choose_output_space(source, output, config, request, layout);
  const bool whole = layout.format == "openexr" ? source.format() == "openexr" : false;
  const bool pages = layout.format == "tiff" && source.format() == "tiff";
  if (!whole && request.layers.size() > 1)
    throw Error(ExitCode::usage, output, "--layers: this format holds one layer; OpenEXR holds several");
  if (!whole && !pages) layout.light.resize(1);
  note_alike(layout);
  for (std::size_t i = 0; i < source.subimages().size(); ++i) {
    if (layout.light_of(i)) {
      layout.outputs.push_back(light_output(source, i, output, config, request, layout));
    } else if (whole) {
      OutputSubimage copied;
      copied.source = i;
      copied.subimage = source.subimages()[i];
      copied.copy = true;
      // Chunks of a part are copied at once, with all its resolutions.
      if (copied.subimage.is_full_resolution()) layout.outputs.push_back(copied);
    }
  }
  // JPEG rounds in another domain, where steps of a code mean nothing.
  layout.dither = request.dither && (layout.night || request.view) && layout.format != "jpeg";
  note_losses(source, layout);
  note_reading(source, layout);
  note_colours(layout);
  return layout;
}

ImageLayout read_layout(const PixelSource& source, const ColourConfig& config, const ImageRequest& request) {
  ImageLayout layout;
  FoundLight found = find_light(source, config, request);
  layout.light = std::move(found.light);
  layout.notes = std::move(found.notes);
  if (source.format() != "openexr") layout.light.resize(1);
  note_alike(layout);
  note_reading(source, layout);
  layout.output_space = layout.light.front().space;
  return layout;
}

void set_stamps(ImageLayout& layout, const std::vector<Attribute>& stamps) {
  for (OutputSubimage& out : layout.outputs)
    if (!out.copy) out.stamps = stamps;
}

}  // namespace scotopic
