#include "io/light_channels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"

namespace scotopic {
namespace {

using Kind = ColourChannels::Kind;

/// Channels of one layer by their last name; layer "" is the topmost.
using Layer = std::map<std::string, std::size_t>;

std::map<std::string, Layer> layers_of(const std::vector<Channel>& channels) {
  std::map<std::string, Layer> out;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].type == PixelType::uint32) continue;  // identifiers
    const std::string& name = channels[i].name;
    const std::size_t dot = name.rfind('.');
    const bool top = dot == std::string::npos;
    out[top ? "" : name.substr(0, dot)].emplace(top ? name : name.substr(dot + 1), i);
  }
  return out;
}

/// Indices of `names` where the layer has them all.
std::optional<std::vector<std::size_t>> all_of(const Layer& layer, const std::vector<std::string>& names) {
  std::vector<std::size_t> out;
  for (const std::string& name : names) {
    const auto found = layer.find(name);
    if (found == layer.end()) return std::nullopt;
    out.push_back(found->second);
  }
  return out;
}

void find_alpha(const Layer& layer, ColourChannels& out) {
  for (const char* alpha : {"A", "a", "alpha", "Alpha"})
    if (const auto found = layer.find(alpha); found != layer.end() && !out.alpha) out.alpha = found->second;
}

/// RED, Green, blue; none of those that differ in capitals alone.
Layer in_small_letters(const Layer& layer) {
  Layer out;
  std::set<std::string> twice;
  for (const auto& [name, index] : layer) {
    const std::string small = lowered(name);
    if (!out.emplace(small, index).second) twice.insert(small);
  }
  for (const std::string& name : twice) out.erase(name);
  return out;
}

ColourChannels colour_in(const std::string& name, const Layer& layer) {
  ColourChannels out;
  out.layer = name;
  const auto take_of = [&](const Layer& from, Kind kind, const std::vector<std::string>& names) {
    const auto found = all_of(from, names);
    if (out.kind != Kind::none || !found) return false;
    out.kind = kind;
    std::copy(found->begin(), found->end(), out.index.begin());
    return true;
  };
  const auto take = [&](Kind kind, const std::vector<std::string>& names) {
    return take_of(layer, kind, names);
  };
  take(Kind::rgb, {"R", "G", "B"});
  take(Kind::rgb, {"r", "g", "b"});
  const Layer small = in_small_letters(layer);
  take_of(small, Kind::rgb, {"r", "g", "b"});
  take_of(small, Kind::rgb, {"red", "green", "blue"});
  take(Kind::lmsr, {"L", "M", "S", "R"});
  // Under a name they are a position or a normal.
  if (name.empty()) out.xyz = take(Kind::rgb, {"X", "Y", "Z"});
  find_alpha(layer, out);
  return out;
}

ColourChannels grey_in(const std::string& name, const Layer& layer) {
  ColourChannels out;
  const auto luminance = layer.find("Y");
  // Y with RY and BY is luminance and chroma: its colour would be lost. With X it is a position.
  if (luminance == layer.end() || layer.count("RY") || layer.count("BY") || layer.count("X")) return out;
  out.kind = Kind::grey;
  out.layer = name;
  out.index[0] = luminance->second;
  find_alpha(layer, out);
  return out;
}

ColourChannels any_in(const std::string& name, const Layer& layer) {
  const ColourChannels colour = colour_in(name, layer);
  return colour.kind == Kind::none ? grey_in(name, layer) : colour;
}

/// A layer's name without the view that ends it.
std::string without_view(const std::string& layer, const std::vector<std::string>& stated) {
  static const std::vector<std::string> usual = {"left", "right"};
  const std::vector<std::string>& views = stated.empty() ? usual : stated;
  const std::size_t dot = layer.rfind('.');
  const std::string last = dot == std::string::npos ? layer : layer.substr(dot + 1);
  if (std::find(views.begin(), views.end(), last) == views.end()) return layer;
  return dot == std::string::npos ? "" : layer.substr(0, dot);
}

/// One of each that are views of the same.
std::vector<ColourChannels> first_views(const std::vector<ColourChannels>& candidates,
                                        const std::vector<std::string>& views) {
  std::vector<ColourChannels> out;
  std::set<std::string> seen;
  for (const ColourChannels& c : candidates)
    if (seen.insert(without_view(c.layer, views)).second) out.push_back(c);
  return out;
}

/// The only one, or the only beauty; Error(usage) for several, none for none.
ColourChannels only_one(const std::vector<ColourChannels>& all, const std::vector<std::string>& views,
                        const std::string& file) {
  const std::vector<ColourChannels> candidates = first_views(all, views);
  if (candidates.empty()) return {};
  if (candidates.size() == 1) return candidates.front();
  std::vector<std::string> names;
  std::vector<ColourChannels> beauties;
  for (const ColourChannels& c : candidates) {
    names.push_back(c.layer);
    if (is_beauty_name(c.layer)) beauties.push_back(c);
  }
  if (beauties.size() == 1) return beauties.front();
  throw Error(
      ExitCode::usage, file,
      "has colour in several layers (" + name_list(names) + "); choose with --layer, or --layers A,B");
}

}  // namespace

std::vector<std::string> colour_layers(const Subimage& subimage) {
  std::vector<std::string> out;
  for (const auto& [name, layer] : layers_of(subimage.channels))
    if (any_in(name, layer).kind != Kind::none) out.push_back(name);
  return out;
}

std::vector<std::string> other_views(const Subimage& subimage, const std::string& layer) {
  std::vector<std::string> out;
  const std::string shown = without_view(layer, subimage.views);
  for (const std::string& other : colour_layers(subimage))
    if (other != layer && without_view(other, subimage.views) == shown) out.push_back(other);
  return subimage.views.empty() && out.size() > 1 ? std::vector<std::string>{} : out;
}

bool names_a_view(const Subimage& subimage, const std::string& layer) {
  return without_view(layer, subimage.views) != layer;
}

ColourChannels find_colour(const Subimage& subimage, const std::string& layer, const std::string& file) {
  const std::map<std::string, Layer> layers = layers_of(subimage.channels);
  if (!layer.empty()) {
    const auto found = layers.find(layer);
    return found == layers.end() ? ColourChannels{} : any_in(layer, found->second);
  }
  std::vector<ColourChannels> colours, receptors, greys;
  for (const auto& [name, channels] : layers) {
    const ColourChannels colour = colour_in(name, channels);
    if (name.empty() && colour.kind != Kind::none) return colour;
    if (is_data_name(name)) continue;
    if (colour.kind == Kind::rgb) colours.push_back(colour);
    if (colour.kind == Kind::lmsr) receptors.push_back(colour);
    if (const ColourChannels grey = grey_in(name, channels); grey.kind != Kind::none) greys.push_back(grey);
  }
  for (const std::vector<ColourChannels>* list : {&colours, &receptors})
    if (!list->empty()) return only_one(*list, subimage.views, file);
  if (!greys.empty() && greys.front().layer.empty()) return greys.front();
  return only_one(greys, subimage.views, file);
}

}  // namespace scotopic
