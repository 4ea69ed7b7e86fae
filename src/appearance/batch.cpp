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
#include "appearance/batch_pixels-inl.h"
#include "appearance/batch_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

// A byte of 0 or 1 per bit, eight at a time.
HWY_INLINE void mark(std::uint8_t* touched, std::size_t lanes, std::uint64_t bits) {
  for (std::size_t i = 0; i < lanes; i += 8) {
    // Byte k keeps bit k of its copy of the eight; then any bit becomes 1.
    const std::uint64_t spread = (bits >> i & 0xff) * 0x0101010101010101u & 0x8040201008040201u;
    const std::uint64_t bytes = (spread + 0x7f7f7f7f7f7f7f7fu) >> 7 & 0x0101010101010101u;
    std::memcpy(touched + i, &bytes, std::min<std::size_t>(8, lanes - i));
  }
}

template <class D>
std::uint64_t lane_bits(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

// Computes in double the pixels at `at` that `bits` names; `lanes` pixels may be read.
template <class Rows>
void apply_exactly(const WideConstants<double>& exact, const Rows& rows, std::size_t at, std::size_t lanes,
                   std::uint64_t bits) {
  using D = Tag<double>;
  const D d;
  const PixelOperator<D> op(d, exact);
  Results<Element<Rows>> out;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    auto alpha = hn::Zero(hn::Rebind<Element<Rows>, D>());
    const auto p = load_pixels<Receptors::maybe>(d, rows, at + i, alpha);
    typename PixelOperator<D>::Seen seen;
    if (!op(p, seen)) continue;
    out.set(d, seen.rgb);
    const std::uint64_t here = bits >> i & lane_bits(d, seen.active);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
      if (here >> k & 1u) out.copy(k, rows, at + i + k);
  }
}

// Stores the lanes that `active` names, or computes them again where `doubtful`.
template <class Rows>
HWY_NOINLINE void store_some(const WideConstants<double>& exact, const Results<Element<Rows>>& out, const Rows& rows,
                             std::size_t at, std::size_t lanes, std::uint64_t active, std::uint64_t doubtful) {
  if (doubtful) apply_exactly(exact, rows, at, lanes, doubtful);
  for (std::size_t i = 0; i < lanes; ++i)
    if ((active & ~doubtful) >> i & 1u) out.copy(i, rows, at + i);
}

// One vector of pixels at `at`. Pixels that are not touched keep their bits.
template <StageSet stages, Receptors receptors, class D, class Rows>
HWY_INLINE void apply_vector(const PixelOperator<D, stages, receptors>& op, const WideConstants<double>& exact,
                             const Rows& rows, std::size_t at, std::uint8_t* touched) {
  using Operator = PixelOperator<D, stages, receptors>;
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  auto alpha = hn::Zero(hn::Rebind<Element<Rows>, D>());
  const auto p = load_pixels<receptors>(d, rows, at, alpha);
  typename Operator::Seen seen;
  if (!op(p, seen)) {
    if (touched) std::memset(touched + at, 0, lanes);
    return;
  }
  auto plain = seen.active;
  if constexpr (Operator::needs_more_digits) plain = hn::AndNot(seen.doubtful, seen.active);
  if (HWY_LIKELY(hn::AllTrue(d, plain))) {
    if (touched) std::memset(touched + at, 1, lanes);
    store_pixels(d, seen.rgb, rows, at, alpha);
    return;
  }
  const std::uint64_t active = lane_bits(d, seen.active);
  if (touched) mark(touched + at, lanes, active);
  if constexpr (std::is_same_v<hn::TFromD<D>, Element<Rows>>) {
    // Nothing is converted on the way out: what is not touched may be stored as it came.
    if (hn::AllFalse(d, seen.doubtful)) {
      store_pixels(d, op.select(seen.active, seen.rgb, p.rgb), rows, at, alpha);
      return;
    }
  }
  std::uint64_t doubtful = 0;
  if constexpr (Operator::needs_more_digits) doubtful = lane_bits(d, seen.doubtful);
  Results<Element<Rows>> out;
  out.set(d, seen.rgb);
  store_some(exact, out, rows, at, lanes, active, doubtful);
}

// Fewer pixels than a vector holds: through a padded copy, by the same arithmetic.
template <typename T, class Rows>
HWY_NOINLINE void apply_part(const WideConstants<T>& main, const WideConstants<double>& exact, const Rows& rows,
                             std::size_t at, std::size_t count, std::uint8_t* touched) {
  Padded<Rows> padded;
  padded.in(rows, at, count);
  std::uint8_t touched_copy[most_lanes] = {};
  const Tag<T> d;
  apply_vector(PixelOperator<Tag<T>>(d, main), exact, padded.rows, 0, touched_copy);
  padded.out(rows, at, count);
  if (touched) std::copy_n(touched_copy, count, touched + at);
}

// Aligning costs two parts: from so many vectors on it is worth it.
constexpr std::size_t worth_aligning = 64;

template <StageSet stages, Receptors receptors, typename T, class Rows>
void apply_stages(const WideConstants<T>& main, const WideConstants<double>& exact, const Rows& rows,
                  std::uint8_t* touched) {
  using D = Tag<T>;
  const PixelOperator<D, stages, receptors> op(D(), main);
  const std::size_t lanes = hn::Lanes(D());
  std::size_t at = 0;
  if (rows.count >= worth_aligning * lanes) at = before_aligned(rows, lanes);
  if (at) apply_part(main, exact, rows, 0, at, touched);
  for (; at + lanes <= rows.count; at += lanes) apply_vector(op, exact, rows, at, touched);
  if (at < rows.count) apply_part(main, exact, rows, at, rows.count - at, touched);
}

// Code for all stages and for any there is for every layout; for the others where it pays for its size: in float, on
// planes, which are what the image tool works on.
template <typename T, class Rows>
void apply_rgb(const WideConstants<T>& main, const WideConstants<double>& exact, const Rows& rows,
               std::uint8_t* touched) {
  constexpr Receptors absent = Receptors::absent;
  constexpr bool is_float = std::is_same_v<T, float>, planes = std::is_same_v<Rows, PixelRows>;
  const StageSet stages = main.numbers.stages();
  if (stages == StageSet::all) return apply_stages<StageSet::all, absent>(main, exact, rows, touched);
  if constexpr (std::is_same_v<Element<Rows>, float>)
    if (stages == StageSet::kernel) return apply_stages<StageSet::kernel, absent>(main, exact, rows, touched);
  if constexpr (is_float && planes) {
    if (stages == StageSet::grey) return apply_stages<StageSet::grey, absent>(main, exact, rows, touched);
    if (stages == StageSet::shift) return apply_stages<StageSet::shift, absent>(main, exact, rows, touched);
    if (stages == StageSet::luminance) return apply_stages<StageSet::luminance, absent>(main, exact, rows, touched);
    if (stages == StageSet::chroma) return apply_stages<StageSet::chroma, absent>(main, exact, rows, touched);
  }
  apply_stages<StageSet::any, Receptors::maybe>(main, exact, rows, touched);
}

template <typename T, class Rows>
void apply_type(const WideConstants<T>& main, const WideConstants<double>& exact, const Rows& rows,
                std::uint8_t* touched) {
  if (!main.numbers.safko && !(main.numbers.adaptation < T(photopic_luminance))) {
    if (touched) std::memset(touched, 0, rows.count);
    return;
  }
  if constexpr (std::is_same_v<Rows, PixelRows>) {
    const bool cones = rows.cone_l, rod = rows.rod;
    if constexpr (std::is_same_v<T, float>)
      if (cones && rod && main.numbers.stages() == StageSet::all)
        return apply_stages<StageSet::all, Receptors::given>(main, exact, rows, touched);
    if (cones || rod) return apply_stages<StageSet::any, Receptors::maybe>(main, exact, rows, touched);
  }
  apply_rgb(main, exact, rows, touched);
}

// `main` is null for double inside.
template <class Rows>
void apply_rows(const WideConstants<float>* main, const WideConstants<double>& exact, const Rows& rows,
                std::uint8_t* touched) {
  if (main)
    apply_type(*main, exact, rows, touched);
  else
    apply_type(exact, exact, rows, touched);
}

// All ways in.
void apply_planes(const WideConstants<float>* main, const WideConstants<double>& exact, const PixelRows& rows,
                  std::uint8_t* touched) {
  apply_rows(main, exact, rows, touched);
}
void apply_half_planes(const WideConstants<float>* main, const WideConstants<double>& exact, const HalfRows& rows,
                       std::uint8_t* touched) {
  apply_rows(main, exact, rows, touched);
}
void apply_rgba(const WideConstants<float>* main, const WideConstants<double>& exact, float* rgba, std::size_t count,
                std::uint8_t* touched) {
  apply_rows(main, exact, RgbaRows<float>{rgba, count}, touched);
}
void apply_half_rgba(const WideConstants<float>* main, const WideConstants<double>& exact, std::uint16_t* rgba,
                     std::size_t count, std::uint8_t* touched) {
  apply_rows(main, exact, RgbaRows<std::uint16_t>{rgba, count}, touched);
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
  explicit Constants(const OperatorConstants& c) : exact(c) {}

  WideConstants<double> exact;
  std::optional<WideConstants<float>> single;

  const WideConstants<float>* main() const { return single ? &*single : nullptr; }
};

AppearanceBatch::AppearanceBatch(const AppearanceParameters& parameters, Precision precision) {
  const OperatorConstants constants(parameters);
  auto made = std::make_unique<Constants>(constants);
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
