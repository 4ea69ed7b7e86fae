#include "pipeline/layout/find_light.h"

#include <algorithm>
#include <set>
#include <string>
#include <tuple>

#include "base/error.h"
#include "color/file/file_colour.h"
#include "pipeline/layout/light_notes.h"
#include "pipeline/rows/row_codec.h"

namespace scotopic {
namespace {

using Kind = ColourChannels::Kind;

/// Grey is Y, and Y is luminance, also where R, G, B would be X, Y, Z.
ColourTags tags_of(const Subimage& subimage, Kind kind) {
  ColourTags tags = subimage.colour;
  if (kind == Kind::grey && tags.primaries && are_cie_xyz(*tags.primaries)) tags.primaries.reset();
  return tags;
}

/// What the header says besides of channels that are X, Y, Z by their names.
std::vector<std::string> conflicts_with_xyz(const ColourTags& tags) {
  const auto id = interop_encoding(tags.interop_id);
  const bool other_id = id && !is_cie_xyz(id->xyz_from_rgb);
  if (!other_id && (!tags.primaries || are_cie_xyz(*tags.primaries))) return {};
  return {std::string("channels X, Y, Z and the file's ") + (other_id ? "colorInteropID" : "chromaticities") +
          " say different things of its colours: the former holds"};
}

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
    if (source.format() == "openexr") light.conflicts = conflicts_with_xyz(subimage.colour);
  } else {
    const PixelType type = subimage.channels[light.channels.index[0]].type;
    const FileColour found = colour_of_file(tags_of(subimage, light.channels.kind), source.file(),
                                            is_integer(type), static_cast<int>(8 * size_of(type)), config);
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

/// The views of a stereo image: each of these parts has one of its own.
bool are_views(const PixelSource& source, const std::vector<LightSubimage>& light, const std::set<int>& of) {
  static const std::set<std::string> usual = {"left", "right", "l", "r", "center", "centre"};
  std::set<std::string> views;
  std::set<int> parts;
  for (const LightSubimage& p : light) {
    const Subimage& subimage = source.subimages()[p.index];
    if (!of.count(subimage.part)) continue;
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
    std::string name = subimage.name.empty() ? p.channels.layer : subimage.name;
    if (name.empty()) name = "(unnamed)";
    if (parts.insert(subimage.part).second) names.push_back(name);
    if (is_beauty_name(name)) beauties.insert(subimage.part);
  }
  if (parts.size() < 2 || source.format() != "openexr" || are_views(source, light, parts)) return;
  if (beauties.empty() || (beauties.size() > 1 && !are_views(source, light, beauties)))
    throw Error(ExitCode::usage, source.file(),
                "has several parts that could be its light (" + name_list(names) +
                    "); choose with --layer, or --layers A,B");
  std::erase_if(light,
                [&](const LightSubimage& p) { return !beauties.count(source.subimages()[p.index].part); });
}

bool is_data(const Subimage& subimage, const ImageRequest& request) {
  if (!request.layer.empty()) return false;
  return (are_data(subimage.colour) && !request.colourspace) ||
         (is_data_name(subimage.name) && !is_beauty_name(subimage.name));
}

/// Of subimage `index` what a name stands for: the part or view itself ("" of its layers), or a layer.
std::string layer_named(const Subimage& subimage, const std::string& name) {
  const std::vector<std::string> layers = colour_layers(subimage);
  if (std::find(layers.begin(), layers.end(), name) != layers.end()) return name;
  const bool default_view = !subimage.views.empty() && subimage.views.front() == name;
  return subimage.name == name || subimage.view == name || default_view ? "" : name;
}

LightSubimage light_in(const PixelSource& source, std::size_t index, const ColourChannels& channels) {
  const Subimage& subimage = source.subimages()[index];
  LightSubimage light;
  light.index = index;
  light.channels = channels;
  light.channels.straight = subimage.unassociated_alpha;
  const bool viewed = channels.layer.empty() && !subimage.views.empty();
  light.name = viewed ? subimage.views.front() : channels.layer;
  if (light.name.empty()) light.name = subimage.name.empty() ? subimage.view : subimage.name;
  return light;
}

/// The file's own beauty, or what --layer names.
std::vector<LightSubimage> chosen_light(const PixelSource& source, const ImageRequest& request) {
  std::vector<LightSubimage> out;
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
    const std::string layer = request.layer.empty() ? "" : layer_named(subimage, request.layer);
    const ColourChannels channels = colour_of(source, i, layer, ambiguous);
    if (channels.kind != Kind::none) out.push_back(light_in(source, i, channels));
  }
  if (out.empty() && ambiguous) throw *ambiguous;
  if (out.empty()) fail_without_light(source, request.layer, data);
  if (request.layer.empty()) keep_subimages(source, out);
  return out;
}

/// Both eyes see a night: other views of a layer in the same part, unless --layer names one.
void add_views(const PixelSource& source, const ImageRequest& request, std::vector<LightSubimage>& light) {
  std::vector<LightSubimage> all;
  for (const LightSubimage& p : light) {
    all.push_back(p);
    const Subimage& subimage = source.subimages()[p.index];
    if (p.channels.kind == Kind::computed || names_a_view(subimage, request.layer)) continue;
    for (const std::string& layer : other_views(subimage, p.channels.layer))
      all.push_back(light_in(source, p.index, source.colour(p.index, layer)));
  }
  light = std::move(all);
}

/// What a name of --layers stands for in one subimage; Kind::none: nothing.
ColourChannels listed_colour(const PixelSource& source, std::size_t index, const std::string& name) {
  const Subimage& subimage = source.subimages()[index];
  const std::vector<std::string> layers = colour_layers(subimage);
  const auto has = [&](const char* layer) {
    return std::find(layers.begin(), layers.end(), layer) != layers.end();
  };
  if (name == "RGB" && !has("RGB")) return has("") ? source.colour(index, "") : ColourChannels{};
  return source.colour(index, layer_named(subimage, name));
}

/// Several kinds of channels cannot become one file's R, G, B by one way.
void require_one_kind(const PixelSource& source, const std::vector<LightSubimage>& light) {
  const ColourChannels& first = light.front().channels;
  for (const LightSubimage& p : light) {
    if (p.channels.kind == Kind::computed)
      throw Error(ExitCode::usage, source.file(), "--layers is not for spectra: --layer takes one");
    if (has_receptors(p.channels) != has_receptors(first) || p.channels.xyz != first.xyz)
      throw Error(
          ExitCode::usage, source.file(),
          "--layers: R, G, B and L, M, S, R or X, Y, Z are not treated alike; name those of one kind");
  }
}

/// What --layers lists, in the file's order.
std::vector<LightSubimage> listed_light(const PixelSource& source, const std::vector<std::string>& names) {
  std::vector<LightSubimage> out;
  const auto known = [&](std::size_t index, const std::string& layer) {
    return std::any_of(out.begin(), out.end(),
                       [&](const LightSubimage& p) { return p.index == index && p.channels.layer == layer; });
  };
  for (const std::string& name : names) {
    bool found = false;
    for (std::size_t i = 0; i < source.subimages().size(); ++i) {
      if (!source.subimages()[i].readable) continue;
      const ColourChannels channels = listed_colour(source, i, name);
      if (channels.kind == Kind::none) continue;
      found = true;
      if (!known(i, channels.layer)) out.push_back(light_in(source, i, channels));
    }
    if (!found) fail_without_light(source, name, {});
  }
  std::sort(out.begin(), out.end(), [](const LightSubimage& a, const LightSubimage& b) {
    return std::tie(a.index, a.channels.layer) < std::tie(b.index, b.channels.layer);
  });
  require_one_kind(source, out);
  return out;
}

/// One eye adapts to one scene: where the beauty is among the layers, they are its shares, and it is metered
/// alone.
void choose_metered(const PixelSource& source, std::vector<LightSubimage>& light) {
  const auto is_beauty = [&](const LightSubimage& p) {
    const std::string& part = source.subimages()[p.index].name;
    return is_beauty_name(p.name) || is_beauty_name(part) || (part.empty() && p.channels.layer.empty());
  };
  if (std::none_of(light.begin(), light.end(), is_beauty)) return;
  for (LightSubimage& p : light) p.metered = is_beauty(p);
}

}  // namespace

FoundLight find_light(const PixelSource& source, const ColourConfig& config, const ImageRequest& request) {
  FoundLight out;
  if (request.layers.empty()) {
    out.light = chosen_light(source, request);
    add_views(source, request, out.light);
  } else {
    out.light = listed_light(source, request.layers);
    choose_metered(source, out.light);
  }
  for (LightSubimage& light : out.light) choose_space(source, config, request, light);
  out.notes = notes_of(source, out.light);
  return out;
}

}  // namespace scotopic
