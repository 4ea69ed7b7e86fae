#include "color/config/config_glance.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "base/input_file.h"
#include "color/config/yaml_extent.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

// OpenColorIO's own configs nest 8 deep; its YAML parser gives up at 500, its transforms at the end of the
// stack.
constexpr int deepest = 128;
constexpr const char* size_option = "--max-config-size";

}  // namespace

bool is_archive(const std::string& file) {
  char start[4] = {};
  std::ifstream(file, std::ios::binary).read(start, sizeof start);
  return std::string_view(start, sizeof start) == std::string_view("PK\3\4", 4);
}

void require_modest_config(const std::string& file, const Limits& limits) {
  (void)check_input_file(file, ExitCode::config, limits.config, size_option);
  if (is_archive(file)) return;
  const std::string text = read_input_file(file, ExitCode::config, limits.config, size_option);
  if (text.find('\0') != std::string::npos)
    throw Error(ExitCode::config, file, "is no text in UTF-8, so no colour config");
  const YamlExtent extent = yaml_extent(text);
  if (extent.endless) throw Error(ExitCode::config, file, "a YAML alias stands within what it stands for");
  if (extent.depth > deepest)
    throw Error(ExitCode::config, file,
                fmt::format("nests more than {} deep: no colour config does", deepest));
  check_limit(file, "size in bytes, with its YAML aliases written out,", extent.size, limits.config,
              size_option);
}

std::string too_new(const std::string& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    int major = 0, minor = 0;
    if (std::sscanf(line.c_str(), "ocio_profile_version: %d.%d", &major, &minor) < 1) continue;
    const int here = OCIO::GetVersionHex() >> 16, wanted = major << 8 | minor;
    return wanted > here
               ? fmt::format("needs OpenColorIO {}.{}; this is {}", major, minor, OCIO::GetVersion())
               : "";
  }
  return "";
}

}  // namespace scotopic
