// What looks are called.
#pragma once

#include <string>

#include "adaptation/named_adaptations.h"
#include "looks/lut/look_spec.h"

namespace scotopic {

/// "Mesopic 0.1 nit (street lighting)"; "Photopic 10 nit (lamplit room)" where nothing changes; of an eye
/// that is used to a lamp "Mesopic 0.1 nit lamp 0.5266 0.4133", its x and y, " dim" or " dark" behind for
/// such surrounds; for models other than the default, " kirk2011" follows. No comma, colon, bar or slash, no
/// leading sign, < 64 bytes: OCIO lists looks with them.
std::string look_name(const LookSpec& spec);
/// Without a lamp.
std::string look_name(const AppearanceParameters& parameters);

/// "Night 0.1 nit (street lighting)": as dark as the eye sees it; a lamp as above.
std::string night_name(const LookSpec& spec);

/// "night_rec709_0.1", "night_rec2020_1000_0.1": of a LUT with the display stage.
std::string night_file_stem(const LookSpec& spec);

/// Whether the look leaves every pixel as it is.
bool is_identity(const AppearanceParameters& parameters);
/// The same of one without a display behind it.
bool is_identity(const LookSpec& spec);

/// "filament2021_0.1", "filament2021_0.1_lamp_0.5266_0.4133": without extension.
std::string look_file_stem(const LookSpec& spec);

/// What of a stem says the lamp; empty without one.
std::string lamp_stem(const LookSpec& spec);

/// "0.1": shortest decimal.
std::string adaptation_text(double adaptation);

}  // namespace scotopic
