#include "color/config/lost_displays.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <string>

#include "base/names.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

bool valid(const OCIO::Config& config) {
  try {
    config.validate();
    return true;
  } catch (const OCIO::Exception&) {
    return false;
  }
}

}  // namespace

void forget_lost_displays(OCIO::Config& config) {
  if (valid(config)) return;
  std::set<std::string> known;
  for (int d = 0; d < config.getNumDisplaysAll(); ++d) known.insert(lower(config.getDisplayAll(d)));
  std::istringstream names(config.getActiveDisplays());
  std::string kept;
  bool lost = false;
  for (std::string name; std::getline(names, name, ',');) {
    name = trimmed(name);
    if (known.count(lower(name)))
      add_to_list(kept, name);
    else
      lost = true;
  }
  if (lost && !kept.empty()) config.setActiveDisplays(kept.c_str());
}

}  // namespace scotopic
