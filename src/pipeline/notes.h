// What the pipeline has to say while it works: lines, for whoever shows them.
#pragma once

#include <functional>
#include <string>

namespace scotopic {

/// Each may be empty. Several threads may speak at once.
struct Notes {
  std::function<void(const std::string& line)> on_note;    ///< what the user should know without asking
  std::function<void(const std::string& line)> on_detail;  ///< what was found and chosen, for who asks

  void note(const std::string& line) const {
    if (on_note) on_note(line);
  }
  void detail(const std::string& line) const {
    if (on_detail) on_detail(line);
  }
};

}  // namespace scotopic
