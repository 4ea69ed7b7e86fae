// What a stage tells of itself: the one place that options, help, --effects, Python's keywords, a plug-in's
// parameters and the documents are made from.
#pragma once

#include <span>
#include <string_view>

namespace scotopic {

/// What of a picture a stage looks at for one pixel of its result.
enum class StageSupport {
  pixel,          ///< that pixel
  neighbourhood,  ///< those around it
  frame,          ///< all of them
};

/// A parameter. Its name is that of the option: "age" is --age.
struct StageParameter {
  std::string_view name;
  std::string_view unit;  ///< empty: a plain number
  double low = 0, high = 0;
  double initial = 0;
  std::string_view sentence;
  /// Where it is not a number: what it may be called; the value is the place in this list.
  std::span<const std::string_view> words = {};
  /// An older name that still works; empty: none.
  std::string_view alias = {};
  bool whole = false;  ///< a number without a fraction
};

/// The strength that most stages have.
constexpr StageParameter strength_of(std::string_view name, std::string_view sentence) {
  return {name, "", 0, 1, 1, sentence};
}

/// A stage.
struct StageDescription {
  std::string_view name;   ///< the word of --effects
  std::string_view alias;  ///< an older word for it; empty: none
  std::string_view group;  ///< heading of its options
  StageSupport support = StageSupport::pixel;
  std::string_view takes, gives;
  std::string_view passes_when;    ///< a pixel keeps its bits when
  std::string_view not_in_a_look;  ///< why a LUT cannot hold it; empty: it can
  std::string_view switched_by;    ///< the option that calls for it; empty: --effects
  std::span<const StageParameter> parameters;
};

}  // namespace scotopic
