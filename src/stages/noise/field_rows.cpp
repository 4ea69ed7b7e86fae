#include "stages/noise/field_rows.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "stages/noise/philox.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/noise/field_rows.cpp"
#include <hwy/foreach_target.h>
// foreach_target first: it includes this file once per target.
#include <hwy/highway.h>

#ifndef SCOTOPIC_STAGES_NOISE_FIELD_ROWS_CPP_
#define SCOTOPIC_STAGES_NOISE_FIELD_ROWS_CPP_
namespace scotopic::noise {

// Writes beyond the last number end within this many more.
constexpr std::size_t most_doubles = 8;

// Pixels begin .. end - 1 lie between the same lattice columns, the first of which is `column`.
struct Cell {
  std::size_t begin, end, column;
};

// The columns of a tile: their cells, and each pixel's four weights.
struct Columns {
  std::int64_t first = 0;  // lattice column
  std::size_t count = 0;   // lattice columns
  std::vector<Cell> cells;
  std::array<std::vector<double>, 4> weight;
};

}  // namespace scotopic::noise
#endif

HWY_BEFORE_NAMESPACE();
namespace scotopic::noise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint64_t, most_doubles>;
using Doubles = hn::Rebind<double, Words>;
using Word = hn::Vec<Words>;

// Of the lower half of each number.
HWY_INLINE Word product(Word a, std::uint32_t b) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(Words(), (hn::GetLane(a) & 0xffffffff) * b);
#else
  const hn::Repartition<std::uint32_t, Words> d32;
  return hn::MulEven(hn::BitCast(d32, a), hn::Set(d32, b));
#endif
}

// Sum of Philox's four words. Those lie in the lower halves of c's numbers; what the upper halves hold is no
// matter.
HWY_INLINE Word philox_sum(std::array<Word, 4> c, std::array<std::uint32_t, 2> key) {
  const Words d;
  for (int round = 0; round < philox_rounds; ++round, key = next_philox_key(key)) {
    const Word p0 = product(c[0], philox_multipliers[0]);
    const Word p1 = product(c[2], philox_multipliers[1]);
    const Word c0 = hn::Xor(hn::Xor(hn::ShiftRight<32>(p1), c[1]), hn::Set(d, std::uint64_t{key[0]}));
    const Word c2 = hn::Xor(hn::Xor(hn::ShiftRight<32>(p0), c[3]), hn::Set(d, std::uint64_t{key[1]}));
    c = {c0, p1, c2, p0};
  }
  const Word low = hn::Set(d, std::uint64_t{0xffffffff});
  return hn::Add(hn::Add(hn::And(c[0], low), hn::And(c[1], low)),
                 hn::Add(hn::And(c[2], low), hn::And(c[3], low)));
}

// lattice_value() at the lattice columns x.
HWY_INLINE hn::Vec<Doubles> values(const Lattice& lattice, Word x, std::int64_t y, std::int64_t time) {
  const Words d;
  const Doubles dd;
  const auto all = [&](auto number) HWY_ATTR { return hn::Set(d, static_cast<std::uint64_t>(number)); };
  const Word sum =
      philox_sum({x, all(y), all(time), all(lattice.stream)},
                 {static_cast<std::uint32_t>(lattice.seed), static_cast<std::uint32_t>(lattice.seed >> 32)});
  // As the last bits of 2^52: exactly that number more.
  const auto from_2_52 = hn::BitCast(dd, hn::Or(sum, hn::Set(d, std::uint64_t{0x4330000000000000})));
  const auto number = hn::Sub(from_2_52, hn::Set(dd, 0x1p52));
  const auto centred =
      hn::Sub(hn::Mul(hn::Add(number, hn::Set(dd, 2.0)), hn::Set(dd, 0x1p-32)), hn::Set(dd, 2.0));
  return hn::Mul(hn::Set(dd, std::numbers::sqrt3), centred);
}

// One row of the lattice, weighed over time.
void lattice_row(const Lattice& lattice, const Columns& columns, const Taps& time, std::int64_t y,
                 double* out) {
  const Doubles d;
  const Words words;
  Word x = hn::Iota(words, static_cast<std::uint64_t>(columns.first));
  const Word step = hn::Set(words, std::uint64_t{hn::Lanes(d)});
  for (std::size_t i = 0; i < columns.count; i += hn::Lanes(d), x = hn::Add(x, step)) {
    auto sum = hn::Zero(d);
    for (std::size_t c = 0; c < 4; ++c) {
      const auto z = values(lattice, x, y, time.first + static_cast<std::int64_t>(c));
      sum = hn::Add(sum, hn::Mul(hn::Set(d, time.weight[c]), z));
    }
    hn::StoreU(sum, d, out + i);
  }
}

// Four rows of the lattice weighed into one.
void column_sums(const std::array<const double*, 4>& rows, const std::array<double, 4>& weight,
                 std::size_t count, double* out) {
  const Doubles d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto sum = hn::Zero(d);
    for (std::size_t b = 0; b < 4; ++b)
      sum = hn::Add(sum, hn::Mul(hn::Set(d, weight[b]), hn::LoadU(d, rows[b] + i)));
    hn::StoreU(sum, d, out + i);
  }
}

// Lattice columns weighed into pixels. What a cell's last vector writes too far, the next cell writes again.
void pixel_sums(const Columns& columns, const double* sums, double* out) {
  const hn::CappedTag<double, 4> d;
  for (const Cell& cell : columns.cells) {
    const double* s = sums + cell.column;
    const auto s0 = hn::Set(d, s[0]), s1 = hn::Set(d, s[1]), s2 = hn::Set(d, s[2]), s3 = hn::Set(d, s[3]);
    for (std::size_t i = cell.begin; i < cell.end; i += hn::Lanes(d)) {
      const auto weighed = [&](std::size_t a, auto value) HWY_ATTR {
        return hn::Mul(hn::LoadU(d, columns.weight[a].data() + i), value);
      };
      hn::StoreU(hn::Add(hn::Add(hn::Add(weighed(0, s0), weighed(1, s1)), weighed(2, s2)), weighed(3, s3)), d,
                 out + i);
    }
  }
}

}  // namespace scotopic::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic::noise {
namespace {

HWY_EXPORT(lattice_row);
HWY_EXPORT(column_sums);
HWY_EXPORT(pixel_sums);

Columns columns_of(const Lattice& lattice, const View& view, std::int64_t x0, std::size_t width) {
  Columns columns;
  for (auto& weight : columns.weight) weight.resize(width + most_doubles);
  for (std::size_t i = 0; i < width; ++i) {
    const double pixel = static_cast<double>(x0 + static_cast<std::int64_t>(i)) + 0.5;
    const Taps taps = spline_taps((pixel - view.center_x) / view.pixels_per_degree / lattice.pitch);
    for (std::size_t a = 0; a < 4; ++a) columns.weight[a][i] = taps.weight[a];
    if (i == 0) columns.first = taps.first;
    const auto column = static_cast<std::size_t>(taps.first - columns.first);
    if (i == 0 || columns.cells.back().column != column) columns.cells.push_back({i, i, column});
    columns.cells.back().end = i + 1;
    columns.count = column + 4;
  }
  return columns;
}

// One lattice over the tile.
class Layer {
 public:
  Layer(const Lattice& lattice, const View& view, std::int64_t x0, std::size_t width)
      : lattice_(lattice),
        columns_(columns_of(lattice, view, x0, width)),
        time_(spline_taps(view.seconds / lattice.time_pitch)),
        stride_(columns_.count + most_doubles),
        rows_(4 * stride_),
        sums_(stride_) {}

  // n at y degrees.
  void row(double y, double* out) {
    const Taps taps = spline_taps(y / lattice_.pitch);
    std::array<const double*, 4> rows{};
    for (int b = 0; b < 4; ++b) rows[static_cast<std::size_t>(b)] = lattice_row_at(taps.first + b);
    HWY_DYNAMIC_DISPATCH(column_sums)(rows, taps.weight, columns_.count, sums_.data());
    HWY_DYNAMIC_DISPATCH(pixel_sums)(columns_, sums_.data(), out);
  }

 private:
  // Four rows next to each other never share a place.
  const double* lattice_row_at(std::int64_t y) {
    const std::size_t place = static_cast<std::size_t>(y) % 4;
    double* row = rows_.data() + place * stride_;
    if (!held_[place] || row_held_[place] != y) {
      HWY_DYNAMIC_DISPATCH(lattice_row)(lattice_, columns_, time_, y, row);
      held_[place] = true;
      row_held_[place] = y;
    }
    return row;
  }

  Lattice lattice_;
  Columns columns_;
  Taps time_;
  std::size_t stride_;
  std::vector<double> rows_, sums_;
  std::array<bool, 4> held_{};
  std::array<std::int64_t, 4> row_held_{};
};

}  // namespace

struct FieldRows::State {
  Field field;
  View view;
  std::size_t width;
  std::vector<Layer> layers;
  std::vector<double> n, other;

  State(const Field& f, const View& v, std::int64_t x0, std::size_t w)
      : field(f), view(v), width(w), n(w + most_doubles) {
    layers.emplace_back(f.lattice[0], v, x0, w);
    if (f.weight[1] == 0) return;
    layers.emplace_back(f.lattice[1], v, x0, w);
    other.resize(w + most_doubles);
  }
};

FieldRows::FieldRows(const Field& field, const View& view, std::int64_t x0, std::size_t width)
    : state_(std::make_unique<State>(field, view, x0, width)) {}
FieldRows::~FieldRows() = default;
FieldRows::FieldRows(FieldRows&&) noexcept = default;
FieldRows& FieldRows::operator=(FieldRows&&) noexcept = default;

std::size_t FieldRows::width() const noexcept { return state_->width; }

const double* FieldRows::row(std::int64_t y) {
  State& s = *state_;
  const double degrees = (static_cast<double>(y) + 0.5 - s.view.center_y) / s.view.pixels_per_degree;
  s.layers[0].row(degrees, s.n.data());
  const auto [first, second] = s.field.weight;
  if (s.layers.size() == 1) {
    if (first != 1)
      for (double& n : s.n) n *= first;
    return s.n.data();
  }
  s.layers[1].row(degrees, s.other.data());
  for (std::size_t i = 0; i < s.width; ++i) s.n[i] = first * s.n[i] + second * s.other[i];
  return s.n.data();
}

}  // namespace scotopic::noise
#endif  // HWY_ONCE
