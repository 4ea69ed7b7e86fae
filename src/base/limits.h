// What a file may ask for, checked in 64 bits against what its header says, before anything is allocated.
#pragma once

#include <cstdint>
#include <string>

namespace scotopic {

/// Exceeding one is Error(ExitCode::limit); the message has the number, the limit and the option that raises
/// it.
struct Limits {
  std::int64_t side = 262144;                    ///< of a picture or a tile, --max-side
  std::int64_t pixels = std::int64_t{1} << 32;   ///< of a picture, --max-pixels
  std::int64_t channels = 4096;                  ///< of a picture, --max-channels
  std::int64_t bands = 4096;                     ///< of a spectrum, --max-bands
  std::int64_t memory = std::int64_t{4} << 30;   ///< bytes planned for rows on their way, --max-memory
  std::int64_t config = std::int64_t{64} << 20;  ///< bytes of a config, --max-config-size
  std::int64_t lut = std::int64_t{512} << 20;    ///< bytes of a LUT that a config names, --max-lut-size
};

/// Throws where `value` exceeds `limit`; `what` is what is counted. `option` is empty where none raises it.
void check_limit(const std::string& file, const char* what, std::int64_t value, std::int64_t limit,
                 const char* option);

/// As check_limit, for a product of numbers of 0 and more that may be too large for 64 bits.
void check_limit_product(const std::string& file, const char* what, std::int64_t a, std::int64_t b,
                         std::int64_t limit, const char* option);

}  // namespace scotopic
