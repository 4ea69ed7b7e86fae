#include "files/corpus/corpus.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "pipeline/apply_image.h"

namespace scotopic::test {
namespace {

using Matrix = std::array<Rgb, 3>;

// ASTM E308: D50 of ICC.1, and D65.
constexpr Rgb d50 = {0.9642, 1, 0.8249};
constexpr Rgb d65 = {0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};
// Lam 1985, as CIECAM97s has it.
constexpr Matrix bradford_cones{
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

Rgb times(const Matrix& m, const Rgb& v) {
  Rgb out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i] += m[i][j] * v[j];
  return out;
}

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) out[i][j] += a[i][k] * b[k][j];
  return out;
}

/// By Cramer's rule.
Matrix inverse(const Matrix& m) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = minor(j, i) / det;
  return out;
}

Matrix adapted(const Rgb& from, const Rgb& to) {
  const Rgb a = times(bradford_cones, from), b = times(bradford_cones, to);
  const Matrix scale{{{b[0] / a[0], 0, 0}, {0, b[1] / a[1], 0}, {0, 0, b[2] / a[2]}}};
  return times(inverse(bradford_cones), times(scale, bradford_cones));
}

Rgb xyz_of(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

Matrix matrix_of(const Chromaticities& c) {
  Matrix columns{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = c[2 * i], y = c[2 * i + 1];
    const Rgb column = {x, y, 1 - x - y};
    for (std::size_t row = 0; row < 3; ++row) columns[row][i] = column[row];
  }
  const Rgb white = xyz_of(c[6], c[7]), scale = times(inverse(columns), white);
  for (Rgb& row : columns)
    for (std::size_t i = 0; i < 3; ++i) row[i] *= scale[i];
  return times(adapted(white, d65), columns);
}

double decode(double v, double power) {
  if (power == 0) return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  return v > 0 ? std::pow(v, power) : v;
}

/// What OpenImageIO reads: RGBA rows, grey thrice, alpha 1 where there is none.
struct Reading {
  int width = 0, height = 0;
  bool straight = false;
  std::vector<std::array<double, 4>> pixels;
};

Reading read(const std::string& file) {
  Reading out;
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = OIIO::ImageInput::open(file, &hints);
  if (!in) return out;
  const OIIO::ImageSpec& spec = in->spec();
  out.width = spec.width;
  out.height = spec.height;
  out.straight = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
  const auto n = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> values(static_cast<std::size_t>(spec.width * spec.height) * n);
  in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data());
  const auto alpha = [&](std::size_t i) { return n % 2 == 0 ? values[i + n - 1] : 1.0f; };
  for (std::size_t i = 0; i < values.size(); i += n)
    out.pixels.push_back({values[i], values[i + (n > 2 ? 1 : 0)], values[i + (n > 2 ? 2 : 0)], alpha(i)});
  return out;
}

/// Light of a pixel: straight colour is decoded and multiplied by alpha; of encoded colour that alpha stands
/// before, that is undone first.
Rgb light_of(const std::array<double, 4>& pixel, bool straight, const MeaningInXyz& meaning) {
  const double alpha = pixel[3];
  const bool again = !straight && meaning.encoded() && alpha > 0;
  Rgb values = {pixel[0], pixel[1], pixel[2]};
  for (double& v : values) v /= again ? alpha : 1;
  Rgb out = meaning(values);
  for (double& v : out) v *= straight || again ? alpha : 1;
  return out;
}

/// Where an upright pixel is stored: Exif's orientations, written as a table of (x, y).
std::pair<int, int> stored(int orientation, int x, int y, int w, int h) {
  const std::array<std::pair<int, int>, 9> table = {{{x, y},
                                                     {x, y},
                                                     {w - 1 - x, y},
                                                     {w - 1 - x, h - 1 - y},
                                                     {x, h - 1 - y},
                                                     {y, x},
                                                     {y, h - 1 - x},
                                                     {w - 1 - y, h - 1 - x},
                                                     {w - 1 - y, x}}};
  return table[static_cast<std::size_t>(orientation)];
}

void treat(const std::string& in, const std::string& out) {
  static const ColourConfig config = ColourConfig::own();
  ImageRequest request;
  request.output_colourspace = "CIE XYZ-D65";
  request.type = PixelType::float32;
  OutputFile file(out);
  const std::unique_ptr<PixelSource> source = open_source(in, Limits());
  const ImageLayout layout = plan_layout(*source, out, config, request);
  apply_image(*source, layout, config, ImageStages(), file);
}

double worst_difference(const Sample& sample, const std::string& out) {
  const Reading in = read(sample.file), got = read(out);
  const MeaningInXyz meaning(sample.meaning);
  const bool turned = sample.orientation >= 5;
  if (in.pixels.empty() || got.width != (turned ? in.height : in.width) ||
      got.height != (turned ? in.width : in.height))
    return INFINITY;
  double worst = 0;
  for (int y = 0; y < got.height; ++y)
    for (int x = 0; x < got.width; ++x) {
      const auto [sx, sy] = stored(sample.orientation, x, y, in.width, in.height);
      const auto& p = in.pixels[static_cast<std::size_t>(sy * in.width + sx)];
      const auto& g = got.pixels[static_cast<std::size_t>(y * got.width + x)];
      const Rgb wanted = light_of(p, in.straight, meaning);
      const double size = std::abs(wanted[0]) + std::abs(wanted[1]) + std::abs(wanted[2]) + 0.01;
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(g[c] - wanted[c] * sample.gain) / size / std::max(1.0, sample.gain));
    }
  return worst;
}

/// Whether OpenImageIO's pixels are those that were meant; what it itself misreads shows here.
bool are_meant(const Sample& sample) {
  const Reading in = read(sample.file);
  if (sample.values.size() != 3 * in.pixels.size()) return sample.values.empty();
  for (std::size_t i = 0; i < sample.values.size(); ++i)
    if (!(std::abs(in.pixels[i / 3][i % 3] - static_cast<double>(sample.values[i])) <= sample.step))
      return false;
  return true;
}

}  // namespace

std::vector<double> alpha_in(const std::string& file) {
  std::vector<double> out;
  for (const auto& pixel : read(file).pixels) out.push_back(pixel[3]);
  return out;
}

MeaningInXyz::MeaningInXyz(const Meaning& meaning) : meaning_(meaning) {
  if (meaning_.profile.empty()) {
    matrix_ = matrix_of(meaning_.primaries);
    return;
  }
  matrix_ = adapted(d50, d65);
  const cmsHPROFILE from =
      cmsOpenProfileFromMem(meaning_.profile.data(), static_cast<cmsUInt32Number>(meaning_.profile.size()));
  const cmsHPROFILE to = cmsCreateXYZProfile();
  transform_ = cmsCreateTransform(from, TYPE_RGB_DBL, to, TYPE_XYZ_DBL, INTENT_RELATIVE_COLORIMETRIC,
                                  cmsFLAGS_NOOPTIMIZE | cmsFLAGS_NOCACHE);
  cmsCloseProfile(from);
  cmsCloseProfile(to);
}

MeaningInXyz::~MeaningInXyz() {
  if (transform_) cmsDeleteTransform(transform_);
}

Rgb MeaningInXyz::operator()(const Rgb& values) const {
  Rgb out{};
  if (transform_)
    cmsDoTransform(transform_, values.data(), out.data(), 1);
  else
    for (std::size_t c = 0; c < 3; ++c) out[c] = decode(values[c], meaning_.power);
  return times(matrix_, out);
}

bool MeaningInXyz::encoded() const { return transform_ || meaning_.power != 1; }

void judge(const Sample& sample, Tally& tally) {
  ++tally.files;
  const std::string out = place("out.exr");
  try {
    treat(sample.file, out);
  } catch (const Error& e) {
    ++tally.refused;
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << sample.what;
    return;
  }
  const double difference = worst_difference(sample, out);
  const bool right = difference < 1e-3 && are_meant(sample);
  right ? ++tally.right : ++tally.wrong;
  EXPECT_TRUE(right) << sample.what << ": off by " << difference
                     << (are_meant(sample) ? "" : ", and its values are not those that were meant");
  if (difference <= tally.worst) return;
  tally.worst = difference;
  tally.worst_at = sample.what;
}

void close(const char* name, const Tally& tally) {
  std::printf("%s: %d files, %d right, %d refused, %d silently wrong; worst %.2g (%s)\n", name, tally.files,
              tally.right, tally.refused, tally.wrong, tally.worst, tally.worst_at.c_str());
  EXPECT_EQ(tally.wrong, 0);
}

}  // namespace scotopic::test
