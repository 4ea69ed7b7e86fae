// What a fuzz target is: a function that takes any bytes, and inputs to begin with. The same source is a
// libFuzzer target (clang) and, with standalone_main.cpp, a program that replays files and mutates its seeds
// the same way each time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace scotopic::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// Well-formed inputs of the target.
std::vector<Bytes> seeds();

inline Bytes bytes_of(const std::string& text) { return Bytes(text.begin(), text.end()); }

inline Bytes file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

/// A file that the project ships, by its path in the source.
inline Bytes shipped(const char* name) {
  Bytes bytes = file_bytes(std::filesystem::path(SCOTOPIC_SOURCE_DIR) / name);
  if (bytes.empty()) throw std::runtime_error(std::string(name) + ": a seed, and not there");
  return bytes;
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return std::string(reinterpret_cast<const char*>(data), size);
}

/// Ends the program as a finding: the target broke a promise that no exception or sanitizer shows.
inline void expect(bool promise) {
  if (!promise) __builtin_trap();
}

/// A folder of the process's own, in memory where there is such a place.
inline const std::filesystem::path& scratch() {
  static const std::filesystem::path folder = [] {
    const std::filesystem::path shm = "/dev/shm";
    const auto base = std::filesystem::is_directory(shm) ? shm : std::filesystem::temp_directory_path();
    const auto out = base / ("scotopic-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(out);
    return out;
  }();
  return folder;
}

inline std::string scratch_file(const char* name, const std::uint8_t* data, std::size_t size) {
  const std::string file = (scratch() / name).string();
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return file;
}

}  // namespace scotopic::fuzz
