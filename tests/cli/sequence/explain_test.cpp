// explain on a sequence.
#include <algorithm>
#include <cmath>

#include "cli/sequence/sequence.h"

namespace scotopic {
namespace {

class ExplainFrames : public test::Sequence {
 protected:
  test::Outcome explain(std::vector<std::string> more) const {
    more.insert(more.begin(), {"explain", "{}/in.####.exr", "--frames", "1-8", "--white-luminance", "4"});
    return run(more);
  }
};

TEST_F(ExplainFrames, says_each_frames_light_the_shots_and_where_what_is_called_for_changes) {
  write_frames(8, 1.6);  // dusk to day: from some frame on nothing is called for
  const test::Outcome outcome = explain({"--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(report["frames"].size(), 8u);
  std::vector<double> la;
  for (const nlohmann::json& f : report["frames"]) la.push_back(f["adaptation"]);
  for (std::size_t i = 1; i < 8; ++i) EXPECT_NEAR(la[i] / la[i - 1], 1.6, 0.02);
  EXPECT_NEAR(report["shot"]["adaptation"].get<double>(), std::sqrt(la[3] * la[4]), 1e-9);
  EXPECT_EQ(report["shot"]["least"], la.front());
  EXPECT_EQ(report["shot"]["greatest"], la.back());
  // Where the adaptation passes 5 cd/m2.
  const auto photopic = static_cast<std::size_t>(
      std::find_if(la.begin(), la.end(), [](double a) { return a >= 5; }) - la.begin());
  ASSERT_GT(photopic, 0u);
  ASSERT_LT(photopic, 8u);
  EXPECT_TRUE(report["frames"][photopic]["effects"].empty());
  EXPECT_FALSE(report["frames"][photopic - 1]["effects"].empty());
  EXPECT_EQ(report["changes"].back()["frame"], photopic + 1);
  EXPECT_FALSE(report["changes"].back()["ends"].empty());
}

TEST_F(ExplainFrames, prints_a_table_with_bars_that_grow_with_the_light) {
  write_frames(8, 1.6);
  const std::string text = explain({}).out;
  std::vector<std::ptrdiff_t> bars;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    if (const auto bar = std::count(line.begin(), line.end(), '#'); bar > 0) bars.push_back(bar);
    at = end + 1;
  }
  ASSERT_EQ(bars.size(), 8u) << text;
  EXPECT_TRUE(std::is_sorted(bars.begin(), bars.end())) << text;
  EXPECT_EQ(bars.front(), 1);
  EXPECT_EQ(bars.back(), 30);
  EXPECT_NE(text.find("from frame "), std::string::npos) << text;
  EXPECT_NE(text.find("the shot, as --adaptation-from frames takes it"), std::string::npos);
}

TEST_F(ExplainFrames, csv_has_a_row_for_each_frame) {
  write_frames(8, 1.6);
  const test::Outcome outcome = explain({"--csv", "-q"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "frame,adaptation_cdm2,sp_ratio,effects");
  double before = 0;
  int frames = 0;
  for (; std::getline(lines, line); ++frames) {
    int frame = 0;
    double adaptation = 0, sp_ratio = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%d,%lf,%lf,", &frame, &adaptation, &sp_ratio), 3) << line;
    EXPECT_EQ(frame, frames + 1);
    EXPECT_GT(adaptation, before);
    before = adaptation;
  }
  EXPECT_EQ(frames, 8);
}

TEST_F(ExplainFrames, a_constant_shot_changes_nowhere) {
  write_frames(8);
  EXPECT_NE(explain({"-q"}).out.find("all frames call for the same\n"), std::string::npos);
}

TEST_F(ExplainFrames, a_missing_frame_is_named_and_can_be_passed_over) {
  write_frames(7);
  const test::Outcome outcome = explain({});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("missing is frame 8"), std::string::npos) << outcome.err;
  const test::Outcome more = explain({"--continue-on-error", "--json"});
  EXPECT_EQ(more.exit_code, 3);
  EXPECT_EQ(nlohmann::json::parse(more.out)["frames"].size(), 7u);
}

}  // namespace
}  // namespace scotopic
