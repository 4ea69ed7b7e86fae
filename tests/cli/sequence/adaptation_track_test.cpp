// A track of adaptation luminances, and the eye that follows it.
#include "cli/sequence/adaptation_track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace scotopic {
namespace {

TEST(AdaptationKeys, are_read_from_csv_and_json) {
  const std::vector<AdaptationKey> expected = {{1, 1000}, {25, 0.5}, {240, 0.01}};
  for (
      const char* text :
      {"1,1000\n25,0.5\n240,0.01\n", "frame,cd/m2\r\n1, 1000\r\n# the door\r\n25, .5\r\n240,1e-2",
       R"([{"frame": 1, "adaptation": 1000}, {"frame": 25, "adaptation": 0.5}, {"frame": 240, "adaptation": 0.01}])",
       R"({"keys": [{"frame": 1, "adaptation": 1000}, {"frame": 25, "adaptation": 0.5}, {"frame": 240, "adaptation": 0.01}]})",
       R"({"shot": {"adaptation": 3}, "frames": [{"frame": 1, "adaptation": 1000, "input": "a"},
               {"frame": 25, "adaptation": 0.5}, {"frame": 240, "adaptation": 0.01}]})"})
    EXPECT_EQ(parse_adaptation_keys(text, "k"), expected) << text;
}

TEST(AdaptationKeys, that_are_not_understood_are_refused_by_place) {
  const struct {
    const char* text;
    const char* says;
  } rows[] = {{"", "holds no adaptation"},
              {"1,5\n1;5\n", "line 2: is not"},
              {"1,5\n2\n", "line 2: is not"},
              {"1,5\n1,6\n", "line 2: frames have to ascend"},
              {"1,5\n2,0\n", "line 2: a luminance is from"},
              {"1.5,5\n", "line 1: a frame is a whole number"},
              {"{}", "has no list"},
              {R"([{"frame": 1}])", "entry 1: has no number \"adaptation\""}};
  for (const auto& row : rows) try {
      (void)parse_adaptation_keys(row.text, "k");
      ADD_FAILURE() << row.text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input);
      EXPECT_NE(std::string(error.what()).find(row.says), std::string::npos)
          << row.text << ": " << error.what();
    }
}

TEST(AdaptationTrack, is_linear_in_the_logarithm_between_keys_and_held_outside) {
  const AdaptationTrack track({{10, 100}, {20, 1}}, {}, 24, 30, "t");
  EXPECT_EQ(track.luminance(0), 100);
  EXPECT_EQ(track.luminance(10), 100);
  EXPECT_NEAR(track.luminance(15), 10, 1e-12);
  EXPECT_EQ(track.luminance(20), 1);
  EXPECT_EQ(track.luminance(99), 1);
}

TEST(AdaptationTrack, holds_an_adapted_eye_where_light_is_constant) {
  const AdaptationTrack track({{1, 0.01}}, {}, 24, 240, "t");
  EXPECT_EQ(track.state(1), adapted_state(0.01));
  EXPECT_EQ(track.state(240), adapted_state(0.01));
  EXPECT_EQ(thresholds_of(track.state(240), 0.01).exposure, 1);
}

TEST(AdaptationTrack, follows_a_garage_into_the_moon_and_any_part_of_it_has_the_same_bits) {
  const std::vector<AdaptationPeriod> garage = {{1000, 600}};
  const AdaptationTrack whole({{0, 0.01}}, garage, 1, 600, "t");
  // docs/effects.md: after 10 minutes at 1000 cd/m2, a scene of 0.01 at 1, 10, 60, 300, 600 s.
  const struct {
    int second;
    double exposure;
  } rows[] = {{1, 0.52149}, {10, 0.60667}, {60, 0.79388}, {300, 0.83716}, {600, 0.97892}};
  for (const auto& row : rows)
    EXPECT_NEAR(thresholds_of(whole.state(row.second), 0.01).exposure, row.exposure, 1e-4) << row.second;
  for (const int last : {1, 60, 299, 300}) {
    const AdaptationTrack part({{0, 0.01}}, garage, 1, last, "t");
    EXPECT_EQ(part.state(last), whole.state(last)) << last;
  }
}

TEST(AdaptationTrack, is_what_it_is_made_of) {
  const AdaptationTrack a({{0, 1}, {5, 2}}, {}, 24, 5, "t");
  EXPECT_EQ(a.identity(), AdaptationTrack({{0, 1}, {5, 2}}, {}, 24, 9, "elsewhere").identity());
  for (const AdaptationTrack& other :
       {AdaptationTrack({{0, 1}, {5, 2.5}}, {}, 24, 5, "t"),
        AdaptationTrack({{0, 1}, {6, 2}}, {}, 24, 5, "t"), AdaptationTrack({{0, 1}, {5, 2}}, {}, 25, 5, "t"),
        AdaptationTrack({{0, 1}, {5, 2}}, std::vector<AdaptationPeriod>{{1000, 1}}, 24, 5, "t")})
    EXPECT_NE(a.identity(), other.identity());
}

}  // namespace
}  // namespace scotopic
