// Rows of the pyramid, vectorised; no operation is fused, so that every instruction set gives the same bits.
// A row has zeros around it (plane.h); results may run up to 31 floats past `width`: end_row clears those.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace scotopic::contrast {

/// Added to all light before the logarithm, in units of the adaptation luminance: below a thousandth of that,
/// which no eye tells from black, light differs by its difference and not by its ratio. Black has a
/// logarithm, and noise about black is no contrast.
inline constexpr float darkest = 1e-3f;

/// Linear RGB to luminance relative to the adaptation luminance.
struct LightWeights {
  float r, g, b;
};

/// Pixels of a row, or where they go.
struct RgbRow {
  const float *r, *g, *b;
};
struct RgbOut {
  float *r, *g, *b;
};

/// Rows of level 0.
struct LightRow {
  float* light;    ///< luminance, at least 0, and `darkest`; 0 where there is none
  float* log;      ///< its log2; 0 where there is none
  float* present;  ///< 1, or 0 where a component is not finite or beyond 2^120
};

/// True where all pixels are present.
bool light_row(const LightWeights& weights, const RgbRow& in, int width, const LightRow& out);

/// log2 of positive numbers in place, to 1 ulp of the larger of it and 1; 0 stays 0.
void log_row(float* row, int width);

struct WeightedRow {
  const float* row;
  float weight;
};
/// The sum in the order given; none: zeros.
void sum_rows(std::span<const WeightedRow> rows, float* out, int width);

/// out[i] = (in[2i-2] + 4 in[2i-1] + 6 in[2i] + 4 in[2i+1] + in[2i+2])/16
void halve_row(const float* in, float* out, int width);

/// out[2i] = (in[i-1] + 6 in[i] + in[i+1])/8, out[2i+1] = (in[i] + in[i+1])/2
void double_row(const float* in, float* out, int width);

/// out = sum of Gaussian taps times in, or times its square.
enum class BlurOf { values, squares };
void blur_row(BlurOf what, const float* in, float* out, int width);

/// row /= weight scale; 0 where weight is 0, as it must be behind the row.
void divide_row(float* row, const float* weight, float scale, int width);

/// out = 1 where weight is > 0, else 0.
void mark_row(const float* weight, float* out, int width);

/// out = a - b.
void subtract_row(const float* a, const float* b, float* out, int width);

/// row *= by.
void multiply_row(float* row, const float* by, int width);

/// What a band loses, in log2 units, by the light around in log2 units of the adaptation luminance: straight
/// between values at first, first + 1/per_octave, ..., held beyond.
struct ExcessTable {
  float first = 0;
  float per_octave = 1;
  std::vector<float> values;  ///< at least two
};

/// Rows of a band.
struct FadeRow {
  const float* band;
  const float* variance;
  const float* surround;  ///< log2 of the light around
  float* change;          ///< of the coarser bands; this band's is added
};
/// With G = max(sqrt(variance), band/sqrt(2)) and lost = clamp(excess, 0, G - least):
/// change -= band lost/G
void fade_row(const ExcessTable& excess, const FadeRow& row, int width);

/// What makes pixels of their changes.
struct Applied {
  float strength = 1;
  float black = 0;  ///< `darkest` in the image's units, as a grey
};
/// With a = strength (2^change - 1): out = in + a (max(in, 0) + black) where a > 0, so that a negative
/// component does not grow, and in (1 + a) elsewhere. The very bits where change or `present` (if any) is 0.
void apply_row(const Applied& applied, const float* change, const float* present, const RgbRow& in,
               const RgbOut& out, int width);

/// Zeros behind the row.
void end_row(float* row, int width);

/// Taps 0 ... blur_reach of the Gaussian of 2 samples, in 4096ths: every sum of any of them is exact.
inline constexpr float blur_taps[] = {818.0f / 4096, 722.0f / 4096, 496.0f / 4096, 265.0f / 4096,
                                      111.0f / 4096, 36.0f / 4096,  9.0f / 4096};

}  // namespace scotopic::contrast
