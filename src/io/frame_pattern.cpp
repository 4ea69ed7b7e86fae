#include "io/frame_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <unordered_set>

#include "base/error.h"

namespace scotopic {
namespace {

constexpr std::size_t most_digits = 9;

[[noreturn]] void fail_frames(const std::string& text, const std::string& why) {
  throw Error(ExitCode::usage, "", "--frames: '" + text + "' " + why);
}

/// A whole number at the start of `rest`, which is then what follows it.
int take_number(std::string_view& rest, const std::string& text) {
  constexpr const char* takes = "is not a list of frames, like 1-240, 1-240x2 or 1-10,20";
  int value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  const auto length = static_cast<std::size_t>(end - rest.data());
  if (error == std::errc::result_out_of_range || length > most_digits + 1)
    fail_frames(text, "has a number of too many digits");
  if (error != std::errc()) fail_frames(text, takes);
  rest.remove_prefix(length);
  return value;
}

bool take(char c, std::string_view& rest) {
  if (rest.empty() || rest.front() != c) return false;
  rest.remove_prefix(1);
  return true;
}

std::size_t name_start(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == path.npos ? 0 : slash + 1;
}

}  // namespace

std::vector<int> parse_frames(const std::string& text) {
  std::vector<int> frames;
  std::unordered_set<int> known;
  std::string_view rest = text;
  do {
    const int first = take_number(rest, text);
    const bool range = take('-', rest);
    const int last = range ? take_number(rest, text) : first;
    const int step = range && take('x', rest) ? take_number(rest, text) : 1;
    if (last < first) fail_frames(text, "has a range that runs backwards");
    if (step < 1) fail_frames(text, "has a step below 1");
    for (std::int64_t frame = first; frame <= last; frame += step) {
      if (known.insert(static_cast<int>(frame)).second) frames.push_back(static_cast<int>(frame));
      if (frames.size() > max_frames) fail_frames(text, fmt::format("names more than {} frames", max_frames));
    }
  } while (take(',', rest));
  if (!rest.empty()) fail_frames(text, "is not a list of frames, like 1-240, 1-240x2 or 1-10,20");
  return frames;
}

std::string frames_text(const std::vector<int>& frames) {
  std::string text;
  for (std::size_t first = 0, last = 0; first < frames.size(); first = last + 1) {
    for (last = first; last + 1 < frames.size() && frames[last + 1] == frames[last] + 1;) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", frames[first]);
    if (last > first) text += fmt::format("-{}", frames[last]);
  }
  return text;
}

std::vector<FramePattern::Place> FramePattern::runs_of(char c, const std::string& path) {
  std::vector<Place> places;
  for (std::size_t at = path.find(c, name_start(path)); at != path.npos; at = path.find(c, at)) {
    const std::size_t end = std::min(path.find_first_not_of(c, at), path.size());
    places.push_back({at, end - at, end - at});
    at = end;
  }
  return places;
}

// "%d" or "%0Nd"; any other % is a letter like another.
std::vector<FramePattern::Place> FramePattern::percents_in(const std::string& path) {
  std::vector<Place> places;
  for (std::size_t at = path.find('%', name_start(path)); at != path.npos; at = path.find('%', at + 1)) {
    std::size_t end = at + 1, digits = 1;
    if (end + 1 < path.size() && path[end] == '0' && path[end + 1] >= '1' && path[end + 1] <= '9') {
      digits = static_cast<std::size_t>(path[end + 1] - '0');
      end += 2;
    }
    if (end < path.size() && path[end] == 'd') places.push_back({at, end + 1 - at, digits});
  }
  return places;
}

std::vector<FramePattern::Place> FramePattern::places_in(const std::string& path) {
  std::vector<Place> places = runs_of('#', path);
  if (places.empty()) places = percents_in(path);
  if (places.empty()) places = runs_of('@', path);
  return places;
}

bool FramePattern::in(const std::string& path) { return !places_in(path).empty(); }

FramePattern::FramePattern(const std::string& path, const std::string& what)
    : text_(path), places_(places_in(path)) {
  if (places_.empty())
    throw Error(ExitCode::usage, path,
                what +
                    " has no place for the frame's number in its name, like ####, @@@@ or %04d, which "
                    "--frames needs");
}

std::string FramePattern::path(int frame) const {
  std::string out;
  std::size_t from = 0;
  for (const Place& place : places_) {
    out.append(text_, from, place.at - from);
    out += fmt::format("{:0{}}", frame, place.digits);
    from = place.at + place.length;
  }
  return out.append(text_, from);
}

}  // namespace scotopic
