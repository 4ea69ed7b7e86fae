// Sequences: which frames, and what their files are called. Names are taken apart here, never given to
// printf.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scotopic {

/// Most frames that a list may name.
inline constexpr std::size_t max_frames = 1'000'000;

/// "7", "1-240", "1-240x2" (every second), "1-10,20,-5--1": each frame once, in the order listed; numbers of
/// up to 9 digits. Error(usage) for anything else, a range that runs backwards, or more than max_frames.
std::vector<int> parse_frames(const std::string& text);

/// Frames as parse_frames() reads them, ranges put together: "1-3, 7".
std::string frames_text(const std::vector<int>& frames);

/// A file's name with the frame's number in it, by the first of these that the name (not its folders) holds:
/// a run of #, one for each digit; %d, or %04d for zeros in front; a run of @, one for each digit. All of
/// them are replaced where it occurs more than once; where # is the number, a %d stays (it is the
/// wavelength's).
class FramePattern {
 public:
  /// Error(usage) for a name without a number in it; `what` is the argument to blame.
  FramePattern(const std::string& path, const std::string& what);

  /// The name of one frame's file. Numbers with more digits than the pattern has are written whole; the sign
  /// of a negative one counts as a digit.
  std::string path(int frame) const;

  /// Whether a name holds a number's place.
  static bool in(const std::string& path);

 private:
  struct Place {
    std::size_t at = 0, length = 0, digits = 0;
  };
  static std::vector<Place> places_in(const std::string& path);
  static std::vector<Place> runs_of(char c, const std::string& path);
  static std::vector<Place> percents_in(const std::string& path);

  std::string text_;
  std::vector<Place> places_;
};

}  // namespace scotopic
