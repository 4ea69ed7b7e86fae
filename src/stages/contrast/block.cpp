#include "stages/contrast/block.h"

#include <algorithm>
#include <utility>

#include "stages/contrast/resample.h"

namespace scotopic::contrast {

void Block::read(const AcuityWindow& window) {
  const Range x = x_.source[0], y = y_.source[0];
  Level& level = levels_[0];
  for (Plane* plane : {&level.light, &level.log, &level.present}) plane->reshape(x, y);
  all_present_ = true;
  for (int row = y.begin; row < y.end; ++row) {
    const std::ptrdiff_t at = (row - window.y) * window.stride + (x.begin - window.x);
    all_present_ &= light_row(constants_.weights, {window.r + at, window.g + at, window.b + at}, x.size(),
                              {level.light.row(row), level.log.row(row), level.present.row(row)});
  }
}

/// Level k + 1 from level k.
void Block::build(std::size_t k) {
  const Range x = x_.source[k + 1], y = y_.source[k + 1];
  const Level& from = levels_[k];
  Level& to = levels_[k + 1];
  for (Plane* plane : {&to.light, &to.log, &to.present}) plane->reshape(x, y);
  Resampler halve(Resampling::halve, x_.source[k], x);
  for (int row = y.begin; row < y.end; ++row) {
    const RowTaps taps(Resampling::halve, row, y_.size[k]);
    halve.weigh(present(k), taps);
    for (const auto& [source, plane] : {std::pair{&from.log, &to.log}, {&from.light, &to.light}}) {
      halve.row(*source, taps, plane->row(row));
      halve.divide(plane->row(row));
    }
    if (!all_present_) mark_row(halve.weights(), to.present.row(row), x.size());
  }
}

void Block::take_band(std::size_t k) {
  const Range x = x_.band[k], y = y_.band[k];
  Level& fine = levels_[k];
  fine.band.reshape(x, y);
  Resampler up(Resampling::double_up, x_.source[k + 1], x);
  for (int row = y.begin; row < y.end; ++row) {
    const RowTaps taps(Resampling::double_up, row, y_.size[k + 1]);
    float* const out = fine.band.row(row);
    up.weigh(present(k + 1), taps);
    up.row(levels_[k + 1].log, taps, out);
    up.divide(out);
    subtract_row(fine.log.at(x.begin, row), out, out, x.size());
    if (!all_present_) multiply_row(out, fine.present.at(x.begin, row), x.size());
  }
}

/// The change of level k from that of level k + 1.
void Block::fade(std::size_t k) {
  const Range x = x_.change[k], y = y_.change[k];
  Level &fine = levels_[k], &coarse = levels_[k + 1];
  take_band(k);
  LocalMean variance(fine.band, present(k), x, fine.squares);
  Resampler change(Resampling::double_up, coarse.change.x(), x);
  Resampler surround(Resampling::double_up, coarse.light.x(), x);
  Plane scratch(x, {0, 2});
  fine.change.reshape(x, y);
  for (int row = y.begin; row < y.end; ++row) {
    const RowTaps taps(Resampling::double_up, row, y_.size[k + 1]);
    const FadeRow r{fine.band.at(x.begin, row), scratch.row(0), scratch.row(1), fine.change.row(row)};
    surround.weigh(present(k + 1), taps);
    surround.row(coarse.light, taps, scratch.row(1));
    surround.divide(scratch.row(1));
    change.row(coarse.change, taps, r.change);
    surround.divide(r.change);
    variance.row(row, y_.size[k], scratch.row(0));
    fade_row(constants_.bands[k], r, x.size());
    if (!all_present_) multiply_row(r.change, fine.present.at(x.begin, row), x.size());
  }
}

void Block::write(const AcuityWindow& window, const AcuityTile& tile) const {
  const Level& level = levels_[0];
  for (int row = 0; row < tile.height; ++row) {
    const int y = tile.y + row;
    const std::ptrdiff_t from = (y - window.y) * window.stride + (tile.x - window.x);
    const std::ptrdiff_t to = row * tile.stride;
    apply_row(constants_.applied, level.change.at(tile.x, y),
              all_present_ ? nullptr : level.present.at(tile.x, y),
              {window.r + from, window.g + from, window.b + from}, {tile.r + to, tile.g + to, tile.b + to},
              tile.width);
  }
}

void Block::filter(const AcuityWindow& window, const AcuityTile& tile) {
  const int bands = static_cast<int>(constants_.bands.size());
  x_ = axis_ranges({tile.x, tile.x + tile.width}, window.image_width, bands);
  y_ = axis_ranges({tile.y, tile.y + tile.height}, window.image_height, bands);
  read(window);
  for (std::size_t k = 0; k + 1 < levels_.size(); ++k) build(k);
  for (std::size_t k = 1; k < levels_.size(); ++k)
    for (int y = y_.source[k].begin; y < y_.source[k].end; ++y)
      log_row(levels_[k].light.row(y), x_.source[k].size());
  levels_.back().change.reshape(x_.change.back(), y_.change.back());
  levels_.back().change.fill(0.0f);
  for (std::size_t k = levels_.size() - 1; k-- > 0;) fade(k);
  write(window, tile);
}

}  // namespace scotopic::contrast
