#include "base/limits.h"

#include <fmt/format.h>

#include "base/error.h"

namespace scotopic {
namespace {

[[noreturn]] void fail(const std::string& file, const char* what, const std::string& value,
                       std::int64_t limit, const char* option) {
  throw Error(ExitCode::limit, file,
              fmt::format("{} {} exceeds the limit of {}{}", what, value, limit,
                          *option ? fmt::format(" (raise it with {})", option) : ""));
}

}  // namespace

void check_limit(const std::string& file, const char* what, std::int64_t value, std::int64_t limit,
                 const char* option) {
  if (value > limit) fail(file, what, std::to_string(value), limit, option);
}

void check_limit_product(const std::string& file, const char* what, std::int64_t a, std::int64_t b,
                         std::int64_t limit, const char* option) {
  std::int64_t product = 0;
  if (__builtin_mul_overflow(a, b, &product)) fail(file, what, fmt::format("{} x {}", a, b), limit, option);
  check_limit(file, what, product, limit, option);
}

}  // namespace scotopic
