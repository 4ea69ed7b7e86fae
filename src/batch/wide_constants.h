// StageConstants with each number as often as the widest vector has room for.
#pragma once

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>

#include "stages/shared/stage_constants.h"

namespace scotopic {

/// A constant is then an operand in memory, and takes no instruction of its own. (Too many for registers, they would be
/// spread again for each use.)
template <typename T>
class WideConstants {
 public:
  static constexpr std::size_t lanes = 64 / sizeof(T);

  /// Spreads each number.
  explicit WideConstants(const OperatorConstants& c)
      : numbers(c), on(c), wide_(hwy::AllocateAligned<T>(count * lanes)) {
    if (!wide_) throw std::bad_alloc();
    for (std::size_t i = 0; i < count; ++i) {
      T number{};
      std::memcpy(&number, reinterpret_cast<const std::byte*>(&numbers) + i * sizeof(T), sizeof number);
      std::fill_n(wide_.get() + i * lanes, lanes, number);
    }
  }
  WideConstants(WideConstants&&) = delete;  // of() takes addresses

  const StageConstants<T> numbers;
  const StageSwitches on;

  /// `number`, one of those in `numbers`, in every lane; aligned to 64 bytes.
  const T* of(const T& number) const noexcept {
    const auto offset = reinterpret_cast<std::uintptr_t>(&number) - reinterpret_cast<std::uintptr_t>(&numbers);
    return wide_.get() + offset / sizeof(T) * lanes;
  }

 private:
  static constexpr std::size_t count = sizeof(StageConstants<T>) / sizeof(T);
  static_assert(sizeof(StageConstants<T>) % sizeof(T) == 0 && alignof(StageConstants<T>) == alignof(T));
  hwy::AlignedFreeUniquePtr<T[]> wide_;
};

}  // namespace scotopic
