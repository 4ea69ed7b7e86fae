// What a display is sent, by the program: through files, filters and options.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "cli/run_program.h"
#include "support/file_bytes.h"

namespace scotopic {
namespace {

using test::bytes_of;

std::vector<std::uint8_t> pixels_of(const std::string& file) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in) return {};
  std::vector<std::uint8_t> out(static_cast<std::size_t>(in->spec().width) *
                                static_cast<std::size_t>(in->spec().height) * 3);
  if (!in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, out.data())) out.clear();
  return out;
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

TEST_F(DisplayOutput, a_picture_that_is_looked_at_is_a_night_and_light_stays_light) {
  const nlohmann::json png = applied("a.png", {});
  EXPECT_NEAR(png.at("display").at("stops").get<double>(), -2.374, 1e-3);
  EXPECT_EQ(png.at("display").at("space"), "sRGB - Texture");
  EXPECT_FALSE(applied("a.exr", {}).contains("display"));
  EXPECT_FALSE(applied("none.png", {"--display", "none"}).contains("display"));
  EXPECT_FALSE(applied("b.png", {"--output-colorspace", "sRGB - Display"}).contains("display"));
  EXPECT_NE(bytes_of(path("a.png")), bytes_of(path("none.png")));
  EXPECT_EQ(applied("p3.png", {"--display", "night:Display P3 - Display"}).at("display").at("space"),
            "Display P3 - Display");
}

TEST_F(DisplayOutput, a_picture_seen_by_day_comes_back_with_its_bits) {
  applied("a.png", {"-d", "uint8"});
  const test::Outcome again =
      test::run_program({"apply", path("a.png"), "-o", path("again.png"), "--adaptation", "100", "-q"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  ASSERT_FALSE(pixels_of(path("a.png")).empty());
  EXPECT_EQ(pixels_of(path("a.png")), pixels_of(path("again.png")));
}

TEST_F(DisplayOutput, detail_needs_pixels_per_degree_assumes_them_on_a_display_and_says_so) {
  const auto run = [&](const char* out, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"apply",   path("in.exr"), "-o",
                                          path(out), "--adaptation", "starlight"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_program(arguments);
  };
  EXPECT_EQ(run("a.exr", {"--acuity"}).exit_code, 2);
  EXPECT_EQ(run("a.exr", {"--effects", "acuity"}).exit_code, 2);
  EXPECT_NE(run("a.png", {"--acuity"}).err.find("assumed: the picture is 40 degrees wide"),
            std::string::npos);
  // Nyquist of 300 pixels over 360 degrees.
  EXPECT_NEAR(applied("b.png", {"--projection", "latlong", "--detail", "bilateral"})
                  .at("effects")
                  .at("detail")
                  .at("number")
                  .get<double>(),
              150.0 / 360, 1e-9);
  EXPECT_EQ(run("c.exr", {}).exit_code, 0);
}

TEST_F(DisplayOutput, a_night_view_of_the_shipped_config_is_known_anywhere_and_looks_as_the_display_stage) {
  applied("view.png", {"--display", "Night 0.1 nit (street lighting)", "--effects", "none", "-d", "uint8"});
  applied("stage.png", {"--effects", "shift,luminance,chroma", "-d", "uint8"});
  const std::vector<std::uint8_t> view = pixels_of(path("view.png")), stage = pixels_of(path("stage.png"));
  ASSERT_EQ(view.size(), stage.size());
  ASSERT_FALSE(view.empty());
  int worst = 0;
  for (std::size_t i = 0; i < view.size(); ++i)
    worst = std::max(worst, std::abs(int{view[i]} - int{stage[i]}));
  EXPECT_LE(worst, 3) << "codes of 255";
}

TEST_F(DisplayOutput, safko_s_scale_is_used_and_stated) {
  EXPECT_EQ(applied("a.exr", {"--model", "safko2019", "--safko-scale", "20"})
                .at("applied")
                .at("scotopic:safkoScale"),
            20.0);
  applied("b.exr", {"--model", "safko2019"});
  EXPECT_NE(bytes_of(path("a.exr")), bytes_of(path("b.exr")));
}

TEST_F(DisplayOutput, the_share_of_clipped_pixels_is_told) {
  const auto run = [&](const char* out, const char* display, const char* exposure) {
    return test::run_program({"apply", path("in.exr"), "-o", path(out), "--adaptation", "100", "--display",
                              display, "--exposure", exposure, "--json"});
  };
  const test::Outcome burnt = run("burnt.png", "none", "30");
  EXPECT_NE(burnt.err.find("are clipped to what the output's type holds"), std::string::npos) << burnt.err;
  EXPECT_GT(nlohmann::json::parse(burnt.out)["clipped"].get<double>(), 0.5);
  EXPECT_EQ(nlohmann::json::parse(run("burnt.exr", "none", "30").out)["clipped"], 0.0);
  EXPECT_EQ(run("dark.png", "none", "-30").err.find("clipped"), std::string::npos);
}

}  // namespace
}  // namespace scotopic
