// The calibrated night of docs/scene.md: luminances as written, and what the program makes of it is night.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/run_program.h"

namespace scotopic {
namespace {

const std::string street = SCOTOPIC_SOURCE_DIR "/tests/data/street.exr";

struct Picture {
  int width = 0, height = 0;
  std::vector<float> pixels;

  explicit Picture(const std::string& file) {
    const auto in = OIIO::ImageInput::open(file);
    EXPECT_TRUE(in) << file;
    if (!in) return;
    width = in->spec().width;
    height = in->spec().height;
    pixels.resize(std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    EXPECT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data()));
  }
  float at(int x, int y, std::size_t c) const {
    return pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x)) +
                  c];
  }
  double luminance(int x, int y) const {
    return 0.2126 * double{at(x, y, 0)} + 0.7152 * double{at(x, y, 1)} + 0.0722 * double{at(x, y, 2)};
  }
};

struct Region {
  const char* name;
  int x0, y0, x1, y1;
  double low, high;  // of the median, cd/m2
};

template <typename Value>
double median(const Region& r, Value value) {
  std::vector<double> all;
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x) all.push_back(value(x, y));
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

constexpr Region ground = {"pavement", 1000, 640, 1270, 715, 0.02, 0.05};

TEST(Street, has_the_luminances_that_are_written_of_it) {
  const Picture picture(street);
  ASSERT_EQ(picture.width, 1280);
  ASSERT_EQ(picture.height, 720);
  for (const Region& r :
       {ground, Region{"lawn", 1000, 525, 1270, 565, 0.01, 0.03},
        Region{"sky", 1000, 40, 1270, 200, 0.005, 0.015}, Region{"window", 68, 165, 100, 190, 59, 61},
        Region{"wall", 20, 300, 200, 480, 0.05, 0.12}}) {
    const double found = median(r, [&](int x, int y) { return 10 * picture.luminance(x, y); });
    EXPECT_TRUE(found > r.low && found < r.high) << r.name << ' ' << found;
  }
  double brightest = 0;
  for (int y = 0; y < 720; ++y)
    for (int x = 0; x < 1280; ++x) brightest = std::max(brightest, 10 * picture.luminance(x, y));
  EXPECT_TRUE(brightest > 1e4 && brightest < 1e6) << brightest;
}

/// 8-bit codes of what apply makes of it.
Picture seen(const std::string& folder, std::vector<std::string> more) {
  std::vector<std::string> arguments = {"apply", street, "-o", folder + "/out.png", "-d", "uint8", "-q"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const test::Outcome outcome = test::run_program(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return Picture(folder + "/out.png");
}

TEST(Street, is_a_night_the_ground_dark_the_lamps_white_in_a_coloured_glow) {
  const std::string folder = test::work_folder();
  const Picture night = seen(folder, {"--adaptation", "moon"});
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_LE(255 * median(ground, [&](int x, int y) { return double{night.at(x, y, c)}; }), 60) << c;
  const Picture lamps = seen(folder, {"--adaptation", "street"});
  // The sodium lamp at (488, 204): its core, and 40 pixels below.
  EXPECT_GT(lamps.at(488, 204, 2), 0.9f);
  EXPECT_GT(lamps.at(488, 244, 0), 2 * lamps.at(488, 244, 2));
  const Picture plain = seen(folder, {"--adaptation", "street", "--glare", "none"});
  EXPECT_LT(plain.at(488, 244, 0), 0.5f * lamps.at(488, 244, 0));
  std::filesystem::remove_all(folder);
}

TEST(Street, tells_its_unit) {
  const test::Outcome outcome = test::run_program({"explain", street, "--json", "-q"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["whiteLuminance"], 10.0);
  EXPECT_NEAR(report["photopic"]["logAverage"].get<double>(), 0.0388, 0.001);
}

}  // namespace
}  // namespace scotopic
