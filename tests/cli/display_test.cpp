// What a display is sent, by the program: through files, filters and options.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/run_program.h"

namespace scotopic {
namespace {

std::string bytes_of(const std::string& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

class DisplayOutput : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::work_folder();
    test::write_picture(path("in.exr"), 300, 200);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  nlohmann::json applied(const std::string& out, std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"apply",        path("in.exr"), "-o",     path(out),
                                          "--adaptation", "0.1",          "--json", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::Outcome outcome = test::run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }

  std::string folder_;
};

TEST_F(DisplayOutput, is_the_same_for_any_number_of_threads_after_acuity_too) {
  for (const char* threads : {"1", "3"})
    applied(std::string(threads) + ".png",
            {"--display", "Un-tone-mapped", "--acuity", "--ppd", "20", "--threads", threads});
  EXPECT_EQ(bytes_of(path("1.png")), bytes_of(path("3.png")));
}

TEST_F(DisplayOutput, a_range_that_is_told_does_what_the_measured_one_did) {
  const nlohmann::json measured = applied("a.exr", {"--tone", "local"}).at("display");
  std::ostringstream range;
  range.precision(17);
  range << measured.at("low").get<double>() << ',' << measured.at("high").get<double>();
  applied("b.exr", {"--tone", "local", "--display-range", range.str()});
  EXPECT_EQ(bytes_of(path("a.exr")), bytes_of(path("b.exr")));
  EXPECT_GT(measured.at("high").get<double>(), measured.at("low").get<double>());
}

TEST_F(DisplayOutput, its_unit_is_stated_where_it_is_light_and_not_where_it_is_a_code) {
  EXPECT_EQ(applied("light.exr", {"--tone", "local"}).at("applied").at("whiteLuminance"), 100.0);
  EXPECT_FALSE(applied("code.exr", {"--display", "Un-tone-mapped"}).at("applied").contains("whiteLuminance"));
}

TEST_F(DisplayOutput, safko_s_scale_is_used_and_stated) {
  EXPECT_EQ(applied("a.exr", {"--model", "safko2019", "--safko-scale", "20"})
                .at("applied")
                .at("scotopic:safkoScale"),
            20.0);
  applied("b.exr", {"--model", "safko2019"});
  EXPECT_NE(bytes_of(path("a.exr")), bytes_of(path("b.exr")));
}

}  // namespace
}  // namespace scotopic
