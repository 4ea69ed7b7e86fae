// How far a bake is from the operator, measured through OCIO itself.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/batch.h"
#include "looks/lut/look_spec.h"

namespace scotopic {

/// Planar linear RGB.
struct Colours {
  std::vector<float> r, g, b;
  /// Number of colours.
  std::size_t size() const { return r.size(); }
};

/// All of them as rows that an operator computes in place.
PixelRows rows_of(Colours& colours);

/// Stops of white that colours lie between, and where the sequence of their mixtures begins (0 to 1).
struct StopRange {
  double low = -20, high = 8;
  double start = 0.5;
};

/// The same `count` colours on every machine: brightness evenly over the stops of `range`,
/// in the gamut with matrix xyz_from_gamut, converted to xyz_from_rgb. A quarter each: even over the faces of
/// the RGB cube twice, strong colours (components cubed), and colours on the gamut's border.
Colours stop_colours(std::size_t count, const Matrix3<double>& xyz_from_gamut,
                     const Matrix3<double>& xyz_from_rgb, const StopRange& range = {});

/// How many of linear RGB colours lie outside AP1, beyond what rounding to float puts there.
std::size_t outside_ap1(const Colours& colours, const Matrix3<double>& xyz_from_rgb);

/// CIEDE2000 at equal exposure (stages/shared/colour_difference.h) between what should be and what is.
struct BakeError {
  double mean = 0, p99 = 0, max = 0;
  Vec3<double> worst{}, expected{}, got{};  ///< linear RGB in, wanted and given where the error is greatest
  std::size_t samples = 0;
  std::size_t worst_index = 0;  ///< counted over all pixels that were compared
  /// Pixels outside AP1, which a look clamps to its border - imaginary colours most of them, as compression
  /// makes - are counted here and nowhere else.
  std::size_t outside = 0;
  double outside_max = 0;
};

/// Gathers differences batch by batch; 4 bytes for each pixel.
class Comparison {
 public:
  /// For linear RGB that this matrix takes to XYZ (D65).
  explicit Comparison(const Matrix3<double>& xyz_from_rgb);

  /// How different two XYZ (D65) are; the default is exposed_difference().
  using Difference = double (*)(const Vec3<double>& expected, const Vec3<double>& got);
  Comparison(const Matrix3<double>& xyz_from_rgb, Difference difference);

  /// Planar linear RGB, all of one size.
  void add(const Colours& in, const Colours& expected, const Colours& got);
  /// Over all that was added.
  BakeError result() const;

 private:
  Matrix3<double> xyz_from_rgb_;
  Difference difference_;
  Matrix3<double> ap1_from_rgb_;
  std::size_t seen_ = 0;
  std::vector<float> differences_;
  double sum_ = 0;
  BakeError worst_;
};

/// The operator's result, float rounded from double.
Colours exact(const AppearanceParameters& parameters, Colours colours);

/// Light as the eye sees it that is used to the lamp; as it comes where there is none.
Colours seen_under(const std::optional<Lamp>& lamp, const AppearanceParameters& parameters, Colours colours);

/// Through an OCIO processor, in place.
void apply(const OCIO_NAMESPACE::ConstCPUProcessorRcPtr& processor, Colours& colours);

/// exact() against the processor on 1e5 stop_colours of a gamut.
BakeError measure_bake(const AppearanceParameters& parameters,
                       const OCIO_NAMESPACE::ConstCPUProcessorRcPtr& processor,
                       const Matrix3<double>& xyz_from_gamut, std::size_t count = 100000,
                       const std::optional<Lamp>& lamp = std::nullopt);

/// The operator and the display stage behind it; linear light of the display in the RGB that goes in, 1 = its
/// peak.
Colours exact_night(const AppearanceParameters& parameters, const NightDisplayParameters& display,
                    Colours colours);

/// exact_night() against a processor whose 1 is display_white, on the display-referred light itself:
/// CIEDE2000 of what a display of 100 cd/m2 shows; above that peak, 720 times the distance in ICtCp (ITU-R
/// BT.2124).
BakeError measure_night(const AppearanceParameters& parameters, const NightDisplayParameters& display,
                        const OCIO_NAMESPACE::ConstCPUProcessorRcPtr& processor,
                        const Matrix3<double>& xyz_from_gamut, std::size_t count = 100000,
                        const std::optional<Lamp>& lamp = std::nullopt);

/// The look of `spec`, a linear one, on colours of the gamut that it takes: by either of the above.
BakeError measure_look(const LookSpec& spec, const OCIO_NAMESPACE::ConstCPUProcessorRcPtr& processor);

/// Pixels with NaN, infinities, negatives and denormals in every place: how many components come out not
/// finite, and whether alpha kept its bits.
struct OddPixels {
  std::size_t tested = 0, not_finite = 0, alpha_changed = 0;
  bool black_stays_black = true;
};
/// Runs such pixels through a processor.
OddPixels odd_pixels(const OCIO_NAMESPACE::ConstCPUProcessorRcPtr& processor);

/// "mean 0.031, 99 % 0.17, max 0.45"
std::string error_text(const BakeError& error);

}  // namespace scotopic
