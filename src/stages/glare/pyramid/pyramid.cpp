#include "stages/glare/pyramid/pyramid.h"

#include <algorithm>
#include <array>
#include <functional>

namespace scotopic::glare {
namespace {

constexpr int rows_at_once = 32;

/// Runs task(y) for begin <= y < end, in tasks of neighbouring rows; `make` gives each task what it works in.
template <typename Make, typename Task>
void for_rows(int begin, int end, const ParallelFor& parallel_for, Make make, Task task) {
  parallel_for((end - begin + rows_at_once - 1) / rows_at_once, [&](int i) {
    auto own = make();
    const int first = begin + i * rows_at_once;
    for (int y = first; y < std::min(first + rows_at_once, end); ++y) task(y, own);
  });
}

/// The last rows of level 0 of every plane, by row modulo 8: halving looks at five.
struct LastRows {
  LastRows(const Level& picture, int plane_count)
      : planes(plane_count), rows(picture.width, 8 * plane_count + 1) {}
  float* row(int plane, int y) { return rows.row(1 + plane * 8 + (y & 7)); }
  const float* zeros() { return rows.row(0); }
  int planes;
  Rows rows;
  std::array<bool, 8> of_ones{};
  int next = -1;  ///< the first row not yet here
};

void fill(LastRows& ring, const Level& picture, const Pyramid::RowSource& source, int from, int to) {
  for (int y = std::max({from, ring.next, 0}); y <= std::min(to, picture.height - 1); ++y) {
    std::array<float*, most_planes> rows{};
    for (int p = 0; p < ring.planes; ++p) rows[static_cast<std::size_t>(p)] = ring.row(p, y);
    ring.of_ones[static_cast<std::size_t>(y & 7)] = source(y, rows.data());
    ring.next = y + 1;
  }
}

/// Whether rows first ... first + 4 are of the picture, and their mask is 1.
bool all_of_ones(const LastRows& ring, const Level& picture, int first) {
  if (first < 0 || first + 4 >= picture.height) return false;
  for (int y = first; y <= first + 4; ++y)
    if (!ring.of_ones[static_cast<std::size_t>(y & 7)]) return false;
  return true;
}

void halve_along(const Level& from, const float* in, const Level& to, float* out) {
  if (from.wrapped.empty())
    halve_row(in, out, to.x_begin, to.x_end);
  else
    halve_row_around(from.wrapped, in, out);
}

/// Offsets of rows in a panorama or a picture; the weight of two samples of the last level.
double weight(const Ladder& ladder, int dx, int dy) {
  return static_cast<double>(
      ladder.top[static_cast<std::size_t>(std::abs(dy) * ladder.top_width + std::abs(dx))]);
}

/// sums[x] += what row `from`, dy rows away, sends there.
void add_top_row(const Ladder& ladder, const float* from, int dy, std::vector<double>& sums) {
  const Level& level = ladder.levels.back();
  for (int x = level.x_begin; x < level.x_end; ++x) {
    if (from[x] == 0) continue;
    for (int to = level.x_begin; to < level.x_end; ++to)
      sums[static_cast<std::size_t>(to - level.x_begin)] +=
          weight(ladder, to - x, dy) * static_cast<double>(from[x]);
  }
}

}  // namespace

void add_rungs(const Level& level, const float* const* rows, int begin, int end, Scratch& scratch,
               float* out) {
  std::array<float*, most_rungs> columns{};
  for (std::size_t r = 0; r < most_rungs; ++r) columns[r] = scratch.rows.row(static_cast<std::ptrdiff_t>(r));
  // The longest taps along a row are shorter than `before`.
  const int from = (begin - 1) / column_step * column_step - before, step = column_step;
  const int to = from + (end + before - from + step - 1) / step * step;
  blur_columns(level, rows, columns.data(), from, to);
  blur_row_add(level, columns.data(), out, begin, end);
}

void double_rows(const Level& from, const Level& to, const float* const (&rows)[3], bool odd,
                 Scratch& scratch, float* out) {
  double_columns(rows, odd, scratch.rows.row(0), from.width);
  if (to.wrapped.empty())
    double_row(scratch.rows.row(0), out, to.x_begin, to.x_end);
  else
    double_row_around(to.wrapped, scratch.rows.row(0), out, to.width);
}

Pyramid::Pyramid(const Ladder& ladder, int planes)
    : ladder_(ladder),
      planes_(planes),
      ones_(level(1).width, 3),
      of_ones_(static_cast<std::size_t>(level(1).y_end - level(1).y_begin)) {
  for (int j = 1; j <= last(); ++j) {
    sharp_.emplace_back(level(j), planes);
    blurred_.emplace_back(level(j), kept(ladder, planes, j));
  }
  if (rings() > 0) halo_.emplace(level(ladder.halo.level), ladder.halo, planes);
}

// Level 1 is blurred by blurred_row(), unless it is the last.
int Pyramid::kept(const Ladder& ladder, int planes, int j) {
  if (j == 1 && ladder.levels.size() > 2) return 0;
  return planes + (j <= ladder.halo.level ? rings(ladder, planes) : 0);
}

std::size_t Pyramid::bytes(const Ladder& ladder, int planes) {
  std::size_t sum = 3 * static_cast<std::size_t>(row_floats(ladder.levels[1].width)) * sizeof(float);
  for (int j = 1; j < static_cast<int>(ladder.levels.size()); ++j) {
    const Level& level = ladder.levels[static_cast<std::size_t>(j)];
    sum += Planes::bytes(level, planes) + Planes::bytes(level, kept(ladder, planes, j));
  }
  if (rings(ladder, planes) == 0) return sum;
  const Level& of_halo = ladder.levels[static_cast<std::size_t>(ladder.halo.level)];
  return sum + RingPlanes::bytes(of_halo, ladder.halo, planes);
}

void Pyramid::build(const RowSource& source, const ParallelFor& parallel_for) {
  make_ones();
  halve_picture(source, parallel_for);
  for (int j = 2; j <= last(); ++j) halve_level(j, parallel_for);
  if (halo_) spread_halo(parallel_for);
  sum_top(parallel_for);
  for (int j = last() - 1; j >= 2; --j) blur_level(j, parallel_for);
}

// Where nothing is not finite, rows of the mask are all alike but for the first and last.
void Pyramid::make_ones() {
  const Level &from = level(0), &to = level(1);
  Rows row(from.width, 2);
  Scratch scratch(from.width);
  std::fill_n(row.row(1), from.width, 1.0f);
  finish_row(row.row(1), from.width, 0, from.width, ladder_.sides);
  halve_columns({row.row(1), row.row(1), row.row(1), row.row(1), row.row(1)}, scratch.rows.row(0),
                from.width);
  halve_along(from, scratch.rows.row(0), to, ones_.row(1));
  finish_row(ones_.row(1), to.width, to.x_begin, to.x_end, ladder_.sides);
  if (last() == 1) return;
  std::array<const float*, most_around> rows{};
  rows.fill(ones_.row(1));
  std::fill(ones_.row(2) + to.x_begin, ones_.row(2) + to.x_end, 0.0f);
  add_rungs(to, rows.data(), to.x_begin, to.x_end, scratch, ones_.row(2));
}

bool Pyramid::of_ones(int plane, int y, int reach) const {
  const Level& at = level(1);
  if (plane != planes_ - 1 || y - reach < at.y_begin || y + reach >= at.y_end) return false;
  const auto first = of_ones_.begin() + (y - reach - at.y_begin);
  return std::all_of(first, first + 2 * reach + 1, [](std::uint8_t ones) { return ones != 0; });
}

void Pyramid::halve_picture(const RowSource& source, const ParallelFor& parallel_for) {
  const Level &from = level(0), &to = level(1);
  struct Own {
    LastRows ring;
    Scratch scratch;
  };
  const auto make = [&] { return Own{LastRows(from, planes_), Scratch(from.width)}; };
  for_rows(to.y_begin, to.y_end, parallel_for, make, [&](int y, Own& own) {
    fill(own.ring, from, source, 2 * y - 2, 2 * y + 2);
    const bool ones = all_of_ones(own.ring, from, 2 * y - 2);
    of_ones_[static_cast<std::size_t>(y - to.y_begin)] = ones;
    for (int p = 0; p < planes_ - ones; ++p) {
      const float* rows[5];
      for (int i = 0; i < 5; ++i) {
        const int at = 2 * y - 2 + i;
        rows[i] = at < 0 || at >= from.height ? own.ring.zeros() : own.ring.row(p, at);
      }
      halve_columns(rows, own.scratch.rows.row(0), from.width);
      halve_along(from, own.scratch.rows.row(0), to, sharp(1).row(p, y));
      finish_row(sharp(1).row(p, y), to.width, to.x_begin, to.x_end, ladder_.sides);
    }
  });
}

void Pyramid::halve_level(int j, const ParallelFor& parallel_for) {
  const Level &from = level(j - 1), &to = level(j);
  const auto make = [&] { return Scratch(from.width); };
  for_rows(to.y_begin, to.y_end, parallel_for, make, [&](int y, Scratch& scratch) {
    for (int p = 0; p < planes_; ++p) {
      const float* rows[5];
      for (int i = 0; i < 5; ++i) rows[i] = sharp_row(j - 1, p, 2 * y - 2 + i);
      halve_columns(rows, scratch.rows.row(0), from.width);
      halve_along(from, scratch.rows.row(0), to, sharp(j).row(p, y));
      finish_row(sharp(j).row(p, y), to.width, to.x_begin, to.x_end, ladder_.sides);
    }
  });
}

void Pyramid::sum_top(const ParallelFor& parallel_for) {
  const Level& top = level(last());
  parallel_for(top.y_end - top.y_begin, [&](int i) {
    const int y = top.y_begin + i;
    for (int p = 0; p < planes_; ++p) {
      std::vector<double> sums(static_cast<std::size_t>(top.x_end - top.x_begin));
      for (int from = top.y_begin; from < top.y_end; ++from)
        add_top_row(ladder_, sharp_row(last(), p, from), y - from, sums);
      float* const out = blurred(last()).row(p, y);
      std::transform(sums.begin(), sums.end(), out + top.x_begin,
                     [](double x) { return static_cast<float>(x); });
      add_halo(last(), p, y, out);
      finish_row(out, top.width, top.x_begin, top.x_end, ladder_.sides);
    }
    Scratch scratch(top.width);
    for (int p = planes_; p < blurred_planes(last()); ++p)
      ring_mask_row(last(), p - planes_, y, scratch, blurred(last()).row(p, y));
  });
}

void Pyramid::blur_level(int j, const ParallelFor& parallel_for) {
  const Level& at = level(j);
  const auto make = [&] { return Scratch(at.width); };
  for_rows(at.y_begin, at.y_end, parallel_for, make, [&](int y, Scratch& scratch) {
    for (int p = 0; p < blurred_planes(j); ++p) blurred_row(j, p, y, scratch, blurred(j).row(p, y));
  });
}

void Pyramid::blurred_row(int plane, int y, Scratch& scratch, float* out) const {
  if (last() > 1) return blurred_row(1, plane, y, scratch, out);
  const float* const kept = blurred(1).row(plane, y) - before;
  std::copy(kept, kept + row_floats(level(1).width), out - before);
}

void Pyramid::add_sharp(int j, int plane, int y, Scratch& scratch, float* out) const {
  const Level& at = level(j);
  std::array<const float*, most_around> rows{};
  for (int d = -at.reach(); d <= at.reach(); ++d)
    rows[static_cast<std::size_t>(at.reach() + d)] = sharp_row(j, plane, y + d);
  add_rungs(at, rows.data(), at.x_begin, at.x_end, scratch, out);
}

void Pyramid::blurred_row(int j, int plane, int y, Scratch& scratch, float* out) const {
  if (plane >= planes_) return ring_mask_row(j, plane - planes_, y, scratch, out);
  const Level& at = level(j);
  doubled_row(j, plane, y, scratch, out);
  if (j == 1 && of_ones(plane, y, at.reach()))
    std::transform(ones_.row(2) + at.x_begin, ones_.row(2) + at.x_end, out + at.x_begin, out + at.x_begin,
                   std::plus<>());
  else
    add_sharp(j, plane, y, scratch, out);
  add_halo(j, plane, y, out);
  finish_row(out, at.width, at.x_begin, at.x_end, ladder_.sides);
}

void Pyramid::spread_halo(const ParallelFor& parallel_for) {
  const int j = ladder_.halo.level, reach = halo_->reach();
  const auto make = [reach] { return std::vector<const float*>(static_cast<std::size_t>(2 * reach + 1)); };
  for_rows(halo_->y_begin(), halo_->y_end(), parallel_for, make, [&](int y, std::vector<const float*>& rows) {
    for (int p = 0; p < planes_; ++p) {
      for (int d = -reach; d <= reach; ++d)
        rows[static_cast<std::size_t>(reach + d)] = sharp_row(j, p, y + d);
      halo_->take(p, y, rows.data(), ladder_.sides);
    }
  });
}

void Pyramid::add_halo(int j, int plane, int y, float* out) const {
  if (j == ladder_.halo.level && plane < rings())
    halo_->add(plane, ladder_.halo.rings[static_cast<std::size_t>(plane)], y, out);
}

void Pyramid::ring_mask_row(int j, int ring, int y, Scratch& scratch, float* out) const {
  const Level& at = level(j);
  if (j < ladder_.halo.level) {
    doubled_row(j, planes_ + ring, y, scratch, out);
  } else {
    std::fill(out + at.x_begin, out + at.x_end, 0.0f);
    halo_->add(planes_ - 1, ladder_.halo.rings[static_cast<std::size_t>(ring)], y, out);
  }
  finish_row(out, at.width, at.x_begin, at.x_end, ladder_.sides);
}

void Pyramid::doubled_row(int j, int plane, int y, Scratch& scratch, float* out) const {
  const Planes& above = blurred(j + 1);
  const DoubledFrom from(y);
  const float* const rows[3] = {above.row(plane, from.rows[0]), above.row(plane, from.rows[1]),
                                above.row(plane, from.rows[2])};
  double_rows(level(j + 1), level(j), rows, from.odd, scratch, out);
}

}  // namespace scotopic::glare
