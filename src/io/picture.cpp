#include "io/picture.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/names.h"

namespace scotopic {
namespace {

constexpr std::size_t band_bytes = std::size_t{8} << 20;

/// Channels of one layer by their last name; layer "" is the topmost.
using Layer = std::map<std::string, std::size_t>;

std::map<std::string, Layer> layers_of(const std::vector<Channel>& channels) {
  std::map<std::string, Layer> out;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string& name = channels[i].name;
    const std::size_t dot = name.rfind('.');
    const bool top = dot == std::string::npos;
    out[top ? "" : name.substr(0, dot)].emplace(top ? name : name.substr(dot + 1), i);
  }
  return out;
}

/// Indices of `names` where the layer has them all; EXR channels are also written r, g, b and red, green,
/// blue.
std::optional<std::vector<std::size_t>> all_of(const Layer& layer, const std::vector<std::string>& names) {
  std::vector<std::size_t> out;
  for (const std::string& name : names) {
    const auto found = layer.find(name);
    if (found == layer.end()) return std::nullopt;
    out.push_back(found->second);
  }
  return out;
}

ColourChannels colour_in(const std::string& name, const Layer& layer) {
  using Kind = ColourChannels::Kind;
  ColourChannels out;
  out.layer = name;
  const auto take = [&](Kind kind, const std::vector<std::string>& names) {
    const auto found = all_of(layer, names);
    if (out.kind != Kind::none || !found) return;
    out.kind = kind;
    std::copy(found->begin(), found->end(), out.index.begin());
  };
  take(Kind::rgb, {"R", "G", "B"});
  take(Kind::rgb, {"r", "g", "b"});
  take(Kind::lmsr, {"L", "M", "S", "R"});
  for (const char* alpha : {"A", "a"})
    if (const auto found = layer.find(alpha); found != layer.end() && !out.alpha) out.alpha = found->second;
  return out;
}

ColourChannels grey_in(const Layer& layer) {
  ColourChannels out;
  const auto luminance = layer.find("Y");
  // Y with RY and BY is luminance and chroma: its colour would be lost.
  if (luminance == layer.end() || layer.count("RY") || layer.count("BY")) return out;
  out.kind = ColourChannels::Kind::grey;
  out.index[0] = luminance->second;
  if (const auto alpha = layer.find("A"); alpha != layer.end()) out.alpha = alpha->second;
  return out;
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

}  // namespace

bool ColourChannels::is_colour(std::size_t channel) const {
  return std::find(index.begin(), index.begin() + static_cast<std::ptrdiff_t>(count()), channel) !=
         index.begin() + static_cast<std::ptrdiff_t>(count());
}

void Band::allocate_planar(const std::vector<Channel>& types, int first_row, int row_count, int row_width) {
  y0 = first_row;
  rows = row_count;
  width = row_width;
  std::size_t total = 0;
  const auto pixels = static_cast<std::size_t>(row_count) * static_cast<std::size_t>(row_width);
  for (const Channel& channel : types) total += pixels * size_of(channel.type);
  storage.resize(total);
  channels.clear();
  std::byte* at = storage.data();
  for (const Channel& channel : types) {
    const auto size = static_cast<std::ptrdiff_t>(size_of(channel.type));
    channels.push_back({at, size, size * row_width, channel.type});
    at += pixels * size_of(channel.type);
  }
}

void Band::allocate_interleaved(const std::vector<Channel>& types, int first_row, int row_count,
                                int row_width) {
  y0 = first_row;
  rows = row_count;
  width = row_width;
  std::size_t pixel = 0;
  for (const Channel& channel : types) pixel += size_of(channel.type);
  storage.resize(pixel * static_cast<std::size_t>(row_count) * static_cast<std::size_t>(row_width));
  channels.clear();
  std::byte* at = storage.data();
  const auto stride = static_cast<std::ptrdiff_t>(pixel);
  for (const Channel& channel : types) {
    channels.push_back({at, stride, stride * row_width, channel.type});
    at += size_of(channel.type);
  }
}

std::size_t row_bytes(const Picture& picture) {
  std::size_t pixel = picture.computed_bytes;
  for (const Channel& channel : picture.channels) pixel += size_of(channel.type);
  return pixel * static_cast<std::size_t>(picture.data.width());
}

int band_rows(const Picture& picture) {
  const std::size_t chunk =
      std::max<std::size_t>(1, row_bytes(picture) * static_cast<std::size_t>(picture.chunk_rows));
  const auto chunks = static_cast<int>(std::clamp<std::size_t>(band_bytes / chunk, 1, 1024));
  const std::int64_t rows = std::int64_t{chunks} * picture.chunk_rows;
  return static_cast<int>(std::min<std::int64_t>(rows, std::max(1, picture.data.height())));
}

std::int64_t planned_bytes(const Picture& picture) {
  constexpr std::int64_t bands = 3;
  return bands * static_cast<std::int64_t>(row_bytes(picture)) * band_rows(picture) + picture.library_bytes;
}

ColourChannels find_colour(const Picture& picture, const std::string& layer, const std::string& file) {
  using Kind = ColourChannels::Kind;
  std::map<std::string, Layer> layers = layers_of(picture.channels);
  if (!layer.empty()) {
    const auto found = layers.find(layer);
    return found == layers.end() ? ColourChannels{} : colour_in(layer, found->second);
  }
  std::vector<ColourChannels> candidates[2];  // RGB before LMSR
  std::vector<std::string> names[2];
  for (const auto& [name, channels] : layers) {
    const ColourChannels colour = colour_in(name, channels);
    if (colour.kind == Kind::none) continue;
    if (name.empty()) return colour;
    const std::size_t list = colour.kind == Kind::rgb ? 0 : 1;
    candidates[list].push_back(colour);
    names[list].push_back(name);
  }
  for (std::size_t list = 0; list < 2; ++list) {
    if (candidates[list].size() == 1) return candidates[list].front();
    if (candidates[list].size() > 1)
      throw Error(ExitCode::usage, file,
                  "has colour in several layers (" + listed(names[list]) + "); choose with --layer");
  }
  return grey_in(layers[""]);
}

}  // namespace scotopic
