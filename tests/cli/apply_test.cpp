#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "support/file_bytes.h"

namespace scotopic {
namespace {

using test::bytes_of;

class Apply : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = test::work_folder(); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  nlohmann::json applied(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"apply", path("in.exr"), "-o", path("out.exr"), "--json", "-q"});
    const test::Outcome outcome = test::run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out).at("applied");
  }
  std::string folder_;
};

TEST_F(Apply, memory_does_not_grow_with_the_height) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep memory of their own: nothing to be learnt here";
#endif
  test::write_picture(path("low.exr"), 2048, 512);
  test::write_picture(path("high.exr"), 2048, 8192);
  const auto peak = [&](const char* in) {
    const test::Outcome outcome = test::run_program(
        {"apply", path(in), "-o", path("out.exr"), "--adaptation", "0.1", "-q", "--threads", "2"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.peak_kib;
  };
  const long low = peak("low.exr"), high = peak("high.exr");
  std::printf("peak memory: %ld KiB for 512 rows, %ld KiB for 8192 (96 MiB of pixels)\n", low, high);
  // One band more or less; the pixels of the high picture would be 90 MiB more.
  EXPECT_LT(high, low + 24 * 1024);
}

TEST_F(Apply, luminances_are_taken_from_where_they_are_known_best) {
  {
    Imf::Header header(16, 16);
    Imf::addWhiteLuminance(header, 50.0f);
    Imf::RgbaOutputFile out(path("in.exr").c_str(), header, Imf::WRITE_RGB);
    const std::vector<Imf::Rgba> grey(16 * 16, Imf::Rgba(0.5f, 0.5f, 0.5f));
    out.setFrameBuffer(grey.data(), 1, 16);
    out.writePixels(16);
  }
  EXPECT_NEAR(applied({"--adaptation", "1"}).at("whiteLuminance"), 50.0, 1e-9);
  EXPECT_NEAR(applied({"--adaptation", "1", "--white-luminance", "8"}).at("whiteLuminance"), 8.0, 1e-12);
  // Log-average of a grey .5 is .5 but for the offset of 1e-6 of its largest value.
  EXPECT_NEAR(applied({}).at("scotopic:adaptation"), 25.0, 25 * 2e-6);
  EXPECT_NEAR(applied({"--white-luminance", "8"}).at("scotopic:adaptation"), 4.0, 4 * 2e-6);
  // Two stops brighter: value 1 then stands for a quarter of the light.
  EXPECT_NEAR(applied({"--adaptation", "1", "--exposure", "2"}).at("whiteLuminance"), 12.5, 1e-9);
  Imf::RgbaInputFile written(path("out.exr").c_str());
  EXPECT_EQ(Imf::whiteLuminance(written.header()), 12.5f);
}

TEST_F(Apply, without_any_unit_middle_grey_is_what_the_eye_is_adapted_to) {
  test::write_picture(path("in.exr"), 16, 16);
  EXPECT_NEAR(applied({"--adaptation", "0.9"}).at("whiteLuminance"), 5.0, 1e-12);
}

TEST_F(Apply, strength_nothing_and_daylight_change_no_pixel) {
  test::write_picture(path("in.exr"), 64, 48);
  applied({"--adaptation", "5"});
  const auto pixels = [&](const char* name) {
    Imf::RgbaInputFile file(path(name).c_str());
    std::vector<Imf::Rgba> out(64 * 48);
    file.setFrameBuffer(out.data(), 1, 64);
    file.readPixels(0, 47);
    std::vector<std::uint16_t> bits;
    for (const Imf::Rgba& p : out) bits.insert(bits.end(), {p.r.bits(), p.g.bits(), p.b.bits()});
    return bits;
  };
  EXPECT_EQ(pixels("out.exr"), pixels("in.exr"));
  applied({"--adaptation", "0.01", "--strength", "0"});
  EXPECT_EQ(pixels("out.exr"), pixels("in.exr"));
  applied({"--adaptation", "0.01", "--effects", "none"});
  EXPECT_EQ(pixels("out.exr"), pixels("in.exr"));
  applied({"--adaptation", "0.01"});
  EXPECT_NE(pixels("out.exr"), pixels("in.exr"));
}

TEST_F(Apply, the_same_command_gives_the_same_bytes) {
  test::write_picture(path("in.exr"), 300, 200);
  applied({"--adaptation", "0.1", "--threads", "1"});
  const std::string first = bytes_of(path("out.exr"));
  applied({"--adaptation", "0.1", "--threads", "3"});
  EXPECT_EQ(bytes_of(path("out.exr")), first);
}

}  // namespace
}  // namespace scotopic
