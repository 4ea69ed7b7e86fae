#include "pipeline/rows/row_codec.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/pixels/copy_pixels.h"
#include "pipeline/rows/dither.h"
#include "receptors/receptor_space.h"
#include "stages/lamp/lamp.h"
#include "stages/limits.h"

namespace scotopic {

PixelRows LightRow::pixels(bool receptors) {
  PixelRows rows;
  rows.r = r.data();
  rows.g = g.data();
  rows.b = b.data();
  rows.count = r.size();
  if (receptors) {
    rows.cone_l = cone_l.data();
    rows.cone_m = cone_m.data();
    rows.cone_s = cone_s.data();
    rows.rod = rod.data();
  }
  return rows;
}

namespace {

bool is_share(float alpha) { return alpha > 0 && std::isfinite(alpha); }

/// `again`: it was divided by before, where it could be.
void multiply_by_alpha(LightRow& row, bool again) {
  for (std::vector<float>* plane : {&row.r, &row.g, &row.b})
    for (std::size_t i = 0; i < plane->size(); ++i)
      if (again ? is_share(row.alpha[i]) : std::isfinite(row.alpha[i])) (*plane)[i] *= row.alpha[i];
}

}  // namespace

// Colour beside an alpha that is no number stays colour; beside 0 it is light that is added to what lies
// behind.
void divide_by_alpha(LightRow& row) {
  for (std::vector<float>* plane : {&row.r, &row.g, &row.b})
    for (std::size_t i = 0; i < plane->size(); ++i)
      if (is_share(row.alpha[i])) (*plane)[i] /= row.alpha[i];
}

LightReader::LightReader(const ColourChannels& channels, const ColourConfig& config, const ColourSpace& space)
    : channels_(channels),
      working_from_xyz_(inverse(config.xyz_from_working())),
      xyz_from_lms_(xyz_from_lms()) {
  if (receptors()) return;
  to_working_ = config.to_working(space);
  encoded_ = channels_.alpha && !config.linear_xyz(space);
}

bool LightReader::receptors() const noexcept { return has_receptors(channels_); }

void LightReader::set_rgb_from_xyz(const Vec3<double>& xyz, std::size_t i, LightRow& out) const {
  const Vec3<double> rgb = working_from_xyz_ * xyz;
  out.r[i] = static_cast<float>(rgb[0]);
  out.g[i] = static_cast<float>(rgb[1]);
  out.b[i] = static_cast<float>(rgb[2]);
}

void LightReader::read(const Band& band, int row, LightRow& out) const {
  using Kind = ColourChannels::Kind;
  const auto width = static_cast<std::size_t>(band.width);
  const auto load = [&](std::size_t i, std::vector<float>& values) {
    load_row(band.channels[channels_.index[i]].row(row), width, values.data());
  };
  if (channels_.alpha) load_row(band.channels[*channels_.alpha].row(row), width, out.alpha.data());
  if (channels_.kind == Kind::rgb) {
    load(0, out.r);
    load(1, out.g);
    load(2, out.b);
  } else if (channels_.kind == Kind::grey) {
    load(0, out.r);
    out.g = out.r;
    out.b = out.r;
  } else if (channels_.kind == Kind::lmsr) {
    load(0, out.cone_l);
    load(1, out.cone_m);
    load(2, out.cone_s);
    load(3, out.rod);
    for (std::size_t i = 0; i < width; ++i)
      set_rgb_from_xyz(xyz_from_lms_ * Vec3<double>{out.cone_l[i], out.cone_m[i], out.cone_s[i]}, i, out);
  } else if (channels_.kind == Kind::computed) {
    const auto plane = [&](std::size_t s) {
      return band.signals[s].data() + width * static_cast<std::size_t>(row);
    };
    std::vector<float>* const targets[4] = {&out.cone_l, &out.cone_m, &out.cone_s, &out.rod};
    for (std::size_t s = 0; s < 4; ++s) std::copy_n(plane(s), width, targets[s]->data());
    const bool xyz = !band.signals[4].empty();  // lmsr does without
    for (std::size_t i = 0; i < width; ++i)
      set_rgb_from_xyz(xyz ? Vec3<double>{plane(4)[i], plane(5)[i], plane(6)[i]}
                           : xyz_from_lms_ * Vec3<double>{out.cone_l[i], out.cone_m[i], out.cone_s[i]},
                       i, out);
  }
  const bool again = encoded_ && !channels_.straight;
  if (again) divide_by_alpha(out);
  to_working_.apply(out.r.data(), out.g.data(), out.b.data(), width);
  if (again || (channels_.alpha && channels_.straight)) multiply_by_alpha(out, again);
}

namespace {

/// What comes between the operator's result and the file's values.
void convert(const LightWriter& to, LightRow& light) {
  if (to.divide_by_alpha) divide_by_alpha(light);
  if (to.gain != 1)
    for (std::vector<float>* plane : {&light.r, &light.g, &light.b})
      for (float& value : *plane) value *= to.gain;
  to.from_working.apply(light.r.data(), light.g.data(), light.b.data(), light.r.size());
  if (to.multiply_by_alpha) multiply_by_alpha(light, true);
}

/// Only between the codes: what is beyond them is clipped, and counted, as it is.
void add_dither(LightRow& light, int x, int y) {
  for (std::size_t i = 0; i < light.r.size(); ++i) {
    const float offset = dither_of(x + static_cast<int>(i), y) / 255;
    for (std::vector<float>* plane : {&light.r, &light.g, &light.b})
      if (float& value = (*plane)[i]; value >= 0 && value <= 1) value += offset;
  }
}

}  // namespace

bool LightWriter::write(LightRow& light, const NativeRow (&out)[3], const NativeRow (*source)[3], int x,
                        int y) const {
  const std::size_t width = light.r.size();
  const std::uint8_t* const touched = light.touched.data();
  const auto keeps = [&](std::size_t c) {
    return keep_untouched && source && (*source)[c].type == out[c].type;
  };
  if (keeps(0) && keeps(1) && keeps(2) && !std::memchr(touched, 1, width)) {
    for (std::size_t c = 0; c < 3; ++c) copy_pixels((*source)[c], width, out[c]);
    return false;
  }
  convert(*this, light);
  if (dither && out[0].type == PixelType::uint8) add_dither(light, x, y);
  const bool all = std::memchr(touched, 0, width) == nullptr;
  const std::vector<float>* const planes[3] = {&light.r, &light.g, &light.b};
  for (std::size_t c = 0; c < 3; ++c) {
    store_row(planes[c]->data(), width, out[c]);
    if (keeps(c) && !all) copy_where_zero(touched, (*source)[c], width, out[c]);
  }
  return true;
}

void apply_matrices(const LightMatrices& matrices, bool receptors, LightRow& light) {
  const auto operable = [](float a, float b, float c) {
    return std::max({std::abs(a), std::abs(b), std::abs(c)}) <= static_cast<float>(operable_limit) &&
           a == a && b == b && c == c;
  };
  const auto set = [](const Vec3<double>& to, float& a, float& b, float& c) {
    a = static_cast<float>(to[0]), b = static_cast<float>(to[1]), c = static_cast<float>(to[2]);
  };
  light.changed.resize(light.r.size(), 0);
  for (std::size_t i = 0; i < light.r.size(); ++i) {
    if (!operable(light.r[i], light.g[i], light.b[i])) continue;
    if (receptors && !operable(light.cone_l[i], light.cone_m[i], light.cone_s[i])) continue;
    const Vec3<double> in = {light.r[i], light.g[i], light.b[i]};
    set(faded(matrices.rgb * in, in, matrices.luminance), light.r[i], light.g[i], light.b[i]);
    if (receptors)
      set(matrices.lms * Vec3<double>{light.cone_l[i], light.cone_m[i], light.cone_s[i]}, light.cone_l[i],
          light.cone_m[i], light.cone_s[i]);
    light.changed[i] = 1;
  }
}

std::uint64_t clipped_pixels(const LightRow& light, PixelType type) noexcept {
  if (type != PixelType::uint8 && type != PixelType::uint16) return 0;
  // By less than half a code nothing is lost.
  const float room = type == PixelType::uint8 ? 0.5f / 255 : 0.5f / 65535;
  const auto inside = [&](float x) { return x >= -room && x <= 1 + room; };
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < light.r.size(); ++i)
    count += !(inside(light.r[i]) && inside(light.g[i]) && inside(light.b[i]));
  return count;
}

std::uint64_t pixels_behind_alpha(const LightRow& light, float gain) noexcept {
  constexpr float seen = 1 / (255 * 12.92f);  // IEC 61966-2-1
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < light.alpha.size(); ++i)
    count += light.alpha[i] == 0 && gain * std::max({light.r[i], light.g[i], light.b[i]}) >= seen;
  return count;
}

}  // namespace scotopic
