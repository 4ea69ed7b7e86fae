// One adaptation for a shot.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "cli/sequence/sequence.h"

namespace scotopic {
namespace {

class Shot : public test::Sequence {
 protected:
  std::vector<double> adaptations(int frames) const {
    std::vector<double> out;
    for (int f = 1; f <= frames; ++f)
      out.push_back(
          test::float_attribute(path("seen.000" + std::to_string(f) + ".exr"), "scotopic:adaptation"));
    return out;
  }
};

TEST_F(Shot, without_it_each_frame_is_adapted_to_itself_and_a_line_warns) {
  write_frames(4, 2);
  const test::Outcome outcome = apply({"--frames", "1-4"});
  ASSERT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("can flicker: --adaptation-from frames"), std::string::npos) << outcome.err;
  const std::vector<double> la = adaptations(4);
  for (std::size_t i = 1; i < la.size(); ++i) EXPECT_NEAR(la[i] / la[i - 1], 2, 0.01);
  EXPECT_EQ(apply({"--frames", "1-4", "--adaptation", "0.1"}).err.find("flicker"), std::string::npos);
}

TEST_F(Shot, the_median_of_its_frames_holds_for_all_of_them) {
  write_frames(5, 2);
  ASSERT_EQ(apply({"--frames", "1-5", "--adaptation", "auto:median"}).exit_code, 0);
  const std::vector<double> own = adaptations(5);
  const test::Outcome outcome =
      apply({"--frames", "1-5", "--adaptation-from", "frames", "--adaptation", "auto:median"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("flicker"), std::string::npos);
  for (const double la : adaptations(5)) EXPECT_EQ(la, own[2]);
  for (int f = 1; f <= 5; ++f)
    EXPECT_EQ(
        test::float_attribute(path("seen.000" + std::to_string(f) + ".exr"), "scotopic:sceneWhiteLuminance"),
        1);
  // Of an even number the middle two's geometric mean.
  ASSERT_EQ(
      apply({"--frames", "1-4", "--adaptation-from", "frames", "--adaptation", "auto:median"}).exit_code, 0);
  EXPECT_NEAR(adaptations(4)[0], std::sqrt(own[1] * own[2]), 1e-6 * own[1]);
}

TEST_F(Shot, a_part_of_it_takes_what_explain_found_and_gets_the_same_bytes) {
  write_frames(5, 1.7);
  ASSERT_EQ(apply({"--frames", "1-5", "--adaptation-from", "frames"}).exit_code, 0);
  std::vector<std::string> whole;
  for (int f = 1; f <= 5; ++f) whole.push_back(bytes("seen.000" + std::to_string(f) + ".exr"));
  const test::Outcome explained =
      run({"explain", "{}/in.####.exr", "--frames", "1-5", "--white-luminance", "1", "--json", "-q"});
  ASSERT_EQ(explained.exit_code, 0) << explained.err;
  write("shot.json", explained.out);
  ASSERT_EQ(apply({"--frames", "4,5", "--adaptation-from", path("shot.json")}).exit_code, 0);
  for (const std::size_t f : {4u, 5u})
    EXPECT_EQ(bytes("seen.000" + std::to_string(f) + ".exr"), whole[f - 1]);
  // It counts as the same command: nothing is left to do for the rest either.
  const nlohmann::json rest = applied({"--frames", "1-5", "--adaptation-from", "frames", "--skip-existing"});
  EXPECT_EQ(rest["skipped"], 5);
}

TEST_F(Shot, a_shot_that_changes_is_computed_anew) {
  write_frames(5, 1.7);
  EXPECT_EQ(applied({"--frames", "1-5", "--adaptation-from", "frames", "--skip-existing"})["written"], 5);
  EXPECT_EQ(applied({"--frames", "1-4", "--adaptation-from", "frames", "--skip-existing"})["written"],
            4);  // another median
}

TEST_F(Shot, what_cannot_be_is_told) {
  write_frames(2);
  write("text.json", "no json");
  write("other.json", "{\"shot\":{\"adaptation\":-1}}");
  const std::vector<std::pair<std::vector<std::string>, int>> rows = {
      {{"--adaptation-from", "frames", "--adaptation", "1"}, 2},
      {{"--adaptation-from", path("none.json")}, 3},
      {{"--adaptation-from", path("text.json")}, 3},
      {{"--adaptation-from", path("other.json")}, 3},
  };
  for (const auto& [more, code] : rows) {
    std::vector<std::string> arguments = {"--frames", "1-2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::Outcome outcome = apply(arguments);
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  // In image values alone there is no luminance to be adapted to.
  EXPECT_EQ(run({"apply", "{}/in.####.exr", "-o", "{}/seen.####.exr", "--frames", "1-2", "--adaptation-from",
                 "frames"})
                .exit_code,
            2);
  EXPECT_EQ(files("seen"), 0u);
}

TEST_F(Shot, broken_frames_do_not_count_where_one_goes_on) {
  write_frames(5, 2);
  write("in.0003.exr", "no image");
  EXPECT_EQ(apply({"--frames", "1-5", "--adaptation-from", "frames"}).exit_code, 3);
  EXPECT_EQ(files("seen"), 0u);
  const test::Outcome outcome =
      apply({"--frames", "1-5", "--adaptation-from", "frames", "--continue-on-error"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("median of 4 frames"), std::string::npos) << outcome.err;
  EXPECT_EQ(files("seen"), 4u);
}

}  // namespace
}  // namespace scotopic
