// Lists of frames and names with a number in them.
#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "io/frame_pattern.h"

namespace scotopic {
namespace {

TEST(FrameList, lists_mean_what_people_write) {
  using List = std::vector<int>;
  EXPECT_EQ(parse_frames("7"), List({7}));
  EXPECT_EQ(parse_frames("1-4"), List({1, 2, 3, 4}));
  EXPECT_EQ(parse_frames("1-9x4"), List({1, 5, 9}));
  EXPECT_EQ(parse_frames("1-8x4"), List({1, 5}));
  EXPECT_EQ(parse_frames("20,1-3"), List({20, 1, 2, 3}));
  EXPECT_EQ(parse_frames("1-10x3,1-4"), List({1, 4, 7, 10, 2, 3}));  // coarse first, each once
  EXPECT_EQ(parse_frames("-2-1"), List({-2, -1, 0, 1}));
  EXPECT_EQ(parse_frames("-7--5"), List({-7, -6, -5}));
  EXPECT_EQ(parse_frames("0001-0003"), List({1, 2, 3}));
  EXPECT_EQ(parse_frames("999999999"), List({999999999}));
}

TEST(FrameList, anything_else_is_a_usage_error_that_quotes_it) {
  for (const char* text :
       {"",       " ",    "a",     "1-",     "-",         "1-2-3",      "1,,2",
        ",1",     "1,",   "1-10x", "1-10x0", "1-10x-2",   "5-1",        "1.5",
        "1e3",    "1-3 ", " 1",    "0x10",   "1-9999999", "9999999999", "99999999999999999999",
        "1-10y2", "1x2",  "%d",    "1;2",    "+1"}) {
    try {
      (void)parse_frames(text);
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage) << text;
      EXPECT_NE(std::string(error.what()).find("'" + std::string(text) + "'"), std::string::npos)
          << error.what();
    }
  }
}

TEST(FrameList, a_text_of_frames_reads_back) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<int> frames;
    for (int f = -5; f < 60; ++f)
      if (random() % 3 != 0) frames.push_back(f);
    if (frames.empty()) continue;
    std::string text = frames_text(frames);
    std::erase(text, ' ');
    EXPECT_EQ(parse_frames(text), frames) << text;
  }
}

std::string path(const std::string& pattern, int frame) {
  return FramePattern(pattern, "the input").path(frame);
}

TEST(FrameNames, numbers_stand_where_the_pattern_says) {
  EXPECT_EQ(path("in.%04d.exr", 7), "in.0007.exr");
  EXPECT_EQ(path("in.%d.exr", 7), "in.7.exr");
  EXPECT_EQ(path("in.####.exr", 7), "in.0007.exr");
  EXPECT_EQ(path("in.#.exr", 12), "in.12.exr");
  EXPECT_EQ(path("in.@@@.exr", 7), "in.007.exr");
  EXPECT_EQ(path("in.##.exr", 1234), "in.1234.exr");
  EXPECT_EQ(path("in.%04d.exr", -7), "in.-007.exr");                     // as printf has it
  EXPECT_EQ(path("shot#/a%d@/in.%02d.exr", 3), "shot#/a%d@/in.03.exr");  // folders are left alone
  EXPECT_EQ(path("####_####.exr", 5), "0005_0005.exr");
  EXPECT_EQ(path("%03d_%d.exr", 5), "005_5.exr");
}

TEST(FrameNames, of_several_kinds_of_place_one_is_the_frames) {
  EXPECT_EQ(path("night.####_%d.exr", 12), "night.0012_%d.exr");  // %d is the wavelength's
  EXPECT_EQ(path("me@home.%04d.exr", 12), "me@home.0012.exr");
  EXPECT_EQ(path("me@home.####.exr", 12), "me@home.0012.exr");
}

TEST(FrameNames, no_name_is_ever_a_format) {
  EXPECT_EQ(path("%s%n%p%x.####.exr", 1), "%s%n%p%x.0001.exr");
  EXPECT_EQ(path("{}{:d}%%.####.exr", 1), "{}{:d}%%.0001.exr");
  EXPECT_EQ(path("%s.%04d.exr", 1), "%s.0001.exr");
  EXPECT_EQ(path("50%.%d.exr", 1), "50%.1.exr");
  EXPECT_EQ(path("$(touch x)\n'\".##.exr", 1), "$(touch x)\n'\".01.exr");
  EXPECT_EQ(path("\xff\xfe.##.exr", 1), "\xff\xfe.01.exr");
}

TEST(FrameNames, a_name_without_a_place_is_a_usage_error) {
  for (const char* name :
       {"in.exr", "in.%s.exr", "in.%4d.exr", "in.%-4d.exr", "in.%00d.exr", "in.%012d.exr", "in.%i.exr",
        "in.%", "in.%04", "in.%%", "####/in.exr", "%04d/in.exr", "", "in.$F4.exr", "in.%ld.exr"}) {
    EXPECT_FALSE(FramePattern::in(name)) << name;
    EXPECT_THROW(FramePattern(name, "the input"), Error) << name;
  }
}

}  // namespace
}  // namespace scotopic
