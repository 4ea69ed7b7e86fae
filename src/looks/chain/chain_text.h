// Chains as files: CLF, CTF, and the plain LUT formats.
#pragma once

#include <string>

#include "looks/chain/chain.h"

namespace scotopic {

/// Formats that hold a whole chain.
enum class ChainFormat {
  clf,  ///< Academy/ASC Common LUT Format, S-2014-006, version 3
  ctf,  ///< the same for Autodesk's older readers: Color Transform Format 2.0
};

// No number in these texts is subnormal as a float (it is 0 then); one that is not finite is
// Error(check_failed).

/// XML, the same bytes for the same chain, whatever the locale.
std::string xml_text(const Chain& chain, ChainFormat format);

/// The one 3D LUT of a chain in which nothing but ranges is beside it.
const Lut3DStep& only_lut3d(const Chain& chain);

/// .cube of Resolve and Adobe: LUT_3D_SIZE alone, red fastest, 0 to 1.
std::string cube_text(const Chain& chain);

/// Sony Pictures Imageworks' .spi3d (inputs 0 to 1), which OpenColorIO 1 reads too.
std::string spi3d_text(const Lut3DStep& lut);

}  // namespace scotopic
