#include "stages/noise/field.h"

#include <cmath>
#include <numbers>

#include "stages/noise/philox.h"

namespace scotopic::noise {

double lattice_value(const Lattice& lattice, std::int64_t x, std::int64_t y, std::int64_t time) noexcept {
  const auto word = [](auto number) { return static_cast<std::uint32_t>(number); };  // modulo 2^32
  const PhiloxWords w =
      philox({word(x), word(y), word(time), lattice.stream}, {word(lattice.seed), word(lattice.seed >> 32)});
  // u = (w + 1/2)/2^32; the sum of four is exact.
  const std::uint64_t sum = std::uint64_t{w[0]} + w[1] + w[2] + w[3];
  return std::numbers::sqrt3 * ((static_cast<double>(sum) + 2) * 0x1p-32 - 2);
}

Taps spline_taps(double coordinate) noexcept {
  const double cell = std::floor(coordinate);
  const double f = coordinate - cell, g = 1 - f;
  Taps taps{static_cast<std::int64_t>(cell) - 1,
            {g * g * g / 6, (4 - 6 * f * f + 3 * f * f * f) / 6, (1 + 3 * f + 3 * f * f - 3 * f * f * f) / 6,
             f * f * f / 6}};
  double squares = 0;
  for (const double w : taps.weight) squares += w * w;
  const double norm = std::sqrt(squares);
  for (double& w : taps.weight) w /= norm;
  return taps;
}

double field_at(const Lattice& lattice, double x, double y, double t) noexcept {
  const Taps tx = spline_taps(x / lattice.pitch), ty = spline_taps(y / lattice.pitch);
  const Taps tt = spline_taps(t / lattice.time_pitch);
  // From within: over time, then y, then x, as rows of pixels share the inner sums.
  double n = 0;
  for (int a = 0; a < 4; ++a) {
    double column = 0;
    for (int b = 0; b < 4; ++b) {
      double moment = 0;
      for (int c = 0; c < 4; ++c)
        moment += tt.weight[c] * lattice_value(lattice, tx.first + a, ty.first + b, tt.first + c);
      column += ty.weight[b] * moment;
    }
    n += tx.weight[a] * column;
  }
  return n;
}

Field fixed_field(const Lattice& lattice) noexcept { return {{lattice, lattice}, {1, 0}}; }

Field octave_field(double pitch, double time_pitch, std::uint64_t seed) noexcept {
  const double octave = std::log2(64 * pitch);
  const double k = std::floor(octave);
  const double angle = (octave - k) * std::numbers::pi / 2;
  const auto rung = [&](double number) {
    const auto stream = static_cast<std::uint32_t>(static_cast<std::int64_t>(number));
    return Lattice{std::exp2(number) / 64, time_pitch, seed, stream};
  };
  return {{rung(k), rung(k + 1)}, {std::cos(angle), octave == k ? 0 : std::sin(angle)}};
}

double field_at(const Field& field, double x, double y, double t) noexcept {
  const double n = field_at(field.lattice[0], x, y, t);
  if (field.weight[1] == 0) return field.weight[0] * n;
  return field.weight[0] * n + field.weight[1] * field_at(field.lattice[1], x, y, t);
}

}  // namespace scotopic::noise
