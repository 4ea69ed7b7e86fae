#include "pipeline/layout/light_notes.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/names.h"

namespace scotopic {
namespace {

using Kind = ColourChannels::Kind;

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

}  // namespace

void fail_without_light(const PixelSource& source, const std::string& layer,
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

namespace {

std::string shown_name(const std::string& layer) { return layer.empty() ? "RGB" : layer; }

/// Layers and parts with colour that are not among the light.
std::vector<std::string> left_alone(const PixelSource& source, const std::vector<LightSubimage>& light) {
  std::vector<std::string> left;
  std::set<int> parts;
  for (std::size_t i = 0; i < source.subimages().size(); ++i) {
    const Subimage& subimage = source.subimages()[i];
    if (!subimage.is_full_resolution()) continue;
    std::set<std::string> chosen;
    bool computed = false;
    for (const LightSubimage& p : light) {
      if (p.index != i) continue;
      chosen.insert(p.channels.layer);
      computed = p.channels.kind == Kind::computed;
    }
    if (chosen.empty() && parts.insert(subimage.part).second && !subimage.name.empty())
      left.push_back(subimage.name);
    if (chosen.empty() || computed) continue;
    for (const std::string& layer : colour_layers(subimage))
      if (!chosen.count(layer)) left.push_back(shown_name(layer));
  }
  return left;
}

/// Of the first resolution of what is light, channels that look like bands.
std::vector<std::string> bands_beside(const PixelSource& source, const std::vector<LightSubimage>& light) {
  std::vector<std::string> out;
  std::set<std::size_t> seen;
  for (const LightSubimage& p : light) {
    const Subimage& subimage = source.subimages()[p.index];
    if (!subimage.is_full_resolution() || !seen.insert(p.index).second) continue;
    for (const std::string& band : spectral_look_alikes(subimage)) out.push_back(band);
  }
  return out;
}

}  // namespace

std::vector<std::string> notes_of(const PixelSource& source, const std::vector<LightSubimage>& light) {
  std::vector<std::string> notes;
  if (const auto left = left_alone(source, light); !left.empty())
    notes.push_back("layers or parts that are left as they are (--layer takes another, --layers several): " +
                    name_list(left));
  const std::vector<std::string> bands = bands_beside(source, light);
  if (bands.empty()) return notes;
  const bool computed = light.front().channels.kind == Kind::computed;
  notes.push_back(
      computed ? "fluorescence is left out: " + name_list(bands)
               : "R, G, B are taken for its light, though it has what looks like bands of a spectrum (" +
                     name_list(bands) + "), whose names are not those of spectral OpenEXR (S0.500,0nm)");
  return notes;
}

std::string alike_note(const std::vector<LightSubimage>& light) {
  std::vector<std::string> all, metered;
  std::set<std::string> seen;
  for (const LightSubimage& p : light) {
    const std::string name = shown_name(p.name);
    if (!seen.insert(name).second) continue;
    all.push_back(name);
    if (p.metered) metered.push_back(name);
  }
  if (all.size() < 2) return "";
  return "light is " + name_list(all) + " alike; the eye adapts to " +
         (metered.size() == all.size() ? "all of them together" : name_list(metered));
}

}  // namespace scotopic
