#include "batch/display_batch.h"

#include <optional>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/display_batch.cpp"
#include <hwy/foreach_target.h>
// foreach_target first: it includes this file once per target.
#include <hwy/highway.h>

#include "batch/batch_rows-inl.h"
#include "stages/display/night_display-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

// Stores what becomes of the pixels at `at`; says of each whether it changed.
template <class D>
HWY_INLINE void show_vector(D d, const WideNumbers<DisplayConstants<hn::TFromD<D>>>& k,
                            const DisplaySwitches& on, const PixelRows& rows, std::size_t at,
                            std::uint8_t* touched) {
  const LaneNumbers<D, DisplayConstants<hn::TFromD<D>>> n(k);
  const Triple<hn::Vec<D>> in = {load(d, rows.r + at), load(d, rows.g + at), load(d, rows.b + at)};
  const auto limit = n.number(hn::TFromD<D>(operable_limit));
  const auto operable = n.both(n.both(n.less_equal(n.abs(in.x), limit), n.less_equal(n.abs(in.y), limit)),
                               n.less_equal(n.abs(in.z), limit));
  const Triple<hn::Vec<D>> out = select(n, operable, night_display(n, k.numbers, on, in), in);
  store(d, out.x, rows.r + at);
  store(d, out.y, rows.g + at);
  store(d, out.z, rows.b + at);
  if (!touched) return;
  const auto changed =
      n.either(n.either(n.not_equal(out.x, in.x), n.not_equal(out.y, in.y)), n.not_equal(out.z, in.z));
  if (n.none(n.both(changed, operable))) return;
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, n.both(changed, operable), bits);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i)
    touched[at + i] = static_cast<std::uint8_t>(touched[at + i] | (bits[i / 8] >> (i % 8) & 1u));
}

template <typename T>
void show_rows(const WideNumbers<DisplayConstants<T>>& k, const DisplaySwitches& on, const PixelRows& rows,
               std::uint8_t* touched) {
  const Tag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t at = 0;
  for (; at + lanes <= rows.count; at += lanes) show_vector(d, k, on, rows, at, touched);
  if (at == rows.count) return;
  Padded<PixelRows> padded;
  padded.in(rows, at, rows.count - at);
  std::uint8_t touched_copy[most_lanes] = {};
  show_vector(d, k, on, padded.rows, 0, touched_copy);
  padded.out(rows, at, rows.count - at);
  if (touched)
    for (std::size_t i = at; i < rows.count; ++i)
      touched[i] = static_cast<std::uint8_t>(touched[i] | touched_copy[i - at]);
}

void show_single(const WideNumbers<DisplayConstants<float>>& k, const DisplaySwitches& on,
                 const PixelRows& rows, std::uint8_t* touched) {
  show_rows(k, on, rows, touched);
}
void show_dual(const WideNumbers<DisplayConstants<double>>& k, const DisplaySwitches& on,
               const PixelRows& rows, std::uint8_t* touched) {
  show_rows(k, on, rows, touched);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic {

HWY_EXPORT(show_single);
HWY_EXPORT(show_dual);

struct DisplayBatch::Constants {
  Constants(const NightDisplayParameters& p, Precision precision)
      : on(p), range_kept(p.shoulder == Shoulder::clip && display_scale(p) == 1) {
    if (precision == Precision::single)
      single.emplace(DisplayConstants<float>(p));
    else
      dual.emplace(DisplayConstants<double>(p));
  }

  DisplaySwitches on;
  bool range_kept;
  std::optional<WideNumbers<DisplayConstants<float>>> single;
  std::optional<WideNumbers<DisplayConstants<double>>> dual;
};

DisplayBatch::DisplayBatch(const NightDisplayParameters& parameters, Precision precision)
    : constants_(std::make_unique<const Constants>(parameters, precision)) {}
DisplayBatch::~DisplayBatch() = default;

bool DisplayBatch::keeps_range() const noexcept { return constants_->range_kept; }

void DisplayBatch::apply(const PixelRows& rows, std::uint8_t* touched) const noexcept {
  if (constants_->single)
    HWY_DYNAMIC_DISPATCH(show_single)(*constants_->single, constants_->on, rows, touched);
  else
    HWY_DYNAMIC_DISPATCH(show_dual)(*constants_->dual, constants_->on, rows, touched);
}

}  // namespace scotopic
#endif  // HWY_ONCE
