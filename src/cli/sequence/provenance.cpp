#include "cli/sequence/provenance.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "base/digest.h"
#include "base/error.h"
#include "io/pixels/row_bands.h"
#include "io/spectral/spectral_source.h"
#include "pipeline/scene/stamps.h"

namespace scotopic {
namespace {

// Of verbs that write images. What they stand for otherwise is in the hash in other words, or changes no
// pixel.
constexpr std::array<std::string_view, 17> unstamped_options = {"help",
                                                                "verbose",
                                                                "quiet",
                                                                "json",
                                                                "threads",
                                                                "frames",
                                                                "frames-at-once",
                                                                "skip-existing",
                                                                "continue-on-error",
                                                                "adaptation-from",
                                                                "output",
                                                                "input",
                                                                "max-side",
                                                                "max-pixels",
                                                                "max-channels",
                                                                "max-band-bytes",
                                                                "version"};

std::string name_of(const CLI::Option& option) {
  if (!option.get_lnames().empty()) return option.get_lnames().front();
  return option.get_snames().empty() ? option.get_name() : option.get_snames().front();
}

bool is_file(const std::string& path) {
  struct stat info = {};
  return stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode);
}

/// A name and a value, so that no choice of values makes two different lists of them read the same.
std::string line(const std::string& name, const std::string& value) {
  return name + " " + std::to_string(value.size()) + ":" + value + "\n";
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// The last that was set: of a text that carries several, as a TIFF's description does.
std::string last_value(const std::string& text) {
  const std::string key = std::string(provenance_attribute) + "=";
  const std::size_t at = text.rfind(key);
  if (at == text.npos) return "";
  const std::size_t start = at + key.size();
  return text.substr(start, text.find('\n', start) - start);
}

std::string provenance_in(const PixelSource& source, std::size_t subimage) {
  for (const Attribute& a : source.attributes(subimage)) {
    const auto* text = std::get_if<std::string>(&a.value);
    if (!text) continue;
    if (a.name == provenance_attribute) return *text;
    if (const std::string found = a.name == "ImageDescription" ? last_value(*text) : ""; !found.empty())
      return found;
  }
  return "";
}

void read_last_rows(PixelSource& source, std::size_t index) {
  const Subimage& subimage = source.subimages()[index];
  if (!subimage.readable) return;
  Band band;
  int y0 = 0, rows = 0;
  each_band(subimage, subimage.descending, [&](int first, int count) { y0 = first, rows = count; });
  source.read(index, y0, rows, band);
}

}  // namespace

std::vector<std::string> typed_options(const CLI::App& verb) {
  std::vector<std::string> typed;
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = name_of(*option);
    if (option->count() == 0 ||
        std::find(unstamped_options.begin(), unstamped_options.end(), name) != unstamped_options.end())
      continue;
    for (const std::string& value : option->results()) typed.push_back(name + "=" + value);
  }
  return typed;
}

std::vector<std::string> input_files(const std::string& input) {
  struct stat info = {};
  if (stat(input.c_str(), &info) == 0) return {input};
  const int reason = errno;
  if (!is_wavelength_pattern(input)) throw Error(ExitCode::input, input, std::strerror(reason));
  std::vector<std::string> files;
  for (const WavelengthFile& file : files_of_pattern(input)) files.push_back(file.file);
  return files;
}

std::string colour_identity(const ColourConfig& config) { return config.ocio()->getCacheID(); }

std::string common_provenance(const std::string& verb, const FrameJob& job,
                              const std::vector<std::string>& typed) {
  std::string text =
      line("scotopic", SCOTOPIC_VERSION) + line("verb", verb) + line("settings", job.settings());
  for (const std::string& option : typed) {
    text += line("option", option);
    const std::string value = option.substr(option.find('=') + 1);
    if (is_file(value)) text += line("holds", sha256_of_file(value));
  }
  return text;
}

std::string provenance_of(const std::string& common, const FramePaths& paths) {
  std::string text = common + line("output", file_name(paths.output)) + line("input", file_name(paths.input));
  for (const std::string& file : input_files(paths.input))
    text += line(file_name(file), sha256_of_file(file));
  return sha256(text);
}

bool holds_provenance(const std::string& file, const std::string& provenance, const Limits& limits) {
  if (!is_file(file)) return false;
  try {
    const std::unique_ptr<PixelSource> source = open_source(file, limits);
    bool found = false;
    for (std::size_t i = 0; i < source->subimages().size(); ++i) {
      found = found || provenance_in(*source, i) == provenance;
      read_last_rows(*source, i);
    }
    return found;
  } catch (const Error&) {
    return false;  // damaged, or no image: it is made anew
  }
}

}  // namespace scotopic
