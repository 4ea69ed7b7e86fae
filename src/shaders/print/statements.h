// A record as statements of a C-like language: what is used twice gets a name, the rest stays inside
// expressions.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "shaders/record/record.h"

namespace scotopic::shaders {

/// How a language spells what the graph holds.
struct Spelling {
  std::string_view suffix;  ///< of numbers
  std::string_view truth;   ///< the type of a yes or no
  std::string_view min, max, abs, sqrt, exp, log, pow;
};

/// `type name = expression;`
struct Statement {
  std::string_view type;
  std::string name;
  std::string expression;
  std::string_view section;  ///< the stage it is of
};

/// In order; `of_sliders` are the same for all pixels, named c1, c2, ...; `of_pixel`, t1, t2, ..., follow
/// them.
struct Statements {
  std::vector<Statement> of_sliders, of_pixel;
  std::array<std::string, 3> out;  ///< R, G, B
  std::vector<Slider> used;
};

/// The pixel is r, g, b; sliders have their own names.
Statements statements_of(const Record& record, const Spelling& spelling);

/// As the language reads it: a point or an exponent in it. Infinity becomes the greatest float.
std::string number_in(const Spelling& spelling, double number);

}  // namespace scotopic::shaders
