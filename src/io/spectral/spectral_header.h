// What an OpenEXR header says about spectral bands.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/subimage.h"
#include "receptors/spectral_weights.h"

namespace scotopic {

/// The attribute "<channel>.wavelength" in metres: a number, or text that begins with one.
std::optional<double> wavelength_attribute(const Imf::Header& header, const std::string& channel);

/// Whether emissiveUnits are watts per steradian and something else, or there are none.
bool states_radiance(const std::string& emissive_units);

/// What radiance is per, by the user's word, else by emissiveUnits; and why, as a sentence.
std::pair<BandUnit, std::string> band_unit_of(const std::string& emissive_units,
                                              const std::optional<BandUnit>& chosen);

/// spectralLayoutVersion of the first part that has another than 1.0; empty where none has.
std::string later_layout(const std::vector<const Imf::Header*>& parts);

/// nm; eight bands over the visible, the fewest that renderers use, lie 50 apart.
inline constexpr double widest_usual_step = 51;
/// What lies between two neighbours, at most, as far as it is within 380 to 780 nm; `centres` rise, nm.
double widest_visible_step(const std::vector<double>& centres);

/// Texts and numbers of a header that also hold for the image made of the bands.
std::vector<Attribute> attributes_without_spectral_ones(const Imf::Header& header);

}  // namespace scotopic
