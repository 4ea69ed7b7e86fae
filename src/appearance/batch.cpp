#include "appearance/batch.h"

#include <cstring>
#include <optional>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "appearance/batch.cpp"
#include <hwy/foreach_target.h>
// foreach_target first: it includes this file once per target.
#include <hwy/highway.h>

#include "appearance/batch_constants.h"
#include "appearance/batch_layouts-inl.h"
#include "appearance/batch_pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

// Pixels of R, G, B, A next to each other.
struct RgbaRows {
  float* rgba;
  std::size_t count;
};

// Pixels are float in memory; D may be double.
template <class D>
using Narrow = hn::Rebind<float, D>;

template <class D>
HWY_INLINE hn::Vec<D> widened(D d, hn::Vec<Narrow<D>> v) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float))
    return v;
  else
    return hn::PromoteTo(d, v);
}
template <class D>
HWY_INLINE hn::Vec<Narrow<D>> narrowed(D, hn::Vec<D> v) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float))
    return v;
  else
    return hn::DemoteTo(Narrow<D>(), v);
}
template <class D>
HWY_INLINE hn::Vec<D> load(D d, const float* from) {
  return widened(d, hn::LoadU(Narrow<D>(), from));
}
template <class D>
HWY_INLINE void store(D d, hn::Vec<D> v, float* to) {
  hn::StoreU(narrowed(d, v), Narrow<D>(), to);
}

// Loads pixels; `alpha` is for the layout that has it. Without receptors, the stages being the `usual`.
template <bool usual, class D>
HWY_INLINE PixelVector<hn::Vec<D>> load_pixels(D d, const PixelRows& rows, std::size_t at,
                                               hn::Vec<Narrow<D>>&) {
  const auto zero = hn::Zero(d);
  const Triple<hn::Vec<D>> rgb = {load(d, rows.r + at), load(d, rows.g + at), load(d, rows.b + at)};
  if constexpr (usual) return {rgb, {zero, zero, zero}, zero, false, false};
  const auto given = [&](const float* plane) { return plane ? load(d, plane + at) : zero; };
  return {rgb,
          {given(rows.cone_l), given(rows.cone_m), given(rows.cone_s)},
          given(rows.rod),
          rows.cone_l != nullptr,
          rows.rod != nullptr};
}
template <bool, class D>
HWY_INLINE PixelVector<hn::Vec<D>> load_pixels(D d, const RgbaRows& rows, std::size_t at,
                                               hn::Vec<Narrow<D>>& alpha) {
  auto r = alpha, g = alpha, b = alpha;
  hn::LoadInterleaved4(Narrow<D>(), rows.rgba + 4 * at, r, g, b, alpha);
  const auto zero = hn::Zero(d);
  return {{widened(d, r), widened(d, g), widened(d, b)}, {zero, zero, zero}, zero, false, false};
}

template <class D>
HWY_INLINE void store_pixels(D d, const Triple<hn::Vec<D>>& rgb, const PixelRows& rows, std::size_t at,
                             hn::Vec<Narrow<D>>) {
  store(d, rgb.x, rows.r + at);
  store(d, rgb.y, rows.g + at);
  store(d, rgb.z, rows.b + at);
}
template <class D>
HWY_INLINE void store_pixels(D d, const Triple<hn::Vec<D>>& rgb, const RgbaRows& rows, std::size_t at,
                             hn::Vec<Narrow<D>> alpha) {
  hn::StoreInterleaved4(narrowed(d, rgb.x), narrowed(d, rgb.y), narrowed(d, rgb.z), alpha, Narrow<D>(),
                        rows.rgba + 4 * at);
}

// A vector's worth of results, and a bit per lane.
struct Lanes {
  HWY_ALIGN float r[HWY_MAX_BYTES / sizeof(float)], g[HWY_MAX_BYTES / sizeof(float)],
      b[HWY_MAX_BYTES / sizeof(float)];

  template <class D>
  void set(D d, const Triple<hn::Vec<D>>& rgb) {
    store(d, rgb.x, r), store(d, rgb.y, g), store(d, rgb.z, b);
  }
  void copy(std::size_t lane, const PixelRows& rows, std::size_t to) const {
    rows.r[to] = r[lane], rows.g[to] = g[lane], rows.b[to] = b[lane];
  }
  void copy(std::size_t lane, const RgbaRows& rows, std::size_t to) const {
    float* const pixel = rows.rgba + 4 * to;
    pixel[0] = r[lane], pixel[1] = g[lane], pixel[2] = b[lane];
  }
};

template <class D>
std::uint64_t lane_bits(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

// A byte of 0 or 1 per bit, eight at a time.
HWY_INLINE void mark(std::uint8_t* touched, std::size_t lanes, std::uint64_t bits) {
  for (std::size_t i = 0; i < lanes; i += 8) {
    // Byte k keeps bit k of its copy of the eight; then any bit becomes 1.
    const std::uint64_t spread = (bits >> i & 0xff) * 0x0101010101010101u & 0x8040201008040201u;
    const std::uint64_t bytes = (spread + 0x7f7f7f7f7f7f7f7fu) >> 7 & 0x0101010101010101u;
    std::memcpy(touched + i, &bytes, std::min<std::size_t>(8, lanes - i));
  }
}

// The constants in the type that pixels are computed in, and in double for those that need it.
template <typename T, bool usual_stages>
struct Operators {
  static constexpr bool usual = usual_stages;
  PixelOperator<hn::ScalableTag<T>, usual> main;
  PixelOperator<hn::ScalableTag<double>> exact;
};

// Computes in double the pixels at `at` that `bits` names; `lanes` pixels may be read.
template <class Rows>
HWY_NOINLINE void apply_exactly(const PixelOperator<hn::ScalableTag<double>>& op, const Rows& rows,
                                std::size_t at, std::size_t lanes, std::uint64_t bits) {
  const hn::ScalableTag<double> d;
  Lanes out;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    auto alpha = hn::Zero(Narrow<hn::ScalableTag<double>>());
    auto p = load_pixels<false>(d, rows, at + i, alpha);
    auto ignored = hn::MaskFromVec(hn::Zero(d));
    op(p, ignored);
    out.set(d, p.rgb);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
      if (bits >> (i + k) & 1u) out.copy(k, rows, at + i + k);
  }
}

// One vector of pixels at `at`. Pixels that are not touched keep their bits: they are not stored.
template <typename T, bool usual, class Rows>
HWY_INLINE void apply_vector(const Operators<T, usual>& op, const Rows& rows, std::size_t at,
                             std::uint8_t* touched) {
  using D = hn::ScalableTag<T>;
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  auto alpha = hn::Zero(Narrow<D>());
  auto p = load_pixels<usual>(d, rows, at, alpha);
  auto doubtful = hn::MaskFromVec(hn::Zero(d));
  const auto active = op.main(p, doubtful);
  const std::uint64_t active_bits = lane_bits(d, active);
  if (touched) mark(touched + at, lanes, active_bits);
  if (active_bits == 0) return;
  const std::uint64_t exact_bits = std::is_same_v<T, double> ? 0 : lane_bits(d, doubtful);
  if (hn::AllTrue(d, active) && exact_bits == 0) {
    store_pixels(d, p.rgb, rows, at, alpha);
    return;
  }
  if (exact_bits) apply_exactly(op.exact, rows, at, lanes, exact_bits);
  Lanes out;
  out.set(d, p.rgb);
  for (std::size_t i = 0; i < lanes; ++i)
    if ((active_bits & ~exact_bits) >> i & 1u) out.copy(i, rows, at + i);
}

// The last pixels, fewer than a vector: through a padded copy, by the same instructions.
template <typename T, bool usual>
HWY_NOINLINE void apply_tail(const Operators<T, usual>& op, const PixelRows& rows, std::size_t at,
                             std::uint8_t* touched) {
  constexpr std::size_t most = HWY_MAX_BYTES / sizeof(float);
  float copy[7][most] = {};
  std::uint8_t touched_copy[most] = {};
  const std::size_t count = rows.count - at;
  const auto fill = [&](const float* plane, float* to) -> float* {
    if (!plane) return nullptr;
    std::copy_n(plane + at, count, to);
    return to;
  };
  const PixelRows padded = {fill(rows.r, copy[0]),      fill(rows.g, copy[1]),
                            fill(rows.b, copy[2]),      fill(rows.cone_l, copy[3]),
                            fill(rows.cone_m, copy[4]), fill(rows.cone_s, copy[5]),
                            fill(rows.rod, copy[6]),    most};
  apply_vector(op, padded, 0, touched_copy);
  std::copy_n(copy[0], count, rows.r + at);
  std::copy_n(copy[1], count, rows.g + at);
  std::copy_n(copy[2], count, rows.b + at);
  if (touched) std::copy_n(touched_copy, count, touched + at);
}

template <typename T, bool usual>
HWY_NOINLINE void apply_tail(const Operators<T, usual>& op, const RgbaRows& rows, std::size_t at,
                             std::uint8_t* touched) {
  constexpr std::size_t most = HWY_MAX_BYTES / sizeof(float);
  float copy[4 * most] = {};
  std::uint8_t touched_copy[most] = {};
  const std::size_t count = rows.count - at;
  std::copy_n(rows.rgba + 4 * at, 4 * count, copy);
  apply_vector(op, RgbaRows{copy, most}, 0, touched_copy);
  std::copy_n(copy, 4 * count, rows.rgba + 4 * at);
  if (touched) std::copy_n(touched_copy, count, touched + at);
}

template <bool usual, typename T, class Rows>
void apply_stages(const BatchConstants<T>& main, const BatchConstants<double>& exact, const Rows& rows,
                  std::uint8_t* touched) {
  const Operators<T, usual> op{{hn::ScalableTag<T>(), main}, {hn::ScalableTag<double>(), exact}};
  const std::size_t lanes = hn::Lanes(hn::ScalableTag<T>());
  std::size_t at = 0;
  for (; at + lanes <= rows.count; at += lanes) apply_vector(op, rows, at, touched);
  if (at < rows.count) apply_tail(op, rows, at, touched);
}

bool has_receptors(const PixelRows& rows) { return rows.cone_l || rows.rod; }
bool has_receptors(const RgbaRows&) { return false; }

template <typename T, class Rows>
void apply_type(const BatchConstants<T>& main, const BatchConstants<double>& exact, const Rows& rows,
                std::uint8_t* touched) {
  if (main.usual && !has_receptors(rows))
    apply_stages<true>(main, exact, rows, touched);
  else
    apply_stages<false>(main, exact, rows, touched);
}

// `main` is null for double inside.
template <class Rows>
void apply_rows(const BatchConstants<float>* main, const BatchConstants<double>& exact, const Rows& rows,
                std::uint8_t* touched) {
  if (main)
    apply_type(*main, exact, rows, touched);
  else
    apply_type(exact, exact, rows, touched);
}

// All ways in.
void apply_planes(const BatchConstants<float>* main, const BatchConstants<double>& exact,
                  const PixelRows& rows, std::uint8_t* touched) {
  apply_rows(main, exact, rows, touched);
}
void apply_rgba(const BatchConstants<float>* main, const BatchConstants<double>& exact, float* rgba,
                std::size_t count, std::uint8_t* touched) {
  apply_rows(main, exact, RgbaRows{rgba, count}, touched);
}

template <class Layout>
void apply_layout(const BatchConstants<float>* main, const BatchConstants<double>& exact,
                  const Layout& layout, std::size_t count, std::uint8_t* touched) {
  apply_in_blocks(layout, count, touched, [&](const PixelRows& block, std::uint8_t* touched_here) {
    apply_planes(main, exact, block, touched_here);
  });
}

void apply_half_planes(const BatchConstants<float>* main, const BatchConstants<double>& exact,
                       const HalfRows& rows, std::uint8_t* touched) {
  apply_layout(main, exact, HalfPlanes{rows.r, rows.g, rows.b}, rows.count, touched);
}
void apply_half_rgba(const BatchConstants<float>* main, const BatchConstants<double>& exact,
                     std::uint16_t* rgba, std::size_t count, std::uint8_t* touched) {
  apply_layout(main, exact, HalfRgba{rgba}, count, touched);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic {

HWY_EXPORT(apply_planes);
HWY_EXPORT(apply_half_planes);
HWY_EXPORT(apply_rgba);
HWY_EXPORT(apply_half_rgba);

struct AppearanceBatch::Constants {
  BatchConstants<double> exact;
  std::optional<BatchConstants<float>> single;

  const BatchConstants<float>* main() const { return single ? &*single : nullptr; }
};

AppearanceBatch::AppearanceBatch(const AppearanceParameters& parameters, Precision precision) {
  const OperatorConstants constants(parameters);
  auto made = std::make_unique<Constants>(Constants{BatchConstants<double>(constants), {}});
  if (precision == Precision::single) made->single.emplace(constants);
  constants_ = std::move(made);
}

AppearanceBatch::~AppearanceBatch() = default;
AppearanceBatch::AppearanceBatch(AppearanceBatch&&) noexcept = default;
AppearanceBatch& AppearanceBatch::operator=(AppearanceBatch&&) noexcept = default;

void AppearanceBatch::apply(const PixelRows& rows, std::uint8_t* touched) const noexcept {
  HWY_DYNAMIC_DISPATCH(apply_planes)(constants_->main(), constants_->exact, rows, touched);
}

void AppearanceBatch::apply(const HalfRows& rows, std::uint8_t* touched) const noexcept {
  HWY_DYNAMIC_DISPATCH(apply_half_planes)(constants_->main(), constants_->exact, rows, touched);
}

void AppearanceBatch::apply_rgba(float* rgba, std::size_t count, std::uint8_t* touched) const noexcept {
  HWY_DYNAMIC_DISPATCH(apply_rgba)(constants_->main(), constants_->exact, rgba, count, touched);
}

void AppearanceBatch::apply_rgba(std::uint16_t* rgba, std::size_t count,
                                 std::uint8_t* touched) const noexcept {
  HWY_DYNAMIC_DISPATCH(apply_half_rgba)(constants_->main(), constants_->exact, rgba, count, touched);
}

const char* simd_target() noexcept {
  // Targets are bits, better ones lower.
  const std::int64_t supported = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(supported & -supported);
}

}  // namespace scotopic
#endif  // HWY_ONCE
