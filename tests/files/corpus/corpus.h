// Files by the thousand: what each means, told from its tags by other means than the program's, and what the
// program makes of it, both in CIE XYZ.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "files/made_files.h"

namespace scotopic::test {

/// x, y of red, green, blue and white.
using Chromaticities = std::array<double, 8>;

constexpr Chromaticities bt709 = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
constexpr Chromaticities adobe_rgb = {0.64, 0.33, 0.21, 0.71, 0.15, 0.06, 0.3127, 0.3290};
// SMPTE ST 2065-1 and the Academy's S-2014-004.
constexpr Chromaticities ap0 = {0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767};
constexpr Chromaticities ap1 = {0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767};

/// What values mean, by the file's tags.
struct Meaning {
  double power = 1;  ///< that decodes; 0: the curve of IEC 61966-2-1
  Chromaticities primaries = bt709;
  std::string profile = {};  ///< ICC; in place of both
};

/// From values to CIE XYZ of D65, in double: matrices by SMPTE RP 177, Bradford's adaptation, profiles
/// through LittleCMS.
class MeaningInXyz {
 public:
  explicit MeaningInXyz(const Meaning& meaning);
  ~MeaningInXyz();
  MeaningInXyz(const MeaningInXyz&) = delete;
  MeaningInXyz& operator=(const MeaningInXyz&) = delete;

  Rgb operator()(const Rgb& values) const;
  /// Light is not the values times a matrix: alpha stands after the curve.
  bool encoded() const;

 private:
  Meaning meaning_;
  std::array<Rgb, 3> matrix_{};
  void* transform_ = nullptr;
};

/// Pixels of the files that are made here.
constexpr int sample_width = 19, sample_height = 11;

struct Sample {
  std::string file;
  std::string what;
  Meaning meaning;
  int orientation = 1;
  double gain = 1;  ///< light is this times what values mean
  std::vector<float> values =
      {};           ///< R, G, B of each stored pixel as they were meant, where the format keeps them
  double step = 0;  ///< and how far off they may be
};

/// Of files judged.
struct Tally {
  int files = 0, right = 0, refused = 0, wrong = 0;
  double worst = 0;
  std::string worst_at;
};

/// Of each stored pixel; 1 where there is none.
std::vector<double> alpha_in(const std::string& file);

/// Runs the file through the operator by daylight, to CIE XYZ, and compares it with what OpenImageIO's pixels
/// mean.
void judge(const Sample& sample, Tally& tally);

/// Prints the tally, and fails for a file that is wrong.
void close(const char* name, const Tally& tally);

}  // namespace scotopic::test
