#include "pipeline/rows/acuity_rows.h"

#include <algorithm>
#include <cstring>

#include "io/pixels/row_bands.h"

namespace scotopic {

std::int64_t acuity_bytes(const SpatialFilter& filter, const Subimage& subimage, bool wraps) {
  const std::int64_t rows = band_rows(subimage);
  // Bands that wait until the halo below them has come, the one that comes and the one worked out.
  const std::int64_t waiting = filter.halo() + 2 * rows;
  constexpr std::int64_t planes = 3 * sizeof(float), rest = sizeof(float) + 1;  // alpha, touched
  const std::int64_t of_file = static_cast<std::int64_t>(row_bytes(subimage));
  const std::int64_t width = subimage.data.width() + (wraps ? 2 * filter.halo() : 0);
  return (filter.halo() + waiting) * planes * width + rows * planes * subimage.data.width() +
         waiting * (rest * subimage.data.width() + of_file);
}

AcuityRows::AcuityRows(const SpatialFilter& filter, const Window& data, bool descending, bool alpha,
                       bool wraps)
    : filter_(filter),
      data_(data),
      descending_(descending),
      alpha_(alpha),
      pad_(wraps ? filter.halo() : 0),
      stride_(data.width() + 2 * pad_) {}

const Band* AcuityRows::add(Band&& band) {
  const std::size_t pixels = static_cast<std::size_t>(band.rows) * static_cast<std::size_t>(band.width);
  WaitingBand& last = waiting_.emplace_back();
  last.alpha.resize(alpha_ ? pixels : 0);
  last.touched.resize(pixels);
  last.band = std::move(band);
  come_ += last.band.rows;
  const auto floats = static_cast<std::size_t>(come_ - forgotten_) * static_cast<std::size_t>(stride_);
  for (std::vector<float>& plane : in_) plane.resize(floats);
  return &last.band;
}

namespace {

/// A row, and `pad` columns of its other side left and right of it, round and round.
void wrap_row(const std::vector<float>& from, int width, int pad, float* to) {
  std::copy_n(from.data(), width, to);
  for (int i = 0; i < pad; ++i) {
    to[-1 - i] = from[static_cast<std::size_t>(width - 1 - i % width)];
    to[width + i] = from[static_cast<std::size_t>(i % width)];
  }
}

}  // namespace

// Where image row y (from data_.y0) lies, at its first column: rows are kept in the order of their coming.
const float* AcuityRows::plane_row(int channel, int y) const {
  const int order = descending_ ? data_.height() - 1 - y : y;
  return in_[channel].data() + static_cast<std::ptrdiff_t>(order - forgotten_) * stride_ + pad_;
}

float* AcuityRows::plane_row(int channel, int y) {
  return const_cast<float*>(static_cast<const AcuityRows&>(*this).plane_row(channel, y));
}

void AcuityRows::set_row(int row, const LightRow& light) {
  WaitingBand& last = waiting_.back();
  const int y = last.band.y0 - data_.y0 + row;
  const auto width = static_cast<std::size_t>(data_.width());
  const std::size_t at = static_cast<std::size_t>(row) * width;
  wrap_row(light.r, data_.width(), pad_, plane_row(0, y));
  wrap_row(light.g, data_.width(), pad_, plane_row(1, y));
  wrap_row(light.b, data_.width(), pad_, plane_row(2, y));
  std::copy_n(light.touched.data(), width, last.touched.data() + at);
  if (alpha_) std::copy_n(light.alpha.data(), width, last.alpha.data() + at);
}

bool AcuityRows::next() {
  if (waiting_.empty()) return false;
  int through = come_;  // rows to the end of the oldest band
  for (std::size_t i = 1; i < waiting_.size(); ++i) through -= waiting_[i].band.rows;
  if (come_ < std::min(data_.height(), through + filter_.halo())) return false;
  now_ = std::move(waiting_.front());
  waiting_.pop_front();
  filter_band();
  mark_changes();
  forget_rows();
  return true;
}

void AcuityRows::filter_band() {
  const int width = data_.width(), y = now_.band.y0 - data_.y0;
  const std::size_t floats = static_cast<std::size_t>(now_.band.rows) * static_cast<std::size_t>(width);
  for (std::vector<float>& plane : out_) plane.resize(floats);
  const int top = descending_ ? data_.height() - come_ : forgotten_;
  const AcuityWindow window{plane_row(0, top) - pad_,
                            plane_row(1, top) - pad_,
                            plane_row(2, top) - pad_,
                            descending_ ? -stride_ : stride_,
                            0,
                            top,
                            stride_,
                            come_ - forgotten_,
                            stride_,
                            data_.height()};
  const AcuityTile tile{out_[0].data(), out_[1].data(), out_[2].data(), width, pad_, y,
                        width,          now_.band.rows};
  filter_.filter(window, tile, [](int count, const std::function<void(int)>& task) {
    parallel_rows(count, 1, [&](int first, int last) {
      for (int i = first; i < last; ++i) task(i);
    });
  });
}

void AcuityRows::mark_changes() {
  const int width = data_.width(), y = now_.band.y0 - data_.y0;
  parallel_rows(now_.band.rows, 8, [&](int first, int last) {
    for (int row = first; row < last; ++row) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(row) * width;
      std::uint8_t* touched = now_.touched.data() + at;
      for (int k = 0; k < 3; ++k) {
        const float *before = plane_row(k, y + row), *after = out_[k].data() + at;
        for (int x = 0; x < width; ++x) touched[x] |= std::memcmp(before + x, after + x, sizeof(float)) != 0;
      }
    }
  });
}

void AcuityRows::forget_rows() {
  int done = come_;
  for (const WaitingBand& waiting : waiting_) done -= waiting.band.rows;
  const int gone = std::max(0, done - filter_.halo() - forgotten_);
  const std::ptrdiff_t floats = static_cast<std::ptrdiff_t>(gone) * stride_;
  for (std::vector<float>& plane : in_) plane.erase(plane.begin(), plane.begin() + floats);
  forgotten_ += gone;
}

void AcuityRows::get_row(int row, LightRow& light) const {
  const auto width = static_cast<std::size_t>(data_.width());
  const std::size_t at = static_cast<std::size_t>(row) * width;
  std::copy_n(out_[0].data() + at, width, light.r.data());
  std::copy_n(out_[1].data() + at, width, light.g.data());
  std::copy_n(out_[2].data() + at, width, light.b.data());
  std::copy_n(now_.touched.data() + at, width, light.touched.data());
  if (alpha_) std::copy_n(now_.alpha.data() + at, width, light.alpha.data());
}

}  // namespace scotopic
