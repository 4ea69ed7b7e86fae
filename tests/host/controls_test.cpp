// Parameters by name, and the controls that panels are made of.
#include "scotopic/controls.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "host/parameters.h"

namespace scotopic {
namespace {

TEST(Controls, at_their_ends_are_values_that_the_program_takes) {
  for (const Control& c : controls()) {
    std::vector<std::string> values = c.words;
    if (c.kind == Control::Kind::number) values = {parameter_text(c.low), parameter_text(c.high)};
    for (const std::string& value : values) {
      EXPECT_NO_THROW((void)options_of(Parameters{{c.name, value}})) << c.name << " " << value;
    }
  }
}

TEST(Controls, all_have_a_group_and_a_sentence_and_a_name_of_their_own) {
  std::set<std::string> names;
  int numbers = 0, words = 0;
  for (const Control& c : controls()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_FALSE(c.group.empty()) << c.name;
    EXPECT_FALSE(c.sentence.empty()) << c.name;
    numbers += c.kind == Control::Kind::number;
    words += c.kind == Control::Kind::word;
    const bool inside = c.low <= c.initial && c.initial <= c.high;
    EXPECT_TRUE(inside || c.kind != Control::Kind::number) << c.name;
  }
  EXPECT_GT(numbers, 15);
  EXPECT_GT(words, 10);
}

TEST(Controls, a_number_is_read_back_as_it_was) {
  for (const double value : {0.1, 1e-300, 12345678.9, 1.0 / 3, 4.9e-324, 1e22, -0.0})
    EXPECT_EQ(std::strtod(parameter_text(value).c_str(), nullptr), value);
}

TEST(ParametersByName, mistakes_are_the_programs) {
  const auto said = [](const Parameters& p) -> std::string {
    try {
      (void)options_of(p);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(said({{"strenght", "1"}}), "unknown parameter 'strenght'; did you mean strength?");
  EXPECT_EQ(said({{"strength", ""}}), "--strength: '' is not a value: it is empty");
  EXPECT_NE(said({{"precision", "float"}, {"max_error", "1"}}), "");
  EXPECT_EQ(said({{"adaptation", "moon"}, {"ppd", "20"}}), "");
}

}  // namespace
}  // namespace scotopic
