// The plan as a user meets it: what is skipped changes nothing, and is said.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "stages/shared/colour_difference.h"
#include "cli/run_program.h"
#include "receptors/rods.h"
#include "support/primaries.h"

namespace scotopic {
namespace {

class Plan : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::work_folder();
    test::write_picture(path("in.exr"), 96, 80);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  // Half values of R, G, B, one plane after another.
  std::vector<std::uint16_t> pixels(const std::string& name) const {
    Imf::InputFile file(path(name).c_str());
    const Imath::Box2i window = file.header().dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
    std::vector<std::uint16_t> values(3 * width * height);
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < 3; ++c)
      buffer.insert(
          std::string(1, "RGB"[c]),
          Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data() + c * width * height), 2, 2 * width));
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    return values;
  }
  test::Outcome apply(const std::string& out, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"apply", path("in.exr"), "-o", path(out)});
    const test::Outcome outcome = test::run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
  }

  std::string folder_;
};

TEST_F(Plan, a_scene_that_calls_for_nothing_keeps_every_bit_and_says_so) {
  for (const char* adaptation : {"5", "5.001", "1000"}) {
    const test::Outcome outcome = apply("out.exr", {"--adaptation", adaptation});
    EXPECT_NE(outcome.err.find("nothing to do; skipped shift (the eye is adapted to"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(pixels("out.exr"), pixels("in.exr")) << adaptation;
  }
  EXPECT_EQ(apply("quiet.exr", {"--adaptation", "5", "-q"}).err, "");
}

TEST_F(Plan, what_is_left_out_because_no_angle_is_known_is_said) {
  const std::string why = " (pixels per degree are not known (--ppd, --fov))";
  for (const char* effects : {"auto", "all"})
    EXPECT_NE(apply("out.exr", {"--adaptation", "0.1", "--effects", effects})
                  .err.find("; left out glare, detail" + why),
              std::string::npos);
  EXPECT_NE(apply("out.exr", {"--adaptation", "0.1", "--detail", "none"}).err.find("; left out glare" + why),
            std::string::npos);
  for (const std::vector<std::string>& option : {std::vector<std::string>{"--ppd", "30"},
                                                 {"--effects", "shift"},
                                                 {"--glare", "none", "--detail", "none"}}) {
    std::vector<std::string> arguments = {"--adaptation", "0.1"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    EXPECT_EQ(apply("out.exr", arguments).err.find("left out"), std::string::npos) << option[0];
  }
}

TEST_F(Plan, skipping_and_not_skipping_give_the_same_bits_around_the_limit) {
  for (const char* adaptation : {"4.999", "5", "5.001", "0.5"})
    for (const char* threads : {"1", "3"}) {
      apply("auto.exr", {"--adaptation", adaptation, "--effects", "auto", "-q", "--threads", threads});
      apply("all.exr", {"--adaptation", adaptation, "--effects", "all", "-q", "--threads", threads});
      EXPECT_EQ(pixels("auto.exr"), pixels("all.exr")) << adaptation;
    }
}

TEST_F(Plan, effects_that_are_not_listed_do_not_run) {
  apply("none.exr", {"--adaptation", "0.01", "--effects", "none", "-q"});
  EXPECT_EQ(pixels("none.exr"), pixels("in.exr"));
  const test::Outcome outcome = apply("chroma.exr", {"--adaptation", "0.01", "--effects", "chroma"});
  EXPECT_NE(outcome.err.find(": chroma\n"), std::string::npos) << outcome.err;
  EXPECT_NE(pixels("chroma.exr"), pixels("in.exr"));
}

TEST_F(Plan, acuity_takes_its_word_with_or_without_an_equals_sign_or_none_before_a_file_name) {
  const std::vector<std::string> rest = {"-o", path("out.exr"), "--adaptation", "0.01", "--ppd", "60"};
  const auto seen = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "apply");
    arguments.insert(arguments.end(), rest.begin(), rest.end());
    const test::Outcome outcome = test::run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(seen({path("in.exr"), "--acuity", "local"}).find("sigma up to"), std::string::npos);
  EXPECT_NE(seen({path("in.exr"), "--acuity=local"}).find("sigma up to"), std::string::npos);
  const std::string global = seen({"--acuity", path("in.exr")});
  EXPECT_NE(global.find("detail: "), std::string::npos) << global;
  EXPECT_EQ(global.find("sigma up to"), std::string::npos) << global;
}

TEST_F(Plan, acuity_runs_only_where_the_picture_holds_more_than_the_eye_resolves) {
  // At .01 cd/m2 the eye resolves 5.31 cycles a degree.
  apply("plain.exr", {"--adaptation", "0.01", "-q"});
  const test::Outcome coarse =
      apply("coarse.exr", {"--adaptation", "0.01", "--ppd", "10.6", "--detail", "bilateral"});
  EXPECT_NE(coarse.err.find("detail (the picture holds"), std::string::npos) << coarse.err;
  EXPECT_EQ(pixels("coarse.exr"), pixels("plain.exr"));
  const test::Outcome fine =
      apply("fine.exr", {"--adaptation", "0.01", "--ppd", "60", "--detail", "bilateral"});
  EXPECT_EQ(fine.err.find("detail ("), std::string::npos) << fine.err;
  EXPECT_NE(pixels("fine.exr"), pixels("plain.exr"));
}

// A picture whose every pixel has an S/P ratio further from white's by `deviation` (Rec.709, linear rods).
void write_tinted(const std::string& file, double deviation) {
  // S/P over white's of (1, 1, 1 + t) is 1 + slope t for small t.
  const Vec3<double> white = test::rec709 * Vec3<double>{1, 1, 1},
                     tinted = test::rec709 * Vec3<double>{1, 1, 1.001};
  const auto ratio = [](const Vec3<double>& xyz) { return dot(scotopic_linear_from_xyz, xyz) / xyz[1]; };
  const double slope = (ratio(tinted) / ratio(white) - 1) / 0.001;
  const auto blue = static_cast<float>(1 + deviation / slope);
  constexpr int width = 64, height = 32;
  std::vector<float> planes(3 * width * height);
  for (int i = 0; i < width * height; ++i) {
    const float level = 0.001f * static_cast<float>(1 + i);
    for (int c = 0; c < 3; ++c)
      planes[static_cast<std::size_t>(c * width * height + i)] = c == 2 ? level * blue : level;
  }
  Imf::Header header(width, height);
  Imf::FrameBuffer frame;
  for (int c = 0; c < 3; ++c) {
    const std::string name(1, "RGB"[c]);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes.data() + c * width * height), 4,
                                  4 * width));
  }
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(frame);
  out.writePixels(height);
}

std::vector<float> float_pixels(const std::string& name) {
  Imf::InputFile file(name.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x + 1),
             height = static_cast<std::size_t>(window.max.y + 1);
  std::vector<float> values(3 * width * height);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < 3; ++c)
    buffer.insert(
        std::string(1, "RGB"[c]),
        Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data() + c * width * height), 4, 4 * width));
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return values;
}

double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = 0;
  const std::size_t n = a.size() / 3;
  for (std::size_t i = 0; i < n; ++i)
    largest =
        std::max(largest, exposed_difference(test::rec709 * Vec3<double>{a[i], a[n + i], a[2 * n + i]},
                                             test::rec709 * Vec3<double>{b[i], b[n + i], b[2 * n + i]}));
  return largest;
}

TEST_F(Plan, mesopic_luminance_is_skipped_up_to_the_tolerance_and_that_cannot_be_seen) {
  double worst = 0;
  for (const double deviation : {-0.0021, -0.0019, 0.0, 0.0019, 0.0021})
    for (const char* adaptation : {"auto", "auto:median"}) {
      write_tinted(path("in.exr"), deviation);
      const test::Outcome planned =
          apply("auto.exr", {"--adaptation", adaptation, "--white-luminance", "0.01"});
      apply("all.exr", {"--adaptation", adaptation, "--white-luminance", "0.01", "--effects", "all", "-q"});
      const bool skipped = planned.err.find("skipped luminance") != std::string::npos;
      EXPECT_EQ(skipped, std::abs(deviation) < 0.002) << deviation << planned.err;
      const std::vector<float> a = float_pixels(path("auto.exr")), b = float_pixels(path("all.exr"));
      EXPECT_TRUE(skipped || a == b) << deviation;
      worst = std::max(worst, largest_difference(a, b));
    }
  std::printf("skipped luminance: largest dE00 %.3g\n", worst);
  EXPECT_LE(worst, 0.05);
  EXPECT_GT(worst, 0);
}

TEST_F(Plan, acuity_turns_on_where_the_picture_s_finest_detail_meets_what_the_eye_resolves) {
  // At .01 cd/m2, 5.3137 cycles a degree, by the very number that explain prints.
  const test::Outcome explained = test::run_program(
      {"explain", path("in.exr"), "--adaptation", "0.01", "--ppd", "20", "--detail", "bilateral", "--json"});
  const double limit = nlohmann::json::parse(explained.out)["effects"]["detail"]["threshold"].get<double>();
  apply("plain.exr", {"--adaptation", "0.01", "-q"});
  for (const double share : {0.999, 1.001}) {
    const std::string ppd = std::to_string(2 * limit * share);
    const test::Outcome outcome =
        apply("seen.exr", {"--adaptation", "0.01", "--ppd", ppd, "--detail", "bilateral"});
    EXPECT_EQ(outcome.err.find("detail (the picture holds") != std::string::npos, share < 1) << outcome.err;
    EXPECT_EQ(pixels("seen.exr") == pixels("plain.exr"), share < 1) << share;
  }
}

TEST_F(Plan, adaptation_is_metered_the_way_it_is_asked_for) {
  const auto adaptation = [&](const char* method) {
    const test::Outcome outcome =
        apply("out.exr", {"--adaptation", method, "--white-luminance", "1", "--json", "-q"});
    return nlohmann::json::parse(outcome.out)["applied"]["scotopic:adaptation"].get<double>();
  };
  const double p10 = adaptation("auto:p10"), median = adaptation("auto:median"), p90 = adaptation("auto:p90");
  EXPECT_LT(p10, median);
  EXPECT_LT(median, p90);
  EXPECT_EQ(median, adaptation("auto:p50"));
  EXPECT_GT(adaptation("auto"), p10);
  EXPECT_LT(adaptation("auto"), p90);
  EXPECT_EQ(adaptation("auto:0,0,96,80"), adaptation("auto"));
  EXPECT_NE(adaptation("auto:0,0,10,10"), adaptation("auto"));
}

TEST_F(Plan, explain_tells_every_effect_with_number_threshold_and_reason) {
  const test::Outcome outcome =
      test::run_program({"explain", path("in.exr"), "--adaptation", "0.01", "--ppd", "60", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  for (const char* effect : {"shift", "luminance", "chroma", "detail"}) {
    const nlohmann::json& e = report["effects"][effect];
    EXPECT_TRUE(e["runs"].get<bool>()) << effect;
    EXPECT_FALSE(e["reason"].get<std::string>().empty());
    EXPECT_GT(e["threshold"].get<double>(), 0);
  }
  for (const char* effect : {"noise", "time"}) EXPECT_FALSE(report["effects"][effect]["asked"].get<bool>());
  EXPECT_GT(report["effects"]["shift"]["largestDifference"].get<double>(), 0.5);
  double share = report["darkShare"].get<double>();
  for (const nlohmann::json& bar : report["histogram"]) share += bar["share"].get<double>();
  EXPECT_NEAR(share, 1, 1e-9);
}

TEST(ExplainConfig, tells_which_looks_do_what) {
  const test::Outcome outcome =
      test::run_program({"explain", SCOTOPIC_SOURCE_DIR "/ocio_config/config.ocio", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::map<std::string, std::string> does;
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  for (const nlohmann::json& look : report["looks"]) does[look["name"]] = look["does"];
  EXPECT_EQ(does["Photopic"], "nothing");
  EXPECT_EQ(does["Chroma 0.01 nit (global weight matrix)"], "a matrix");
  EXPECT_NE(does["Mesopic 0.01 nit (full moon)"].find("a 3D LUT of 33 nodes a side"), std::string::npos);
  EXPECT_EQ(does["Photopic 10 nit (lamplit room)"].rfind("nothing", 0), 0u)
      << does["Photopic 10 nit (lamplit room)"];
}

}  // namespace
}  // namespace scotopic
