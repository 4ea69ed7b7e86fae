#include "pipeline/frame_light.h"

#include <algorithm>

#include "io/row_bands.h"

namespace scotopic {

FrameLight::FrameLight(int width, int height, bool receptors)
    : width_(width), height_(height), receptors_(receptors), planes_(receptors ? 7 : 3) {
  for (std::vector<float>& plane : planes_) plane.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

std::int64_t FrameLight::bytes(const Picture& picture, bool receptors) {
  return std::int64_t{picture.data.width()} * picture.data.height() * (receptors ? 7 : 3) *
         static_cast<std::int64_t>(sizeof(float));
}

void FrameLight::set_row(int y, const LightRow& light) {
  const std::vector<float>* const rows[] = {&light.r, &light.g, &light.b, &light.cone_l, &light.cone_m, &light.cone_s, &light.rod};
  for (std::size_t k = 0; k < planes_.size(); ++k)
    std::copy_n(rows[k]->data(), width_, planes_[k].data() + static_cast<std::ptrdiff_t>(y) * width_);
}

void FrameLight::get_row(int y, LightRow& light) const {
  std::vector<float>* const rows[] = {&light.r, &light.g, &light.b, &light.cone_l, &light.cone_m, &light.cone_s, &light.rod};
  for (std::size_t k = 0; k < planes_.size(); ++k)
    std::copy_n(planes_[k].data() + static_cast<std::ptrdiff_t>(y) * width_, width_, rows[k]->data());
}

PixelRows FrameLight::row(int y, int x, int count) noexcept {
  const auto at = [&](std::size_t k) { return planes_[k].data() + static_cast<std::ptrdiff_t>(y) * width_ + x; };
  PixelRows out{at(0), at(1), at(2), nullptr, nullptr, nullptr, nullptr, static_cast<std::size_t>(count)};
  if (receptors_) out.cone_l = at(3), out.cone_m = at(4), out.cone_s = at(5), out.rod = at(6);
  return out;
}

GlarePicture FrameLight::glare_picture() noexcept {
  GlarePicture out;
  for (std::size_t k = 0; k < 3; ++k) out.rgb[k] = planes_[k].data();
  for (std::vector<float>& plane : planes_) out.light.push_back(plane.data());
  out.stride = width_;
  return out;
}

FrameLight read_frame(PixelSource& source, const LightPicture& light, const ColourConfig& config) {
  const Picture& picture = source.pictures()[light.index];
  const LightReader reader(light.channels, config, light.space);
  FrameLight out(picture.data.width(), picture.data.height(), reader.receptors());
  Band band;
  each_band(picture, false, [&](int y0, int rows) {
    source.read(light.index, y0, rows, band);
    parallel_rows(rows, 8, [&](int first, int last) {
      LightRow row(static_cast<std::size_t>(picture.data.width()));
      for (int i = first; i < last; ++i) {
        reader.read(band, i, row);
        out.set_row(y0 - picture.data.y0 + i, row);
      }
    });
  });
  return out;
}

SceneStatistics measure_frame(FrameLight& frame, const Picture& picture, const AppearanceParameters& parameters,
                              const std::optional<Window>& region) {
  const auto pixels = static_cast<std::uint64_t>(frame.width()) * static_cast<std::uint64_t>(frame.height());
  const SceneMeter meter(parameters, pixels);
  const Window all = picture.data, part = region.value_or(all);
  const int x0 = std::max(all.x0, part.x0), x1 = std::min(all.x1, part.x1);
  const int y0 = std::max(all.y0, part.y0), y1 = std::min(all.y1, part.y1);
  SceneStatistics out;
  for (int y = y0; y < y1 && x0 < x1; ++y) {
    const auto first = static_cast<std::uint64_t>(y - all.y0) * static_cast<std::uint64_t>(frame.width()) +
                       static_cast<std::uint64_t>(x0 - all.x0);
    meter.measure(frame.row(y - all.y0, x0 - all.x0, x1 - x0), first, out);
  }
  return out;
}

ParallelFor pool_for() {
  return [](int count, const std::function<void(int)>& task) {
    parallel_rows(count, 1, [&](int first, int last) {
      for (int i = first; i < last; ++i) task(i);
    });
  };
}

}  // namespace scotopic
