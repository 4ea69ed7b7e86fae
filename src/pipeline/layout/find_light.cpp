#include "pipeline/layout/find_light.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/names.h"
#include "color/file/file_colour.h"
#include "pipeline/rows/row_codec.h"

namespace scotopic {
namespace {

using Kind = ColourChannels::Kind;

void choose_space(const PixelSource& source, const ColourConfig& config, const ImageRequest& request,
                  LightSubimage& light) {
  const Subimage& subimage = source.subimages()[light.index];
  if (has_receptors(light.channels)) {
    light.space = config.space(config.working_space());
    light.space_reason = "receptor signals";
  } else if (request.colourspace) {
    light.space = config.space(*request.colourspace);
    light.space_reason = "--colorspace";
  } else if (light.channels.xyz) {
    light.space = {"CIE XYZ", identity3<double>()};
    light.space_reason = "channels X, Y, Z, white D65";
  } else {
    const PixelType type = subimage.channels[light.channels.index[0]].type;
    const FileColour found = colour_of_file(subimage.colour, source.file(), is_integer(type),
                                            static_cast<int>(8 * size_of(type)), config);
    light.space = found.space;
    light.space_reason = found.reason;
    light.conflicts = found.notes;
  }
}

/// The light of one subimage; one with several candidates tells so in `ambiguous` and counts as having none.
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
  for (const Subimage& subimage : source.subimages()) {
    if (!subimage.name.empty()) names.insert(subimage.name);
    for (const std::string& layer : colour_layers(subimage))
      if (!layer.empty()) names.insert(layer);
  }
  return {names.begin(), names.end()};
}

/// Of the file's channels, those that could be bands of a spectrum which is not read.
std::vector<std::string> spectral_look_alikes(const Subimage& subimage) {
  std::vector<std::string> out;
  for (const Channel& channel : subimage.channels)
    if (looks_spectral(channel.name)) out.push_back(channel.name);
  return out;
}

[[noreturn]] void fail_without_light(const PixelSource& source, const std::string& layer,
                                     const std::vector<std::string>& data) {
  const std::string has = "; it has " + channel_list(source.subimages());
  if (!layer.empty())
    throw Error(ExitCode::usage, source.file(),
                "has no layer or part '" + layer + "' with R, G, B or L, M, S, R or Y" +
                    did_you_mean(layer, layer_names(source)) + has);
  if (!data.empty())
    throw Error(ExitCode::input, source.file(),
                "holds data, not light (" + name_list(data) + "): --layer takes one for light");
  for (const Subimage& subimage : source.subimages()) {
    if (!subimage.readable)
      throw Error(ExitCode::input, source.file(),
                  "has colour only in deep or subsampled channels, which are not supported" + has);
    if (!spectral_look_alikes(subimage).empty())
      throw Error(
          ExitCode::input, source.file(),
          "has bands of a form that is not read: name them S0.500,0nm (or T.) as spectral OpenEXR has it" +
              has);
  }
  throw Error(ExitCode::input, source.file(), "has no channels R, G, B, nor L, M, S, R, nor Y" + has);
}

/// The views of a stereo subimage: each part has one of its own.
bool are_views(const PixelSource& source, const std::vector<LightSubimage>& light) {
  static const std::set<std::string> usual = {"left", "right", "l", "r", "center", "centre"};
  std::set<std::string> views;
  std::set<int> parts;
  for (const LightSubimage& p : light) {
    const Subimage& subimage = source.subimages()[p.index];
    const std::string view = !subimage.view.empty()       ? subimage.view
                             : usual.count(subimage.name) ? subimage.name
                                                          : "";
    if (view.empty()) return false;
    views.insert(view);
    parts.insert(subimage.part);
  }
  return views.size() == parts.size();
}

/// Of several parts with light: all views, else the beauty; topmost colour comes before that in layers.
void keep_subimages(const PixelSource& source, std::vector<LightSubimage>& light) {
  const auto layered = [](const LightSubimage& p) { return !p.channels.layer.empty(); };
  if (!std::all_of(light.begin(), light.end(), layered)) std::erase_if(light, layered);
  std::vector<std::string> names;
  std::set<int> parts, beauties;
  for (const LightSubimage& p : light) {
    const Subimage& subimage = source.subimages()[p.index];
    const std::string name = subimage.name.empty() ? p.channels.layer : subimage.name;
    if (parts.insert(subimage.part).second) names.push_back(name);
    if (is_beauty_name(name)) beauties.insert(subimage.part);
  }
  if (parts.size() < 2 || source.format() != "openexr" || are_views(source, light)) return;
  if (beauties.size() != 1)
    throw Error(ExitCode::usage, source.file(),
                "has several parts that could be its light (" + name_list(names) + "); choose with --layer");
  std::erase_if(
      light, [&](const LightSubimage& p) { return source.subimages()[p.index].part != *beauties.begin(); });
}

/// What stays as it is though it has names of colour, and what is not read of spectra.
std::vector<std::string> notes_of(const PixelSource& source, const std::vector<LightSubimage>& light) {
  std::vector<std::string> left, bands, notes;
  std::set<int> parts;
  for (std::size_t i = 0; i < source.subimages().size(); ++i) {
    const Subimage& subimage = source.subimages()[i];
    if (subimage.level_x != 0 || subimage.level_y != 0) continue;
    const auto chosen =
        std::find_if(light.begin(), light.end(), [&](const LightSubimage& p) { return p.index == i; });
    if (chosen == light.end()) {
      if (parts.insert(subimage.part).second && !subimage.name.empty()) left.push_back(subimage.name);
      continue;
    }
    for (const std::string& layer : colour_layers(subimage))
      if (layer != chosen->channels.layer && chosen->channels.kind != Kind::computed)
        left.push_back(layer.empty() ? "R, G, B" : layer);
    for (const std::string& band : spectral_look_alikes(subimage)) bands.push_back(band);
  }
  if (!left.empty())
    notes.push_back("layers or parts that are left as they are (--layer takes another): " + name_list(left));
  if (bands.empty()) return notes;
  const bool computed = light.front().channels.kind == Kind::computed;
  notes.push_back(
      computed ? "fluorescence is left out: " + name_list(bands)
               : "R, G, B are taken for its light, though it has what looks like bands of a spectrum (" +
                     name_list(bands) + "), whose names are not those of spectral OpenEXR (S0.500,0nm)");
  return notes;
}

bool is_data(const Subimage& subimage, const ImageRequest& request) {
  if (!request.layer.empty()) return false;
  return (are_data(subimage.colour) && !request.colourspace) ||
         (is_data_name(subimage.name) && !is_beauty_name(subimage.name));
}

}  // namespace

FoundLight find_light(const PixelSource& source, const ColourConfig& config, const ImageRequest& request) {
  FoundLight out;
  std::optional<Error> ambiguous;
  std::vector<std::string> data;
  for (std::size_t i = 0; i < source.subimages().size(); ++i) {
    const Subimage& subimage = source.subimages()[i];
    if (!subimage.readable) continue;
    if (is_data(subimage, request)) {
      data.push_back(are_data(subimage.colour) ? "colorInteropID " + subimage.colour.interop_id
                                               : subimage.name);
      continue;
    }
    const bool part_chosen =
        !request.layer.empty() && (subimage.name == request.layer || subimage.view == request.layer);
    LightSubimage light;
    light.index = i;
    light.channels = colour_of(source, i, part_chosen ? "" : request.layer, ambiguous);
    light.channels.straight = subimage.unassociated_alpha;
    if (light.channels.kind != Kind::none) out.light.push_back(light);
  }
  if (out.light.empty() && ambiguous) throw *ambiguous;
  if (out.light.empty()) fail_without_light(source, request.layer, data);
  if (request.layer.empty()) keep_subimages(source, out.light);
  for (LightSubimage& light : out.light) choose_space(source, config, request, light);
  out.notes = notes_of(source, out.light);
  return out;
}

}  // namespace scotopic
