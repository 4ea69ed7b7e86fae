#include "batch/batch.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/batch.cpp"
#include <hwy/foreach_target.h>
// foreach_target first: it includes this file once per target.
#include <hwy/highway.h>

#include "batch/batch_rows-inl.h"
#include "batch/wide_constants.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// The pixel stages on vectors of D, with their constants.
template <class D, StageSet stages = StageSet::any, Receptors receptors = Receptors::maybe>
struct Fused : PixelStages<LaneNumbers<D>, stages, receptors> {
  explicit Fused(const WideConstants<typename lanes::Types<D>::T>& wide)
      : PixelStages<LaneNumbers<D>, stages, receptors>(LaneNumbers<D>(wide), wide.numbers, wide.on) {}
};

// The same by code that asks which stages are on; made once for all layouts of pixels, as most of this file's
// code would be copies of it.
template <class D>
struct Asking {
  using Vector = hn::Vec<D>;
  using Seen = typename PixelStages<LaneNumbers<D>>::Seen;

  template <StageSet stages>
  HWY_NOINLINE static bool asked(const WideConstants<hn::TFromD<D>>& wide, const PixelIn<Vector>& p,
                                 Seen& seen) {
    return Fused<D, stages>(wide)(p, seen);
  }
  HWY_INLINE bool operator()(const PixelIn<Vector>& p, Seen& seen) const {
    if (HWY_UNLIKELY(wide.on.rod_input)) return asked<StageSet::any>(wide, p, seen);
    return asked<StageSet::usual>(wide, p, seen);
  }

  const WideConstants<hn::TFromD<D>>& wide;
};

// A byte of 0 or 1 per bit, eight at a time.
HWY_INLINE void mark(std::uint8_t* touched, std::size_t lanes, std::uint64_t bits) {
  for (std::size_t i = 0; i < lanes; i += 8) {
    // Byte k keeps bit k of its copy of the eight; then any bit becomes 1.
    const std::uint64_t spread = (bits >> i & 0xff) * 0x0101010101010101u & 0x8040201008040201u;
    const std::uint64_t bytes = (spread + 0x7f7f7f7f7f7f7f7fu) >> 7 & 0x0101010101010101u;
    std::memcpy(touched + i, &bytes, std::min<std::size_t>(8, lanes - i));
  }
}

template <class V, class M>
HWY_INLINE Triple<V> chosen(const M& mask, const Triple<V>& yes, const Triple<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

template <class D>
std::uint64_t lane_bits(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

// Computes in double the pixels at `at` that `bits` names, and says which of them were active; `lanes` pixels
// may be read.
template <class Rows>
std::uint64_t apply_exactly(const WideConstants<double>& exact, const Rows& rows, std::size_t at,
                            std::size_t lanes, std::uint64_t bits) {
  using D = Tag<double>;
  const D d;
  const Asking<D> op{exact};
  Results<Element<Rows>> out;
  std::uint64_t active = 0;
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
    auto alpha = hn::Zero(hn::Rebind<Element<Rows>, D>());
    const auto p = load_pixels<Receptors::maybe>(d, rows, at + i, alpha);
    typename Asking<D>::Seen seen;
    if (!op(p, seen)) continue;
    out.set(d, seen.rgb);
    const std::uint64_t here = bits >> i & lane_bits(d, seen.active);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
      if (here >> k & 1u) out.copy(k, rows, at + i + k);
    active |= here << i;
  }
  return active;
}

// Stores the lanes that `active` names, or computes them again where `doubtful`; says which were.
template <class Rows>
HWY_NOINLINE std::uint64_t store_some(const WideConstants<double>& exact, const Results<Element<Rows>>& out,
                                      const Rows& rows, std::size_t at, std::size_t lanes,
                                      std::uint64_t active, std::uint64_t doubtful) {
  active &= ~doubtful;
  for (std::size_t i = 0; i < lanes; ++i)
    if (active >> i & 1u) out.copy(i, rows, at + i);
  return doubtful ? active | apply_exactly(exact, rows, at, lanes, doubtful) : active;
}

// Stores the results of one vector of pixels, `p` as they came in. Pixels that are not touched keep their
// bits.
template <class D, class Rows>
HWY_INLINE void store_mixed(D d, const WideConstants<double>& exact, const PixelIn<hn::Vec<D>>& p,
                            const SeenPixel<hn::Vec<D>, hn::Mask<D>>& seen, const Rows& rows, std::size_t at,
                            ElementVector<D, Element<Rows>> alpha, std::uint8_t* touched) {
  const std::size_t lanes = hn::Lanes(d);
  const std::uint64_t active = lane_bits(d, seen.active), doubtful = lane_bits(d, seen.doubtful);
  if (active == 0 || (doubtful == 0 && std::is_same_v<hn::TFromD<D>, Element<Rows>>)) {
    if (touched) mark(touched + at, lanes, active);
    // Nothing is converted on the way out: what is not touched may be stored as it came.
    if (active != 0) store_pixels(d, chosen(seen.active, seen.rgb, p.rgb), rows, at, alpha);
    return;
  }
  Results<Element<Rows>> out;
  out.set(d, seen.rgb);
  const std::uint64_t changed = store_some(exact, out, rows, at, lanes, active, doubtful);
  if (touched) mark(touched + at, lanes, changed);
}

// One vector of pixels at `at`, by Fused or Asking.
template <Receptors receptors, class D, class Op, class Rows>
HWY_INLINE void apply_vector(D d, const Op& op, const WideConstants<double>& exact, const Rows& rows,
                             std::size_t at, std::uint8_t* touched) {
  auto alpha = hn::Zero(hn::Rebind<Element<Rows>, D>());
  const auto p = load_pixels<receptors>(d, rows, at, alpha);
  typename Op::Seen seen;
  if (!op(p, seen)) {
    if (touched) std::memset(touched + at, 0, hn::Lanes(d));
    return;
  }
  if (HWY_UNLIKELY(!hn::AllTrue(d, hn::AndNot(seen.doubtful, seen.active)))) {
    return store_mixed(d, exact, p, seen, rows, at, alpha, touched);
  }
  if (touched) std::memset(touched + at, 1, hn::Lanes(d));
  store_pixels(d, seen.rgb, rows, at, alpha);
}

template <typename T, class Rows>
HWY_INLINE void apply_any(const WideConstants<T>& main, const WideConstants<double>& exact, const Rows& rows,
                          std::size_t at, std::uint8_t* touched) {
  using D = Tag<T>;
  apply_vector<Receptors::maybe>(D(), Asking<D>{main}, exact, rows, at, touched);
}

// Two vectors of pixels, side by side: either waits for its own results alone.
template <StageSet stages, Receptors receptors, class D, class Rows>
HWY_INLINE void apply_pair(const PixelStages<LaneNumbers<lanes::PairTag<D>>, stages, receptors>& op,
                           const WideConstants<double>& exact, const Rows& rows, std::size_t at,
                           std::uint8_t* touched) {
  const D d;
  const std::size_t second = at + hn::Lanes(d);
  auto alpha_a = hn::Zero(hn::Rebind<Element<Rows>, D>()), alpha_b = alpha_a;
  const auto a = load_pixels<receptors>(d, rows, at, alpha_a),
             b = load_pixels<receptors>(d, rows, second, alpha_b);
  typename PixelStages<LaneNumbers<lanes::PairTag<D>>, stages, receptors>::Seen seen;
  if (!op(paired(a, b), seen)) {
    if (touched) std::memset(touched + at, 0, 2 * hn::Lanes(d));
    return;
  }
  const auto plain = lanes::AndNot(seen.doubtful, seen.active);
  if (HWY_UNLIKELY(!hn::AllTrue(d, hn::And(plain.a, plain.b)))) {
    store_mixed(d, exact, a, first_of(seen), rows, at, alpha_a, touched);
    return store_mixed(d, exact, b, second_of(seen), rows, second, alpha_b, touched);
  }
  if (touched) std::memset(touched + at, 1, 2 * hn::Lanes(d));
  store_pixels(d, first_of(seen).rgb, rows, at, alpha_a);
  store_pixels(d, second_of(seen).rgb, rows, second, alpha_b);
}

// Fewer pixels than a vector holds: through a padded copy, by the same arithmetic.
template <typename T, class Rows>
HWY_NOINLINE void apply_part(const WideConstants<T>& main, const WideConstants<double>& exact,
                             const Rows& rows, std::size_t at, std::size_t count, std::uint8_t* touched) {
  Padded<Rows> padded;
  padded.in(rows, at, count);
  std::uint8_t touched_copy[most_lanes] = {};
  apply_any(main, exact, padded.rows, 0, touched_copy);
  padded.out(rows, at, count);
  if (touched) std::copy_n(touched_copy, count, touched + at);
}

// Aligning costs two parts: from so many vectors on it is worth it.
constexpr std::size_t worth_aligning = 64;

template <class D>
using PairOf = lanes::PairTag<D>;

// The operator's stages hang on each other, a long chain; the kernel's few do not: there pairs are but more
// to hold.
constexpr bool in_pairs(StageSet stages) { return stages != StageSet::any && stages != StageSet::kernel; }

template <StageSet stages, Receptors receptors, typename T, class Rows>
void apply_stages(const WideConstants<T>& main, const WideConstants<double>& exact, const Rows& rows,
                  std::uint8_t* touched) {
  using D = Tag<T>;
  const std::size_t lanes = hn::Lanes(D());
  std::size_t at = 0;
  if (rows.count >= worth_aligning * lanes) at = before_aligned(rows, lanes);
  if (at) apply_part(main, exact, rows, 0, at, touched);
  if constexpr (in_pairs(stages)) {
    const Fused<PairOf<D>, stages, receptors> op(main);
    for (; at + 2 * lanes <= rows.count; at += 2 * lanes) apply_pair(op, exact, rows, at, touched);
  } else if constexpr (stages == StageSet::any) {
    for (; at + lanes <= rows.count; at += lanes) apply_any(main, exact, rows, at, touched);
  } else {
    const Fused<D, stages, receptors> op(main);
    for (; at + lanes <= rows.count; at += lanes) apply_vector<receptors>(D(), op, exact, rows, at, touched);
  }
  for (; at < rows.count; at += lanes)
    apply_part(main, exact, rows, at, std::min(lanes, rows.count - at), touched);
}

// Code of their own have all stages in float, for every layout; double, and the kernel, as planes; and on
// planes of float, which are what the image tool works on, what a plan leaves of the stages.
template <typename T, class Rows>
void apply_rgb(const WideConstants<T>& main, const WideConstants<double>& exact, const Rows& rows,
               std::uint8_t* touched) {
  constexpr Receptors absent = Receptors::absent;
  constexpr bool is_float = std::is_same_v<T, float>, planes = std::is_same_v<Rows, PixelRows>;
  const StageSet stages = stage_set(main.on);
  if constexpr (is_float || planes)
    if (stages == StageSet::all) return apply_stages<StageSet::all, absent>(main, exact, rows, touched);
  if constexpr (planes || (is_float && std::is_same_v<Rows, RgbaRows<float>>))
    if (stages == StageSet::kernel) return apply_stages<StageSet::kernel, absent>(main, exact, rows, touched);
  if constexpr (is_float && planes) {
    if (stages == StageSet::grey) return apply_stages<StageSet::grey, absent>(main, exact, rows, touched);
    if (stages == StageSet::shift) return apply_stages<StageSet::shift, absent>(main, exact, rows, touched);
    if (stages == StageSet::chroma) return apply_stages<StageSet::chroma, absent>(main, exact, rows, touched);
  }
  apply_stages<StageSet::any, Receptors::maybe>(main, exact, rows, touched);
}

template <typename T, class Rows>
void apply_type(const WideConstants<T>& main, const WideConstants<double>& exact, const Rows& rows,
                std::uint8_t* touched) {
  if (!main.on.safko && !(main.numbers.weight.adaptation < T(photopic_limit))) {
    if (touched) std::memset(touched, 0, rows.count);
    return;
  }
  if constexpr (std::is_same_v<Rows, PixelRows>) {
    const bool cones = rows.cone_l, rod = rows.rod;
    if constexpr (std::is_same_v<T, float>)
      if (cones && rod && stage_set(main.on) == StageSet::all)
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
void apply_half_planes(const WideConstants<float>* main, const WideConstants<double>& exact,
                       const HalfRows& rows, std::uint8_t* touched) {
  apply_rows(main, exact, rows, touched);
}
void apply_rgba(const WideConstants<float>* main, const WideConstants<double>& exact, float* rgba,
                std::size_t count, std::uint8_t* touched) {
  apply_rows(main, exact, RgbaRows<float>{rgba, count}, touched);
}
void apply_half_rgba(const WideConstants<float>* main, const WideConstants<double>& exact,
                     std::uint16_t* rgba, std::size_t count, std::uint8_t* touched) {
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
