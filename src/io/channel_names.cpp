// What names of layers, parts and channels tell.
#include <algorithm>
#include <cctype>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/light_channels.h"

namespace scotopic {
namespace {

// Words in lower case; letters alone count where they are all of a name.
constexpr std::string_view data_words[] = {"crypto",
                                           "cryptomatte",
                                           "cryptoobject",
                                           "cryptomaterial",
                                           "cryptoasset",
                                           "normal",
                                           "normals",
                                           "n",
                                           "ng",
                                           "nn",
                                           "nworld",
                                           "ncamera",
                                           "nref",
                                           "depth",
                                           "z",
                                           "zdepth",
                                           "zback",
                                           "position",
                                           "positions",
                                           "p",
                                           "pworld",
                                           "pcamera",
                                           "pref",
                                           "worldposition",
                                           "motion",
                                           "motionvector",
                                           "motionvectors",
                                           "vector",
                                           "velocity",
                                           "uv",
                                           "st",
                                           "id",
                                           "ids",
                                           "objectid",
                                           "materialid",
                                           "instanceid",
                                           "index",
                                           "indexob",
                                           "indexma",
                                           "mist",
                                           "tangent",
                                           "tangents",
                                           "variance",
                                           "samplecount",
                                           "matte",
                                           "mattes",
                                           "mask",
                                           "pz",
                                           "hitpz",
                                           "zbuffer",
                                           "wire",
                                           "multimatte",
                                           "puzzlematte",
                                           "samplerinfo",
                                           "sample",
                                           "samples",
                                           "uvcoord",
                                           "uvcoords",
                                           "uvw",
                                           "uvwcoords",
                                           "primid",
                                           "disparity",
                                           "facingratio",
                                           "roughness",
                                           "dpdu",
                                           "dpdv",
                                           "dpdtime",
                                           "ns",
                                           "cputime",
                                           "raycount",
                                           "coordinates"};
constexpr std::string_view beauty_words[] = {"beauty", "combined", "rgb", "rgba", "ci", "final", "master"};
// Only where they are all of a name: there are colours of wires and of masks.
constexpr std::string_view beauty_names[] = {"color", "colour", "c"};

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Runs of letters, cut where a capital follows a small one; each also with its neighbour ("motionVector").
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> out;
  char before = ' ';
  for (const char c : name) {
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    const bool starts =
        !std::isalpha(static_cast<unsigned char>(before)) ||
        (std::isupper(static_cast<unsigned char>(c)) && std::islower(static_cast<unsigned char>(before)));
    if (letter && starts) out.emplace_back();
    if (letter) out.back() += lower(c);
    before = c;
  }
  return out;
}

bool has_word(std::span<const std::string_view> list, std::string_view name) {
  const auto listed = [&](const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  };
  const std::string last = lowered(name.substr(name.rfind('.') + 1));
  if (listed(last)) return true;
  const std::vector<std::string> words = words_of(name);
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& w) { return w.size() > 1 && listed(w); });
}

}  // namespace

std::string lowered(std::string_view text) {
  std::string out;
  for (const char c : text) out += lower(c);
  return out;
}

bool is_data_name(std::string_view name) { return has_word(data_words, name); }

bool is_beauty_name(std::string_view name) {
  const std::string last = lowered(name.substr(name.rfind('.') + 1));
  return has_word(beauty_words, name) ||
         std::find(std::begin(beauty_names), std::end(beauty_names), last) != std::end(beauty_names);
}

bool looks_spectral(std::string_view channel) {
  const std::string name = lowered(channel);
  const auto digits_before = [&](std::size_t at) {
    while (at > 0 && name[at - 1] == ' ') --at;
    return at > 0 && std::isdigit(static_cast<unsigned char>(name[at - 1]));
  };
  for (std::size_t at = name.find("nm"); at != std::string::npos; at = name.find("nm", at + 1))
    if (digits_before(at)) return true;
  for (std::size_t at = name.find("band"); at != std::string::npos; at = name.find("band", at + 1))
    if (at + 4 < name.size() && std::isdigit(static_cast<unsigned char>(name[at + 4]))) return true;
  const std::string last = name.substr(name.rfind('.') + 1);
  return last.size() == 3 && last >= "300" && last <= "900" &&
         std::all_of(last.begin(), last.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string name_list(const std::vector<std::string>& names, std::size_t most) {
  std::string out;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) out += (i ? ", " : "") + names[i];
  return names.size() > most ? out + ", ... (" + std::to_string(names.size()) + " in all)" : out;
}

std::string channel_list(const std::vector<Subimage>& subimages) {
  std::vector<std::string> names;
  for (const Subimage& subimage : subimages)
    for (const Channel& channel : subimage.channels) {
      const std::string name = (subimage.name.empty() ? "" : subimage.name + ":") + channel.name +
                               (channel.type == PixelType::uint32 ? " (uint: no light)" : "");
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  return name_list(names, 16);
}

}  // namespace scotopic
