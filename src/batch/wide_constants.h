// StageConstants with each number as often as the widest vector has room for.
#pragma once

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include "stages/display/night_display.h"
#include "stages/noise/rod_noise.h"
#include "stages/shared/stage_constants.h"

namespace scotopic {

template <typename T>
const T& first_number(const StageConstants<T>& k) {
  return k.weight.unit;
}
template <typename T>
const T& first_number(const DisplayConstants<T>& k) {
  return k.scale;
}
template <typename T>
const T& first_number(const RodNoiseConstants<T>& k) {
  return k.weight.unit;
}

/// A constant is then an operand in memory, and takes no instruction of its own. (Too many for registers,
/// they would be spread again for each use.) Constants: a struct of nothing but numbers of its type T.
template <class Constants>
class WideNumbers {
 public:
  using T = std::remove_cvref_t<decltype(first_number(std::declval<const Constants&>()))>;
  static constexpr std::size_t lanes = 64 / sizeof(T);

  /// Spreads each number.
  explicit WideNumbers(const Constants& constants)
      : numbers(constants), wide_(hwy::AllocateAligned<T>(count * lanes)) {
    if (!wide_) throw std::bad_alloc();
    for (std::size_t i = 0; i < count; ++i) {
      T number{};
      std::memcpy(&number, reinterpret_cast<const std::byte*>(&numbers) + i * sizeof(T), sizeof number);
      std::fill_n(wide_.get() + i * lanes, lanes, number);
    }
  }
  WideNumbers(WideNumbers&&) = delete;  // of() takes addresses

  const Constants numbers;

  /// `number`, one of those in `numbers`, in every lane; aligned to 64 bytes.
  const T* of(const T& number) const noexcept {
    const auto offset =
        reinterpret_cast<std::uintptr_t>(&number) - reinterpret_cast<std::uintptr_t>(&numbers);
    return wide_.get() + offset / sizeof(T) * lanes;
  }

 private:
  static constexpr std::size_t count = sizeof(Constants) / sizeof(T);
  static_assert(sizeof(Constants) % sizeof(T) == 0 && alignof(Constants) == alignof(T));
  hwy::AlignedFreeUniquePtr<T[]> wide_;
};

/// Those of the operator's pixel stages.
template <typename T>
struct WideConstants : WideNumbers<StageConstants<T>> {
  explicit WideConstants(const OperatorConstants& c)
      : WideNumbers<StageConstants<T>>(StageConstants<T>(c)), on(c) {}

  const StageSwitches on;
};

}  // namespace scotopic
