#include "pipeline/scene/scene_numbers.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"

namespace scotopic {
std::optional<double> unit_of(const KnownNumbers& known) {
  return known.white_luminance ? known.white_luminance : known.file_unit;
}

FileUnit file_unit(const Subimage& subimage, ColourChannels::Kind kind) {
  using Kind = ColourChannels::Kind;
  if (kind == Kind::lmsr && subimage.lmsr_unit) return {subimage.lmsr_unit, "the file's scotopic:lmsrUnit"};
  return {subimage.white_luminance,
          kind == Kind::computed ? "spectral radiance is absolute" : "the file's whiteLuminance"};
}

KnownNumbers known_numbers(const OperatorChoice& choice, const PixelSource& source, const ImageLayout& layout,
                           const Notes& notes) {
  KnownNumbers known;
  known.adaptation = choice.adaptation;
  known.adaptation_source = choice.adaptation_source;
  known.metering = choice.metering.description;
  known.white_luminance = choice.white_luminance;
  const LightSubimage& light = layout.light.front();
  const Subimage& subimage = source.subimages()[light.index];
  const FileUnit unit = file_unit(subimage, light.channels.kind);
  known.file_unit = unit.luminance;
  known.file_unit_source = unit.source;
  if (light.space.curve.absolute()) {
    known.file_unit = hdr_reference_white;
    known.file_unit_source = describe(light.space.curve) + ": 1 is the reference white of BT.2408";
  }
  // The range of --white-luminance.
  if (known.file_unit && !(*known.file_unit >= 1e-9 && *known.file_unit <= 1e9)) {
    notes.note(fmt::format("{}: {} of {} is no luminance, and ignored", source.file(), known.file_unit_source,
                           *known.file_unit));
    known.file_unit.reset();
  }
  return known;
}

double metered(const SceneStatistics& s, const AdaptationMethod& method) {
  return method.quantile ? s.photopic.quantile(*method.quantile) : s.log_mean_luminance();
}

bool needs_measurement(const KnownNumbers& known, const std::string& file) {
  if (known.adaptation) return false;
  if (!unit_of(known))
    throw Error(ExitCode::usage, file, "absolute luminance unknown: give --adaptation or --white-luminance");
  return true;
}

SceneNumbers resolve_numbers(const KnownNumbers& known, double metered, const std::string& file) {
  SceneNumbers out;
  const std::optional<double> unit = unit_of(known);
  if (known.adaptation) {
    out.adaptation = *known.adaptation;
    out.adaptation_source = known.adaptation_source;
  } else {
    out.adaptation = metered * unit.value();
    out.adaptation_source = "auto: " + known.metering;
    if (!(out.adaptation > 0))
      throw Error(ExitCode::input, file,
                  "is black where it is metered: it adapts the eye to nothing; give --adaptation");
  }
  out.white_luminance = unit.value_or(out.adaptation / middle_grey);
  out.white_luminance_source = known.white_luminance ? "--white-luminance"
                               : known.file_unit
                                   ? known.file_unit_source
                                   : "adaptation/.18: middle grey is what the eye is adapted to";
  out.of_file = !known.white_luminance && known.file_unit;
  return out;
}

std::string describe(const SceneNumbers& n) {
  return fmt::format("adaptation {:.4g} cd/m2 ({}), image value 1 is {:.4g} cd/m2 ({})", n.adaptation,
                     n.adaptation_source, n.white_luminance, n.white_luminance_source);
}

}  // namespace scotopic
