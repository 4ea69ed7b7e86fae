// What shaders are tried on, and what they are held to.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "shaders/shader.h"
#include "shaders/sliders.h"

namespace scotopic::test {

/// R, G, B, three values a pixel.
using Pixels = std::vector<float>;

/// A row of the table: what the shader is of.
struct ShaderCase {
  std::string name;
  ShaderSpec spec;
};
const std::vector<ShaderCase>& shader_cases();

/// Light: 28 stops, 2^-16 to 2^12 in stops of the largest component, of greys, primaries and what is
/// between them.
const Pixels& light();
/// Colours outside the gamut over the same stops: one or two components below 0, luminance above.
const Pixels& beyond_gamut();

/// What is left over from a cancellation, noise or another gamut's remnants: luminance near 0 between
/// components of either sign.
const Pixels& remnants();

/// Every La of the ladder and beyond both its ends, white from it or given, every strength off, half and on.
std::vector<shaders::SliderValues> settings_of(const ShaderSpec& spec);

/// What the program makes of a pixel, in double.
std::vector<double> wanted(const ShaderSpec& spec, const shaders::SliderValues& sliders,
                           const Pixels& pixels);

/// Where a host that shows `pixels` through a shader is worst: |got - wanted| over the pixel's largest
/// component, of what went in (in units of what comes out) or came out.
struct Worst {
  double error = 0;
  std::string place;
};
using Shown = std::function<Pixels(const shaders::SliderValues&, const Pixels&)>;
Worst worst_of(const ShaderSpec& spec, const Pixels& pixels, const Shown& shown);

}  // namespace scotopic::test
