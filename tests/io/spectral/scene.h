// A night scene made of measured reflectances under measured lamps, as spectral images of every layout; and
// what is true of it, by means that share nothing with the code under test but the tables.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "receptors/spectral_weights.h"
#include "receptors/spectrum.h"

namespace scotopic::test {

/// Values at 360, 361, ... 830 nm, each standing for the nanometre around it.
constexpr int scene_first_nm = 360;
constexpr int scene_last_nm = 830;
using SceneSpectrum = std::vector<double>;

/// The patches of tests/data/reflectances_NAME.csv; constant beyond what was measured.
std::vector<SceneSpectrum> reflectances(const std::string& name);

/// d65, e, moon, a, hps, led3000, led4000 as the product has them, and lps: the sodium doublet at 589.0 and
/// 589.6 nm, 2 to 1 (NIST Atomic Spectra Database).
SceneSpectrum lamp(const std::string& name);

/// Light of each patch under a lamp, such that a perfect white has `cdm2`.
std::vector<SceneSpectrum> lit(const std::vector<SceneSpectrum>& patches, const SceneSpectrum& lamp,
                               double cdm2);

/// The signals of a spectrum of whole nanometres, in long double: sum over wavelength of spectrum times
/// curve.
std::array<double, signal_count> true_signals(const SceneSpectrum& spectrum);

/// Integral of a curve that is straight between its samples, from its first sample to nm: exact.
long double curve_area(const TabulatedCurve& curve, double nm);

/// Evenly spaced bands and the mean of a spectrum over each (centre -+ step/2).
std::vector<double> band_centres(double first, double step, double last);
double band_mean(const SceneSpectrum& spectrum, double low, double high);

/// One channel of an image to write.
struct TestChannel {
  std::string name;
  std::vector<float> values;  ///< width * height
  enum class Type { half, float32, uint32 } type = Type::float32;
};

struct TestImage {
  int width = 0;
  int height = 0;
  int x0 = 0, y0 = 0;
  std::vector<std::vector<TestChannel>> parts;  ///< one entry: a single-part file
  std::vector<std::pair<std::string, std::string>> text_attributes;
  std::vector<std::pair<std::string, float>> number_attributes;
  bool tiled = false;
  int compression = 3;  ///< Imf::Compression; 3 is ZIP
};
void write_exr(const std::string& path, const TestImage& image);

/// Channels of bands for pixels whose spectra are given (pixel i is patch i modulo their number).
std::vector<TestChannel> band_channels(const std::vector<SceneSpectrum>& pixels, int count,
                                       const std::vector<double>& centres, double step,
                                       const std::function<std::string(double)>& name);

/// "S0.450,0nm".
std::string stokes_name(double nm);

/// Macbeth's patches in a row, the same in each row, as a spectral file under a lamp of so many cd/m2; their
/// light.
constexpr int macbeth_patches = 24;
std::vector<SceneSpectrum> write_macbeth(const std::string& file, const std::string& lamp_name, double cdm2,
                                         int rows);

/// A folder of its own for one test, removed at its end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace scotopic::test
