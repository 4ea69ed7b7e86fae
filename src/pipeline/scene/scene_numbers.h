// La and the unit of an image: which numbers are used, and where each comes from.
#pragma once

#include <optional>
#include <string>

#include "io/pixel_source.h"
#include "pipeline/notes.h"
#include "pipeline/settings.h"
#include "scene/scene_statistics.h"

namespace scotopic {

struct SceneNumbers {
  double adaptation = 0;       ///< La, cd/m2
  double white_luminance = 0;  ///< cd/m2 of image value 1
  std::string adaptation_source;
  std::string white_luminance_source;
  bool of_file = false;  ///< the unit is the file's own
};

/// What is known before a pixel is read.
struct KnownNumbers {
  std::optional<double> adaptation;  ///< --adaptation, or a shot's
  std::string adaptation_source = "--adaptation";
  std::optional<double> white_luminance;  ///< --white-luminance
  std::optional<double> file_unit;        ///< the file's own
  std::string file_unit_source;
  std::string metering;  ///< how the adaptation is metered, if it is
};

/// cd/m2 that value 1 of a subimage stands for by its header, and how it is told.
struct FileUnit {
  std::optional<double> luminance;
  std::string source;
};
FileUnit file_unit(const Subimage& subimage, ColourChannels::Kind kind);

/// From the options and the file's header. A unit in the file that is no luminance is ignored, with a note.
KnownNumbers known_numbers(const OperatorChoice& choice, const PixelSource& source, const ImageLayout& layout,
                           const Notes& notes);

/// The luminance that a method takes the eye to be adapted to, in image values.
double metered(const SceneStatistics& statistics, const AdaptationMethod& method);

/// True if the adaptation is to be metered. Error(usage) if that alone would not do: an average
/// in image values tells no luminance where nobody knows the unit.
bool needs_measurement(const KnownNumbers& known, const std::string& file);

/// cd/m2 that image value 1 stands for, as told by the user, else by the file.
std::optional<double> unit_of(const KnownNumbers& known);

/// The user's unit, else the file's, else La/.18: the scene's middle grey is what the eye is adapted to.
/// `metered` in image values, where needed; Error(input) if it is 0.
SceneNumbers resolve_numbers(const KnownNumbers& known, double metered, const std::string& file);

/// "adaptation .1 cd/m2 (--adaptation), image value 1 is .55 cd/m2 (...)".
std::string describe(const SceneNumbers& numbers);

}  // namespace scotopic
