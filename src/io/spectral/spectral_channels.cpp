#include "io/spectral/spectral_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "base/error.h"

namespace scotopic {
namespace {

constexpr double speed_of_light = 299792458.0;  // m/s, exact by definition of the metre
constexpr double nm_per_m = 1e9;

struct SiPrefix {
  std::string_view name;
  double factor;
};
constexpr std::array si_prefixes = {
    SiPrefix{"", 1.0},   SiPrefix{"Y", 1e24}, SiPrefix{"Z", 1e21}, SiPrefix{"E", 1e18}, SiPrefix{"P", 1e15},
    SiPrefix{"T", 1e12}, SiPrefix{"G", 1e9},  SiPrefix{"M", 1e6},  SiPrefix{"k", 1e3},  SiPrefix{"h", 1e2},
    SiPrefix{"da", 1e1}, SiPrefix{"d", 1e-1}, SiPrefix{"c", 1e-2}, SiPrefix{"m", 1e-3}, SiPrefix{"u", 1e-6},
    SiPrefix{"n", 1e-9}, SiPrefix{"p", 1e-12}};

// The Stokes components and reflectance, as the layout names them.
constexpr std::array<std::string_view, 5> sets = {"S0", "S1", "S2", "S3", "T"};
constexpr std::size_t reflectance = 4;

[[noreturn]] void fail_channel(const std::string& channel, const std::string& what) {
  throw Error(ExitCode::input, "", fmt::format("channel \"{}\": {}", channel, what));
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Length of the number at the start: digits, decimal comma, exponent. An E that no digit follows is a prefix.
std::size_t number_length(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size() &&
         (is_digit(text[length]) || std::string_view(".,+-").find(text[length]) != text.npos))
    ++length;
  if (length < text.size() && (text[length] == 'e' || text[length] == 'E')) {
    std::size_t end = length + 1;
    if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
    const std::size_t first_digit = end;
    while (end < text.size() && is_digit(text[end])) ++end;
    if (end > first_digit) length = end;
  }
  return length;
}

double parse_number(std::string_view text, const std::string& channel) {
  std::string digits(text);
  const auto commas = std::count(digits.begin(), digits.end(), ',');
  const auto points = std::count(digits.begin(), digits.end(), '.');
  if (std::none_of(digits.begin(), digits.end(), is_digit)) fail_channel(channel, "has no number");
  if (commas > 0 && points > 0) fail_channel(channel, "mixes decimal comma and decimal point");
  if (points > 0) fail_channel(channel, "has a decimal point where the layout has a comma");
  if (commas > 1) fail_channel(channel, "has more than one decimal comma");
  if (digits.front() == '-') fail_channel(channel, "has a negative wavelength");
  std::replace(digits.begin(), digits.end(), ',', '.');
  double value = 0.0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range || !std::isfinite(value))
    fail_channel(channel, "has a number out of range");
  if (error != std::errc() || stop != digits.data() + digits.size())
    fail_channel(channel, "has a malformed number");
  return value;
}

std::optional<double> factor_of_prefix(std::string_view name) {
  for (const SiPrefix& prefix : si_prefixes)
    if (prefix.name == name) return prefix.factor;
  return std::nullopt;
}

/// What stands before the set's name, which set, and the wavelength's text.
struct BandName {
  std::string layer;
  std::size_t set;
  std::string_view wavelength;
};

// Nothing but number characters, then a unit: that is a band, well-formed or not. Anything else is not.
bool looks_like_wavelength(std::string_view text) {
  const std::string_view unit = text.substr(number_length(text));
  for (const std::string_view base : {std::string_view("m"), std::string_view("Hz")})
    if (unit.size() >= base.size() && unit.substr(unit.size() - base.size()) == base &&
        factor_of_prefix(unit.substr(0, unit.size() - base.size())))
      return true;
  return false;
}

std::optional<BandName> band_name(std::string_view name) {
  for (std::size_t start = 0; start < name.size();) {
    const std::size_t dot = name.find('.', start);
    if (dot == name.npos) return std::nullopt;
    const auto set = std::find(sets.begin(), sets.end(), name.substr(start, dot - start));
    if (set != sets.end() && looks_like_wavelength(name.substr(dot + 1)))
      return BandName{std::string(name.substr(0, start == 0 ? 0 : start - 1)),
                      static_cast<std::size_t>(set - sets.begin()), name.substr(dot + 1)};
    start = dot + 1;
  }
  return std::nullopt;
}

using BandSets = std::array<std::vector<SpectralBand>, sets.size()>;

void sort_bands(std::vector<SpectralBand>& bands, std::span<const ChannelName> channels) {
  std::sort(bands.begin(), bands.end(), [](const auto& a, const auto& b) { return a.nm < b.nm; });
  for (std::size_t i = 1; i < bands.size(); ++i)
    // Names carry at most seven digits or so: closer bands than that are one band named twice.
    if (bands[i].nm - bands[i - 1].nm <= 1e-7 * bands[i].nm)
      fail_channel(channels[bands[i].channel].name,
                   fmt::format("is the same band as channel \"{}\"", channels[bands[i - 1].channel].name));
}

bool same_grid(const std::vector<SpectralBand>& a, const std::vector<SpectralBand>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return std::abs(x.nm - y.nm) <= 1e-7 * x.nm;
         });
}

SpectralLayout layout_of_sets(BandSets& found, std::span<const ChannelName> channels) {
  for (auto& bands : found) sort_bands(bands, channels);
  for (std::size_t set = 1; set < reflectance; ++set)
    if (!found[set].empty() && !same_grid(found[0], found[set]))
      throw Error(ExitCode::input, "", fmt::format("{} and S0 do not have the same bands", sets[set]));
  SpectralLayout layout;
  layout.kind = found[0].empty() ? SpectralKind::reflective : SpectralKind::emissive;
  if (!found[1].empty() || !found[2].empty() || !found[3].empty())
    layout.notes.emplace_back("polarisation (S1 to S3) is ignored");
  if (!found[0].empty() && !found[reflectance].empty()) {
    if (!same_grid(found[0], found[reflectance]))
      throw Error(ExitCode::input, "", "S0 and T do not have the same bands");
    layout.notes.emplace_back("reflectance (T) is ignored, emission (S0) is used");
  }
  layout.bands = std::move(found[0].empty() ? found[reflectance] : found[0]);
  return layout;
}

std::map<std::string, BandSets> sets_by_layer(std::span<const ChannelName> channels) {
  std::map<std::string, BandSets> layers;
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (const auto band = band_name(channels[i].name))
      layers[band->layer][band->set].push_back({i, wavelength_from_text(band->wavelength, channels[i].name)});
  return layers;
}

bool is_ocean_name(std::string_view name) {
  return name.size() > 2 && name.substr(0, 2) == "wl" && std::all_of(name.begin() + 2, name.end(), is_digit);
}

SpectralLayout ocean_layout(std::span<const ChannelName> channels) {
  SpectralLayout layout;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!is_ocean_name(channels[i].name)) continue;
    if (!channels[i].wavelength_m) fail_channel(channels[i].name, "has no attribute with its wavelength");
    const double nm = *channels[i].wavelength_m * nm_per_m;
    if (!(std::isfinite(nm) && nm > 0.0))
      fail_channel(channels[i].name, "has a wavelength that is not positive");
    layout.bands.push_back({i, nm});
  }
  sort_bands(layout.bands, channels);
  return layout;
}

std::string layer_names(const std::map<std::string, BandSets>& layers) {
  std::string names;
  for (const auto& layer : layers) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", layer.first);
  return names;
}

std::optional<SpectralLayout> search(std::span<const ChannelName> channels, const std::string& layer,
                                     const std::string& file) {
  auto layers = sets_by_layer(channels);
  if (layers.empty()) {
    SpectralLayout ocean = ocean_layout(channels);
    return ocean.bands.empty() ? std::nullopt : std::optional(std::move(ocean));
  }
  auto chosen = layers.size() == 1 && layer.empty() ? layers.begin() : layers.find(layer);
  if (chosen == layers.end())
    throw Error(ExitCode::input, file,
                fmt::format("has bands in {}: {}", layer.empty() ? "several layers" : "other layers only",
                            layer_names(layers)));
  SpectralLayout layout = layout_of_sets(chosen->second, channels);
  return layout;
}

}  // namespace

bool is_spectral_channel(std::string_view name) { return band_name(name).has_value() || is_ocean_name(name); }

double wavelength_from_text(std::string_view text, const std::string& channel) {
  const std::size_t length = number_length(text);
  const std::string_view unit = text.substr(length);
  const bool hertz = unit.size() >= 2 && unit.substr(unit.size() - 2) == "Hz";
  const bool metre = !unit.empty() && unit.back() == 'm';
  if (!hertz && !metre) fail_channel(channel, "has neither a wavelength in m nor a frequency in Hz");
  const auto factor = factor_of_prefix(unit.substr(0, unit.size() - (hertz ? 2 : 1)));
  if (!factor) fail_channel(channel, "has an unknown unit");
  const double value = parse_number(text.substr(0, length), channel) * *factor;
  const double nm = value == 0 ? 0 : nm_per_m * (hertz ? speed_of_light / value : value);
  if (!(std::isfinite(nm) && nm > 0.0))
    fail_channel(channel, "has a wavelength that is not positive and finite");
  return nm;
}

std::optional<SpectralLayout> find_spectral_layout(std::span<const ChannelName> channels,
                                                   const std::string& layer, const std::string& file) {
  try {
    return search(channels, layer, file);
  } catch (const Error& error) {
    throw Error(error.code(), file, error.what());
  }
}

SpectralLayout receptor_layout(std::span<const ChannelName> channels, std::span<const std::string> names,
                               const std::string& file) {
  if (names.size() != 4)
    throw Error(ExitCode::usage, "", "four channels are needed: for L, M, S and the rods");
  SpectralLayout layout;
  layout.kind = SpectralKind::receptors;
  for (const std::string& name : names) {
    const auto found =
        std::find_if(channels.begin(), channels.end(), [&](const ChannelName& c) { return c.name == name; });
    if (found == channels.end())
      throw Error(ExitCode::input, file, fmt::format("has no channel \"{}\"", name));
    layout.bands.push_back({static_cast<std::size_t>(found - channels.begin()), 0.0});
  }
  return layout;
}

}  // namespace scotopic
