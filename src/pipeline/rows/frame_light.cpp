#include "pipeline/rows/frame_light.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "io/pixels/row_bands.h"
#include "pipeline/rows/threads.h"
#include "stages/glare/filter.h"

namespace scotopic {
namespace {

RowContext corner_of(const Subimage& subimage, const Moment& moment) {
  const Window& d = subimage.display;
  return {subimage.data.x0, subimage.data.y0, d.x0, d.y0, d.x1, d.y1, moment};
}

std::vector<float>* plane(LightRow& light, std::size_t k) {
  std::vector<float>* const all[7] = {&light.r,      &light.g,      &light.b,  &light.cone_l,
                                      &light.cone_m, &light.cone_s, &light.rod};
  return all[k];
}

const std::vector<float>* plane(const LightRow& light, std::size_t k) {
  return plane(const_cast<LightRow&>(light), k);
}

}  // namespace

LightPlanes::LightPlanes(const Subimage& subimage, bool receptors, const Moment& moment)
    : width_(subimage.data.width()),
      height_(subimage.data.height()),
      receptors_(receptors),
      corner_(corner_of(subimage, moment)) {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  for (std::size_t k = 0; k < (receptors_ ? 7u : 3u); ++k) planes_[k].resize(pixels);
  greatest_.resize(static_cast<std::size_t>(height_));
}

std::int64_t LightPlanes::bytes(const Subimage& subimage, bool receptors) {
  return std::int64_t{receptors ? 7 : 3} * std::int64_t{sizeof(float)} * subimage.data.width() *
         subimage.data.height();
}

std::size_t LightPlanes::at(int y, int x) const {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
}

void LightPlanes::set_row(int y, const LightRow& light) {
  for (std::size_t k = 0; k < (receptors_ ? 7u : 3u); ++k)
    std::copy(plane(light, k)->begin(), plane(light, k)->end(), planes_[k].data() + at(y, 0));
  greatest_[static_cast<std::size_t>(y)] =
      greatest_component({light.r.data(), light.g.data(), light.b.data()}, width_);
}

void LightPlanes::replace(int y, int x, LightRow& light) const {
  light.changed.assign(light.r.size(), 0);
  for (std::size_t k = 0; k < (receptors_ ? 7u : 3u); ++k) {
    std::vector<float>& of_file = *plane(light, k);
    const float* const now = planes_[k].data() + at(y, x);
    for (std::size_t i = 0; i < of_file.size(); ++i)
      if (std::memcmp(&of_file[i], now + i, sizeof(float)) != 0) light.changed[i] = 1;
    std::copy_n(now, of_file.size(), of_file.data());
  }
}

void LightPlanes::get(int y, LightRow& light) const {
  for (std::size_t k = 0; k < (receptors_ ? 7u : 3u); ++k)
    std::copy_n(planes_[k].data() + at(y, 0), static_cast<std::size_t>(width_), plane(light, k)->data());
}

FramePlanes LightPlanes::planes() {
  FramePlanes out;
  for (std::size_t k = 0; k < 3; ++k) out.rgb[k] = planes_[k].data();
  for (std::size_t k = 0; receptors_ && k < 4; ++k) out.receptors[k] = planes_[3 + k].data();
  out.width = width_;
  out.height = height_;
  out.stride = width_;
  out.corner = corner_;
  out.greatest = greatest_.empty() ? nullptr : greatest_.data();
  return out;
}

FrameLights decode_frames(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                          NonFinite policy, const Moment& moment) {
  FrameLights out;
  for (const LightSubimage& light : layout.light) {
    const Subimage& subimage = source.subimages()[light.index];
    std::unique_ptr<LightPlanes>& kept = out.subimages.emplace_back();
    if (!subimage.is_full_resolution()) continue;
    const LightReader reader(light.channels, config, light.space);
    LightPlanes& frame = *(kept = std::make_unique<LightPlanes>(subimage, reader.receptors(), moment));
    NonFiniteTally tally(subimage);
    Band band;
    each_band(subimage, false, [&](int y0, int rows) {
      source.read(light.index, y0, rows, band);
      parallel_rows(rows, 8, [&](int first, int last) {
        LightRow row(static_cast<std::size_t>(subimage.data.width()));
        for (int y = first; y < last; ++y) {
          reader.read(band, y, row);
          tally.add(non_finite_of(row.pixels(reader.receptors())), subimage.data.x0, y0 + y);
          frame.set_row(y0 - subimage.data.y0 + y, row);
        }
      });
    });
    out.non_finite.add(tally.found());
  }
  if (policy == NonFinite::error) refuse(out.non_finite, source.file());
  return out;
}

std::int64_t frame_bytes(const PixelSource& source, const ImageLayout& layout, const FrameStages& stages,
                         const StageScene& scene) {
  std::int64_t planes = 0, most = 0;
  for (const LightSubimage& light : layout.light) {
    const Subimage& subimage = source.subimages()[light.index];
    if (!subimage.is_full_resolution()) continue;
    const bool receptors = has_receptors(light.channels);
    planes += LightPlanes::bytes(subimage, receptors);
    const FrameSize size = {subimage.data.width(), subimage.data.height(), receptors ? 7 : 3,
                            threads_in_use()};
    most = std::max(most, planned_bytes(subimage));
    for (const auto& stage : stages) most = std::max(most, stage->bytes(size, scene));
  }
  return planes + most;
}

}  // namespace scotopic
