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

/// Texts and numbers of a header that also hold for the image made of the bands.
std::vector<Attribute> attributes_without_spectral_ones(const Imf::Header& header);

}  // namespace scotopic
