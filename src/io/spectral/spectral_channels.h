// Which channels of an image are spectral bands, and of what wavelength.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scotopic {

/// A channel as far as a name and its attribute tell.
struct ChannelName {
  std::string name;
  /// The attribute "<name>.wavelength", metres, as the Ocean renderer writes it.
  std::optional<double> wavelength_m;
};

/// What the bands hold.
enum class SpectralKind {
  emissive,    ///< spectral radiance
  reflective,  ///< reflectance: light comes from an illuminant
  receptors    ///< four channels, already weighed with l, m, s and V'
};

/// One band, by its centre.
struct SpectralBand {
  std::size_t channel;  ///< index into the channels that were searched
  double nm;
};

/// All bands of an image.
struct SpectralLayout {
  SpectralKind kind = SpectralKind::emissive;
  /// Bands by ascending wavelength; receptors: L, M, S, R, with nm 0.
  std::vector<SpectralBand> bands;
  /// What was found but is not used, one sentence each.
  std::vector<std::string> notes;
};

/// Whether a name is that of a band or a Stokes component, well-formed or not.
bool is_spectral_channel(std::string_view name);

/// Wavelength in nm of "450nm", "4,5e2nm", "0,45um", "666,2THz": a number with decimal comma, then a unit of
/// length or frequency with its SI prefix. `channel` is what messages call it. Throws Error(ExitCode::input).
double wavelength_from_text(std::string_view text, const std::string& channel);

/// The bands among `channels`: of the layout of Fichet, Pacanowski & Wilkie (JCGT 10(3), 2021), S0 before T,
/// or of Ocean's wl0, wl1, ... nullopt if there are none. `layer` picks one where several have bands; empty:
/// the only one. Throws Error(ExitCode::input or limit, file) for bands that contradict the layout or each
/// other.
std::optional<SpectralLayout> find_spectral_layout(std::span<const ChannelName> channels,
                                                   const std::string& layer, const std::string& file);

/// Four channels named by the user, in the order L, M, S, R.
SpectralLayout receptor_layout(std::span<const ChannelName> channels, std::span<const std::string> names,
                               const std::string& file);

}  // namespace scotopic
