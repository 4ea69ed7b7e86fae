// Transfer functions of image files: encoded values to linear light and back.
#pragma once

#include <string>

#include "kernel/matrix3.h"

namespace scotopic {

/// cd/m2 of HDR reference white, value 1 of what PQ and HLG decode to (ITU-R BT.2408-7, 2.1).
inline constexpr double hdr_reference_white = 203.0;

/// Which function decodes a file's values.
enum class Transfer {
  linear,
  srgb,   ///< IEC 61966-2-1, piecewise
  power,  ///< a pure power of `exponent`
  pq,     ///< SMPTE ST 2084, absolute
  hlg,    ///< ITU-R BT.2100 hybrid log-gamma on a display of 1000 cd/m2 (system gamma 1.2)
  dcdm,   ///< SMPTE ST 428-1: power 2.6 with headroom 52.37/48
};

/// A transfer function, and how code values are scaled before it (narrow-range video).
struct TransferCurve {
  Transfer kind = Transfer::linear;
  double exponent = 1;
  double scale = 1;   ///< of the file's value, then
  double offset = 0;  ///< added

  /// Whether values are light as they are.
  bool linear() const noexcept { return kind == Transfer::linear && scale == 1 && offset == 0; }
  /// Whether value 1 has a luminance of its own: hdr_reference_white.
  bool absolute() const noexcept { return kind == Transfer::pq || kind == Transfer::hlg; }
  bool operator==(const TransferCurve&) const = default;

  /// Linear light of an encoded pixel, 1 being (reference) white; encode() is its inverse, to 1e-12 relative
  /// within 0..1 of the encoding. Beyond 0 as the Color Interop Forum has it: power functions let negative
  /// values pass, sRGB goes on with its slope at 0; PQ and HLG have none and give 0. Through the channels of
  /// HLG runs one system gamma.
  Vec3<double> decode(const Vec3<double>& encoded) const;
  Vec3<double> encode(const Vec3<double>& light) const;
};

/// "linear", "sRGB curve", "gamma 2.2", "PQ", ...
std::string describe(const TransferCurve& curve);

}  // namespace scotopic
