// What a config shows: displays and views, and the shipped config's for who has no other.
#include "base/names.h"
#include "color/colour_config.h"
#include "color/config/shipped_config.h"

namespace scotopic {

std::vector<std::string> ColourConfig::displays() const {
  std::vector<std::string> out;
  for (int i = 0; i < config_->getNumDisplays(); ++i) out.emplace_back(config_->getDisplay(i));
  return out;
}

std::vector<std::string> ColourConfig::views(const std::string& display) const {
  std::vector<std::string> out;
  for (int i = 0; i < config_->getNumViews(display.c_str()); ++i)
    out.emplace_back(config_->getView(display.c_str(), i));
  return out;
}

ColourSpace ColourConfig::view(const std::string& name) const {
  const std::string usual = config_->getDefaultDisplay();
  std::vector<std::string> known;
  for (const std::string& view : views(usual)) {
    if (view == name) return {name, std::nullopt, DisplayView{usual, view}};
    known.push_back(view);
  }
  for (const std::string& display : displays())
    for (const std::string& view : views(display)) {
      known.push_back(display + "/" + view);
      if (known.back() == name) return {name, std::nullopt, DisplayView{display, view}};
    }
  fail("unknown view '" + name + "'" + did_you_mean(name, known));
}

std::string ColourConfig::looks_of(const DisplayView& view) const {
  const char* const looks = config_->getDisplayViewLooks(view.display.c_str(), view.view.c_str());
  return looks ? looks : "";
}

ColourSpace ColourConfig::display_space(const std::string& name) const {
  if (has_space(name)) return space(name);
  std::vector<std::string> known = names();
  for (const std::string& display : displays()) known.push_back(display);
  fail("no display or colour space is called '" + name + "'" + did_you_mean(name, known));
}

ColourConfig ColourConfig::holding(const std::string& view) const {
  if (!file_.empty()) return *this;
  for (const std::string& display : displays())
    for (const std::string& known : views(display))
      if (view == known || view == display + "/" + known) return *this;
  const std::string shipped = shipped_config_file();
  return shipped.empty() ? *this : from_file(shipped, limits_);
}

}  // namespace scotopic
