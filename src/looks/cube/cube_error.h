// How far a cube is from what it is to hold, as hosts read it.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <array>
#include <string>
#include <vector>

#include "looks/cube/cube_goal.h"
#include "looks/cube/reading.h"

namespace scotopic {

/// Over one set of colours.
struct ReadingError {
  std::array<BakeError, 2> by_reading;  ///< in the order of `readings`
  std::array<double, 2> worst_code{};   ///< the same, of a code out
  double without_code = 0;              ///< share of the colours that the space has no code in 0 to 1 for
  double clamped = 0;                   ///< share of those that come out beyond 0 to 1, so at its end

  /// The reading whose 99 % are worse.
  const BakeError& worse() const noexcept;
};

/// Over Rec.709 colours and over those of the space's own gamut that AP1 holds, cube_darkest to
/// cube_brightest.
struct CubeError {
  ReadingError rec709, own;
};

/// What reads the cube for each of `readings`.
using CubeReaders = std::array<OCIO_NAMESPACE::ConstCPUProcessorRcPtr, 2>;

/// `spec`: an encoded one; `config` holds its spaces. 1e5 colours a set.
CubeError measure_cube(const LookSpec& spec, const ColourConfig& config, const CubeReaders& readers,
                       std::size_t count = 100000);

/// Lines that state it, for files and people: "Rec.709 colours of -8 to 5 stops, tetrahedral: mean ...".
std::vector<std::string> error_lines(const CubeError& error, const LookSpec& spec);

/// What is worth a warning: 99 % beyond 1, which is seen; "" if nothing is.
std::string warning_of(const CubeError& error);

/// CIE XYZ (D65) of the RGB that a space's codes are of.
Matrix3<double> own_gamut(const LookSpec& spec, const ColourConfig& config);

}  // namespace scotopic
