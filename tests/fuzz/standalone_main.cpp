// Runs a fuzz target without libFuzzer: seeds, files kept from earlier findings, and mutations that are the
// same in every run. For debuggers, for other compilers, and for the short form in the test suite.
//   replay_NAME [--mutations N] [--seed S] [--write-seeds FOLDER] [FILE or FOLDER]...
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>

#include "fuzz/target.h"

namespace {

using scotopic::fuzz::Bytes;

// SplitMix64.
struct Random {
  std::uint64_t state;
  std::uint64_t next() {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::size_t below(std::size_t n) { return n ? static_cast<std::size_t>(next() % n) : 0; }
};

// Places in a small file differ in what they mean: headers are hit as often as bodies.
std::size_t place(const Bytes& b, Random& random) {
  return random.below(2) ? random.below(b.size()) : random.below(std::min<std::size_t>(b.size(), 400));
}

void mutate_once(Bytes& b, const std::vector<Bytes>& seeds, Random& random) {
  static constexpr std::uint32_t words[] = {0,          1,          0xff,    0x7fffffff, 0x80000000,
                                            0xffffffff, 0x7f800000, 0x10000, 0x100};
  if (b.empty()) b.push_back(0);
  const std::size_t at = place(b, random);
  switch (random.below(7)) {
    case 0:
      b[at] ^= static_cast<std::uint8_t>(1u << random.below(8));
      break;
    case 1:
      b[at] = static_cast<std::uint8_t>(random.next());
      break;
    case 2: {
      const std::uint32_t word = words[random.below(std::size(words))];
      std::memcpy(b.data() + at, &word, std::min(sizeof word, b.size() - at));
      break;
    }
    case 3:
      b.erase(b.begin() + static_cast<std::ptrdiff_t>(at),
              b.begin() + static_cast<std::ptrdiff_t>(std::min(b.size(), at + 1 + random.below(16))));
      break;
    case 4:
      b.resize(at);
      break;
    case 5: {
      const Bytes piece(
          b.begin() + static_cast<std::ptrdiff_t>(at),
          b.begin() + static_cast<std::ptrdiff_t>(std::min(b.size(), at + 1 + random.below(64))));
      b.insert(b.begin() + static_cast<std::ptrdiff_t>(place(b, random)), piece.begin(), piece.end());
      break;
    }
    default: {
      const Bytes& other = seeds[random.below(seeds.size())];
      const std::size_t from = random.below(other.size());
      const std::size_t count =
          std::min({other.size() - from, b.size() - at, std::size_t{1} + random.below(64)});
      std::copy_n(other.begin() + static_cast<std::ptrdiff_t>(from), count,
                  b.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
}

void run(const Bytes& b) { LLVMFuzzerTestOneInput(b.data(), b.size()); }

std::size_t replay(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) {
    run(scotopic::fuzz::file_bytes(path));
    return 1;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    std::printf("%s\n", file.c_str());
    std::fflush(stdout);
    run(scotopic::fuzz::file_bytes(file));
  }
  return files.size();
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t mutations = 0, replayed = 0;
  Random random{1};
  std::vector<Bytes> seeds = scotopic::fuzz::seeds();
  for (int i = 1; i < argc; ++i) {
    const bool has_value = i + 1 < argc;
    if (std::strcmp(argv[i], "--mutations") == 0 && has_value) {
      mutations = std::strtoull(argv[++i], nullptr, 10);
    } else if (std::strcmp(argv[i], "--seed") == 0 && has_value) {
      random.state = std::strtoull(argv[++i], nullptr, 10);
    } else if (std::strcmp(argv[i], "--write-seeds") == 0 && has_value) {
      const std::filesystem::path folder = argv[++i];
      std::filesystem::create_directories(folder);
      for (std::size_t k = 0; k < seeds.size(); ++k)
        std::ofstream(folder / ("seed" + std::to_string(k)), std::ios::binary)
            .write(reinterpret_cast<const char*>(seeds[k].data()),
                   static_cast<std::streamsize>(seeds[k].size()));
    } else if (std::filesystem::exists(argv[i])) {
      replayed += replay(argv[i]);
    } else {
      std::fprintf(stderr, "%s: no such file or folder\n", argv[i]);
      return 2;
    }
  }
  for (const Bytes& seed : seeds) run(seed);
  const std::string last = (scotopic::fuzz::scratch() / "last").string();
  for (std::size_t i = 0; i < mutations; ++i) {
    Bytes b = seeds[random.below(seeds.size())];
    for (std::size_t k = 1 + random.below(4); k > 0; --k) mutate_once(b, seeds, random);
    // Kept when the target dies: the input that did it.
    std::ofstream(last, std::ios::binary)
        .write(reinterpret_cast<const char*>(b.data()), static_cast<std::streamsize>(b.size()));
    run(b);
  }
  std::printf("%zu seeds, %zu files, %zu mutations\n", seeds.size(), replayed, mutations);
  std::filesystem::remove_all(scotopic::fuzz::scratch());
  return 0;
}
