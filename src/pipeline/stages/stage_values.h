// The table of stages, and what is asked of them as values.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "stages/description.h"
#include "stages/shared/parameters.h"

namespace scotopic {

struct ImageSettings;
class StageValues;

/// A line of the table.
struct StageEntry {
  const StageDescription* description = nullptr;
  /// Of a stage in the fused loop of pixel stages: what the values mean to it.
  void (*set)(const StageValues& values, AppearanceParameters& parameters) = nullptr;
  /// Of any other: adds it to what an image goes through. Null: nothing to add (display follows the output).
  void (*add)(const StageValues& values, ImageSettings& settings) = nullptr;
};

/// In the order in which light passes. What it points to must outlive all that was made of it.
using StageTable = std::span<const StageEntry>;

/// Those of this program: table.cpp.
StageTable shipped_stages() noexcept;

/// Whether --effects asks for a stage: by name in a list; under all and auto only where the stage can be
/// computed.
enum class EffectWish { no, if_known, yes };

/// A value for each parameter of a table, and a wish for each stage. Names of parameters are unique in it;
/// std::out_of_range for one that it does not have.
class StageValues {
 public:
  /// All at their defaults; all stages wished for if known.
  explicit StageValues(StageTable table = shipped_stages());

  StageTable table() const noexcept { return table_; }
  /// A number, or the place of a word.
  double number(std::string_view parameter) const { return slot(parameter).value; }
  /// The same, as an enumeration.
  template <typename Enum>
  Enum word(std::string_view parameter) const {
    return static_cast<Enum>(static_cast<int>(number(parameter)));
  }
  /// Whether it was set.
  bool given(std::string_view parameter) const { return slot(parameter).given; }
  /// Error(usage) outside its range, or where it is NaN.
  void set(std::string_view parameter, double value);
  /// By a word. Error(usage) for one that is not in its list.
  void set(std::string_view parameter, std::string_view word);

  EffectWish wish(std::string_view stage) const;
  void set_wish(std::string_view stage, EffectWish wish);
  /// "auto", "all", "none", or a list of names. Error(usage) for a name that is none.
  void set_effects(const std::string& list);
  /// Of the pixel stages, by their entries.
  void set_pixel_stages(AppearanceParameters& parameters) const;

 private:
  struct Slot {
    const StageParameter* parameter;
    double value;
    bool given;
  };
  const Slot& slot(std::string_view parameter) const;

  StageTable table_;
  std::vector<Slot> slots_;
  std::vector<EffectWish> wishes_;  // in the table's order
};

/// Whether a number is one of the parameter's; false for NaN.
bool accepts(const StageParameter& parameter, double value) noexcept;
/// "a number from 0 to 100, in years".
std::string range_text(const StageParameter& parameter);

/// "above, all, none".
std::string joined_words(const StageParameter& parameter);

/// The entry's place by the stage's name or alias; table.size() for none.
std::size_t place_of(StageTable table, std::string_view stage) noexcept;

/// What a list of --effects may name, with commas, in the table's order; `fused`: of the fused loop alone.
std::string effect_names(StageTable table, bool fused = false);

}  // namespace scotopic
