// scripts/plot on what the program prints: gnuplot reads the columns by number.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/run_program.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

std::string drawn(const std::string& script, const std::string& csv, const std::string& more = "") {
  const fs::path folder = fs::temp_directory_path() / ("scotopic_plot_" + script);
  fs::create_directories(folder);
  std::ofstream(folder / "in.csv") << csv;
  const std::string command = "gnuplot -c " SCOTOPIC_SOURCE_DIR "/scripts/plot/" + script + ".gnuplot " +
                              (folder / "in.csv").string() + " " + (folder / "out.svg").string() + " " + more;
  EXPECT_EQ(std::system((command + " 2>" + (folder / "warnings").string()).c_str()), 0) << command;
  std::ostringstream warnings, svg;
  warnings << std::ifstream(folder / "warnings").rdbuf();
  svg << std::ifstream(folder / "out.svg").rdbuf();
  EXPECT_EQ(warnings.str(), "");
  fs::remove_all(folder);
  return svg.str();
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::size_t bars(const std::string& svg) { return count(svg, "<polygon"); }

TEST(Plot, time_shows_every_lut_by_name) {
  const test::Outcome time = test::run_program({"time", "--pixels", "65536", "--rounds", "1", "--csv"});
  ASSERT_EQ(time.exit_code, 0) << time.err;
  const std::string svg = drawn("accuracy", time.out, "'a machine'");
  for (const char* name : {"lut129", "lut65", "lut33", "lut17", "float", "a machine"})
    EXPECT_NE(svg.find(name), std::string::npos) << name;
}

TEST(Plot, a_scene_has_a_bar_for_every_octave_and_a_line_where_the_eye_is) {
  const std::string picture = test::work_folder() + "/light.exr";
  test::write_picture(picture, 48, 40);
  const test::Outcome light = test::run_program({"explain", picture, "--adaptation", "0.1", "--csv", "-q"});
  ASSERT_EQ(light.exit_code, 0) << light.err;
  EXPECT_EQ(light.out.rfind("from_cdm2,to_cdm2,share\n", 0), 0u) << light.out;
  const std::string without = drawn("luminance", "from_cdm2,to_cdm2,share\n-inf,0,0.2\n0.5,1,0.8\n");
  const std::string svg = drawn("luminance", light.out, "0.1");
  EXPECT_NE(svg.find("adapted to 0.1"), std::string::npos);
  EXPECT_GT(bars(svg), bars(without));
}

TEST(Plot, a_shot_has_a_point_for_each_frame_and_a_line_at_each_change) {
  const std::string shot =
      "frame,adaptation_cdm2,sp_ratio,effects\n1,0.1,1.2,shift\n2,0.2,1.2,shift\n3,1,1.2,shift chroma\n";
  const std::string svg = drawn("adaptation", shot);
  // A title's own, and one of data.
  EXPECT_EQ(count(svg, "<use xlink:href='#gpPt6'"), 3u + 1) << svg;
  EXPECT_NE(svg.find("the plan changes"), std::string::npos);
}

}  // namespace
}  // namespace scotopic
