// Spectral images as one file a wavelength: name_380.exr, name_390.exr, ...
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "base/error.h"
#include "io/spectral/spectral_source.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

struct Pattern {
  std::string before, after;
  std::size_t digits = 0;  // 0: any number of digits
};

// "%d", "%4d" or "%04d", once, in the file's name.
std::optional<Pattern> parse_pattern(const std::string& name) {
  const std::size_t percent = name.find('%');
  if (percent == name.npos || name.find('%', percent + 1) != name.npos) return std::nullopt;
  std::size_t end = percent + 1;
  while (end < name.size() && name[end] >= '0' && name[end] <= '9') ++end;
  if (end == name.size() || name[end] != 'd' || end - percent > 3) return std::nullopt;
  Pattern pattern{name.substr(0, percent), name.substr(end + 1), 0};
  if (end > percent + 1) std::from_chars(name.data() + percent + 1, name.data() + end, pattern.digits);
  return pattern;
}

std::optional<double> wavelength_in(const std::string& name, const Pattern& pattern) {
  const std::size_t around = pattern.before.size() + pattern.after.size();
  if (name.size() <= around || name.compare(0, pattern.before.size(), pattern.before) != 0 ||
      name.compare(name.size() - pattern.after.size(), pattern.after.size(), pattern.after) != 0)
    return std::nullopt;
  const std::size_t length = name.size() - around;
  if (length > 6 || length < pattern.digits) return std::nullopt;
  unsigned nm = 0;
  const char* const begin = name.data() + pattern.before.size();
  const auto [stop, error] = std::from_chars(begin, begin + length, nm);
  if (error != std::errc() || stop != begin + length || nm == 0) return std::nullopt;
  return static_cast<double>(nm);
}

}  // namespace

bool is_wavelength_pattern(const std::string& file) {
  return parse_pattern(fs::path(file).filename().string()).has_value();
}

std::vector<WavelengthFile> files_of_pattern(const std::string& pattern) {
  const fs::path path(pattern);
  const auto parsed = parse_pattern(path.filename().string());
  std::vector<WavelengthFile> files;
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (parsed)
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
      if (const auto nm = wavelength_in(entry->path().filename().string(), *parsed))
        files.push_back({(path.parent_path() / entry->path().filename()).string(), *nm});
  if (files.empty()) throw Error(ExitCode::input, pattern, "no file has such a name");
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.nm < b.nm; });
  for (std::size_t i = 1; i < files.size(); ++i)
    if (files[i].nm == files[i - 1].nm)
      throw Error(ExitCode::input, files[i].file, "has the wavelength of another file");
  return files;
}

}  // namespace scotopic
