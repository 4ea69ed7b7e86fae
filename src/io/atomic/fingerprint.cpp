#include "io/atomic/fingerprint.h"

#include <OpenImageIO/hash.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "base/error.h"

namespace scotopic {
namespace {

class Descriptor {
 public:
  explicit Descriptor(const std::string& file) : value(open(file.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (value >= 0) close(value);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  const int value;
};

[[noreturn]] void fail(const std::string& file) {
  throw Error(ExitCode::input, file, std::string("cannot be read: ") + std::strerror(errno));
}

/// Bytes read: fewer than the block's only at the end, so that the hash does not depend on how reads fall short.
std::size_t fill(int descriptor, std::vector<char>& block, const std::string& file) {
  std::size_t done = 0;
  while (done < block.size()) {
    const ssize_t n = ::read(descriptor, block.data() + done, block.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(file);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

}  // namespace

std::string fingerprint(const std::string& file) {
  const Descriptor descriptor(file);
  if (descriptor.value < 0) throw Error(ExitCode::input, file, std::strerror(errno));
  struct stat info = {};
  if (fstat(descriptor.value, &info) != 0) fail(file);
  if (!S_ISREG(info.st_mode)) throw Error(ExitCode::input, file, "is not a regular file");
  // What comes next is read while this is hashed.
  (void)posix_fadvise(descriptor.value, 0, 0, POSIX_FADV_SEQUENTIAL);
  std::vector<char> block(std::size_t{1} << 20);
  unsigned long long a = 0x5c0707c1, b = 0x9e3779b97f4a7c15;
  std::uint64_t size = 0;
  while (const std::size_t length = fill(descriptor.value, block, file)) {
    // Each block's hash is the next one's seed.
    a = OIIO::xxhash::XXH64(block.data(), length, a);
    b = OIIO::xxhash::XXH64(block.data(), length, b);
    size += length;
  }
  return fmt::format("{:016x}{:016x}-{}", a, b, size);
}

}  // namespace scotopic
