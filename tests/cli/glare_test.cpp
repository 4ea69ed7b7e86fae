// Light around lamps, by the program: when it runs, when it says why not, and that threads make no
// difference.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/run_program.h"

namespace scotopic {
namespace {

class Glare : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = test::work_folder(); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  /// A dark ground of 0.1, and a lamp of `lamp` on one pixel in the middle.
  std::string scene(const std::string& name, float lamp) const {
    constexpr int width = 129, height = 97;
    std::vector<float> pixels(std::size_t{3} * width * height, 0.1f);
    for (std::size_t c = 0; c < 3; ++c) pixels[3 * (48 * width + 64) + c] = lamp;
    const auto out = OIIO::ImageOutput::create("x.exr");
    EXPECT_TRUE(out && out->open(path(name), OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT)) &&
                out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && out->close());
    return path(name);
  }

  test::Outcome apply(const std::string& in, const std::string& out, std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"apply", in, "-o", path(out), "--json", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_program(arguments);
  }

  nlohmann::json report(const test::Outcome& outcome) const {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }

  std::vector<float> pixels(const std::string& name) const {
    const auto in = OIIO::ImageInput::open(path(name));
    std::vector<float> out(std::size_t{3} * 129 * 97);
    EXPECT_TRUE(in && in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, out.data()));
    return out;
  }

  std::string folder_;
};

const std::vector<std::string> viewing = {"--adaptation", "0.1", "--ppd", "20"};

std::vector<std::string> with(std::vector<std::string> more) {
  more.insert(more.begin(), viewing.begin(), viewing.end());
  return more;
}

TEST_F(Glare, a_lamp_lights_what_is_around_it_and_less_farther_away) {
  const std::string in = scene("lamp.exr", 1e5f);
  const nlohmann::json said = report(apply(in, "on.exr", with({"--effects", "glare"})));
  EXPECT_TRUE(said.at("effects").at("glare").at("runs").get<bool>());
  const std::vector<float> out = pixels("on.exr");
  const auto at = [&](int x) { return out[3 * static_cast<std::size_t>(48 * 129 + x)]; };
  EXPECT_LT(at(64), 1e5f);
  for (int x = 65; x < 128; ++x) {
    EXPECT_GE(at(x), at(x + 1)) << x;
    EXPECT_GT(at(x), 0.1f) << x;
  }
  // K(10, 10) of the pixel-integrated CIE 135/1 function at 20 pixels a degree is 3.768e-5; the pyramid is
  // within 3 %.
  const float veil = out[3 * (58 * 129 + 74)] - 0.1f;
  EXPECT_NEAR(veil / 1e5f, 3.768e-5f, 0.03f * 3.768e-5f);
}

TEST_F(Glare, halo_is_a_ring_around_the_lamp_at_night_and_none_by_day) {
  const std::string in = scene("lamp.exr", 1e5f);
  const auto run = [&](const char* adaptation, const char* halo) {
    report(apply(in, "on.exr",
                 {"--adaptation", adaptation, "--ppd", "20", "--glare", "above:10", "--effects", "glare",
                  "--glare-halo", halo}));
    return pixels("on.exr");
  };
  const std::vector<float> none = run("0.1", "0"), half = run("0.1", "0.5"), ring = run("0.1", "1");
  const auto veil = [](const std::vector<float>& of, int x, std::size_t c) {
    return of[3 * static_cast<std::size_t>(48 * 129 + 64 + x) + c] - 0.1f;
  };
  // 2.9 degrees are 58 pixels: there the ring of 550 nm is an order above all else.
  EXPECT_GT(veil(ring, 58, 1), 8 * veil(none, 58, 1));
  EXPECT_NEAR(veil(half, 58, 1), (veil(none, 58, 1) + veil(ring, 58, 1)) / 2, 0.01f * veil(ring, 58, 1));
  EXPECT_GT(veil(ring, 49, 2), 2 * veil(ring, 49, 0));  // blue inside,
  EXPECT_GT(veil(ring, 63, 0), 2 * veil(ring, 63, 2));  // red outside
  EXPECT_EQ(run("100", "0"), run("100", "1"));
  EXPECT_EQ(apply(in, "a.exr", with({"--glare-halo", "1.5"})).exit_code, 2);
}

TEST_F(Glare, without_light_over_the_display_s_peak_nothing_changes) {
  const std::string in = scene("dim.exr", 0.5f);
  const nlohmann::json said = report(apply(in, "on.exr", with({"--effects", "glare"})));
  EXPECT_FALSE(said.at("effects").at("glare").at("needed").get<bool>());
  EXPECT_EQ(said.at("effects").at("glare").at("number"), 0);
  EXPECT_EQ(pixels("on.exr"), pixels("dim.exr"));
}

TEST_F(Glare, needs_pixels_per_degree_and_is_not_there_where_it_is_off) {
  const std::string in = scene("lamp.exr", 1e5f);
  EXPECT_EQ(apply(in, "a.exr", {"--adaptation", "0.1", "--effects", "glare"}).exit_code, 2);
  EXPECT_EQ(apply(in, "a.exr", {"--adaptation", "0.1", "--glare", "all"}).exit_code, 2);
  EXPECT_EQ(apply(in, "a.exr", with({"--glare", "below"})).exit_code, 2);
  EXPECT_EQ(apply(in, "a.exr", with({"--age", "200"})).exit_code, 2);
  report(apply(in, "off.exr", with({"--glare", "none", "--effects", "glare"})));
  EXPECT_EQ(pixels("off.exr"), pixels("lamp.exr"));
}

TEST_F(Glare, is_the_same_for_any_number_of_threads_with_all_that_follows) {
  const std::string in = scene("lamp.exr", 1e5f);
  report(apply(in, "1.exr", with({"--threads", "1"})));
  report(apply(in, "3.exr", with({"--threads", "3"})));
  EXPECT_EQ(pixels("1.exr"), pixels("3.exr"));
}

TEST_F(Glare, automatic_adaptation_meters_what_the_eye_has_scattered) {
  const std::string in = scene("lamp.exr", 1e4f);
  const auto adaptation = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"--adaptation", "auto", "--white-luminance", "1", "--ppd", "20"});
    return report(apply(in, "m.exr", more)).at("applied").at("scotopic:adaptation").get<double>();
  };
  // exp(mean log(Y + 1e-6 max)), of which the lamp is one pixel of 12513.
  EXPECT_NEAR(adaptation({"--glare", "none"}), 0.11, 0.003);
  EXPECT_GT(adaptation({}), 0.14);
}

TEST_F(Glare, more_memory_than_allowed_is_refused_before_it_is_taken) {
  const test::Outcome outcome =
      apply(scene("lamp.exr", 1e5f), "a.exr", with({"--effects", "glare", "--max-memory", "200000"}));
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
}

TEST_F(Glare, explain_tells_threshold_pixels_veil_and_whose_eye) {
  // PSF(3 degrees) of an eye of 75 over that of the default, CIE 135/1: 1.82.
  const test::Outcome outcome = test::run_program({"explain", scene("lamp.exr", 1e6f), "--adaptation", "0.1",
                                                   "--ppd", "20", "--age", "75", "--json", "-q"});
  const std::string reason = report(outcome)["effects"]["glare"]["reason"];
  for (const char* part : {"cd/m2 in the median pixel", "1 pixels are above", "scatters 1.82 times"})
    EXPECT_NE(reason.find(part), std::string::npos) << part << ": " << reason;
}

TEST_F(Glare, explain_advises_a_unit_where_the_picture_speaks_for_another) {
  const auto advice = [&](float lamp, const char* white) {
    return report(test::run_program({"explain", scene("lamp.exr", lamp), "--adaptation", "0.01",
                                     "--white-luminance", white, "--json", "-q"}))["advice"]
        .get<std::string>();
  };
  EXPECT_EQ(advice(1, "0.1"), "");
  EXPECT_NE(advice(1, "1").find("--white-luminance 0.1 would make them agree"), std::string::npos)
      << advice(1, "1");
}

}  // namespace
}  // namespace scotopic
