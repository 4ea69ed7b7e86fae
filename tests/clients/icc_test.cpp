// Files with an embedded profile, read back by other people's colour management: taken to sRGB they must show
// what this program writes as sRGB by OpenColorIO, which knows no profiles.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "clients/host.h"

namespace scotopic::test {
namespace {

const std::string profiles = "/usr/share/color/icc/";

/// A chart of 16 x 16 squares of 8 pixels: hues and greys inside sRGB, 2 % to white. Squares are whole blocks
/// of JPEG.
const std::string& chart() {
  static const std::string file = [] {
    constexpr int side = 128;
    std::vector<float> rgb;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int i = x / 8, j = y / 8;
        const double value = 0.02 * std::pow(50.0, j / 15.0), hue = i * 0.4;
        for (int c = 0; c < 3; ++c)
          rgb.push_back(static_cast<float>(i == 0 ? value : value * (0.55 + 0.45 * std::cos(hue + 2.1 * c))));
      }
    std::string name = output("chart.exr");
    const auto out = OIIO::ImageOutput::create(name);
    out->open(name, OIIO::ImageSpec(side, side, 3, OIIO::TypeDesc::FLOAT));
    out->write_image(OIIO::TypeDesc::FLOAT, rgb.data());
    out->close();
    return name;
  }();
  return file;
}

/// Values of R, G, B, 0 to 255, as the file holds them.
std::vector<double> codes(const std::string& file) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in) return {};
  const OIIO::ImageSpec spec = in->spec();
  std::vector<float> pixels(static_cast<std::size_t>(spec.image_pixels() * 3));
  EXPECT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data())) << in->geterror();
  std::vector<double> out;
  for (const float p : pixels) out.push_back(255.0 * static_cast<double>(p));
  return out;
}

double worst(const std::string& what, const std::string& a, const std::string& b) {
  const std::vector<double> x = codes(a), y = codes(b);
  if (x.empty() || x.size() != y.size()) return 1e9;
  double out = 0;
  for (std::size_t i = 0; i < x.size(); ++i) out = std::max(out, std::abs(x[i] - y[i]));
  std::printf("%s: worst %.2f codes of 8 bits\n", what.c_str(), out);
  return out;
}

void write_as(const std::string& options, const std::string& out) {
  const Finished done = run(quoted(SCOTOPIC_PROGRAM) + " apply " + quoted(chart()) + " -o " + quoted(out) +
                            " --adaptation 0.5 -q " + options);
  ASSERT_EQ(done.exit_code, 0) << done.said;
}

/// The picture as OpenColorIO writes it: sRGB, 16 bits.
std::string as_srgb() {
  const std::string file = output("srgb.tif");
  write_as("--output-colorspace 'sRGB - Texture' -d uint16", file);
  return file;
}

struct Device {
  const char* profile;
  const char* intent;
};
const Device devices[] = {{"compatibleWithAdobeRGB1998.icc", "relative"},
                          {"compatibleWithAdobeRGB1998.icc", "perceptual"},
                          {"LStar-RGB.icc", "absolute"},
                          {"sRGB.icc", "saturation"}};

std::string icc(const Device& d) { return "--icc " + quoted(profiles + d.profile) + " --intent " + d.intent; }

#define NEEDS_PROFILES                                 \
  if (!std::filesystem::exists(profiles + "sRGB.icc")) \
  GTEST_SKIP() << "NOTICE: icc-profiles-free is not installed"

TEST(Icc, tiff_of_16_bits_is_read_back_by_tificc) {
  NEEDS("tificc");
  NEEDS_PROFILES;
  const std::string wanted = as_srgb();
  for (const Device& d : devices) {
    write_as(icc(d) + " -d uint16", output("device.tif"));
    const Finished done = run("tificc -w16 -c0 -t1 -o'*sRGB' " + quoted(output("device.tif")) + " " +
                              quoted(output("back.tif")));
    ASSERT_EQ(done.exit_code, 0) << done.said;
    EXPECT_LE(worst(std::string(d.profile) + " " + d.intent + ", tificc", output("back.tif"), wanted), 1.0);
  }
}

TEST(Icc, tiff_of_8_bits_holds_the_profile_and_the_nearest_values) {
  NEEDS("tificc");
  NEEDS_PROFILES;
  write_as(icc(devices[0]) + " -d uint16", output("device16.tif"));
  write_as(icc(devices[0]) + " -d uint8", output("device8.tif"));
  EXPECT_LE(worst("8 against 16 bits", output("device8.tif"), output("device16.tif")), 0.51);
  const Finished done = run("tificc -s" + quoted(output("saved.icc")) + " -o'*sRGB' " +
                            quoted(output("device8.tif")) + " " + quoted(output("back8.tif")));
  ASSERT_EQ(done.exit_code, 0) << done.said;
  EXPECT_EQ(run("cmp " + quoted(output("saved.icc")) + " " + quoted(profiles + devices[0].profile)).exit_code,
            0);
}

TEST(Icc, jpeg_is_read_back_by_jpgicc) {
  NEEDS("jpgicc");
  NEEDS_PROFILES;
  write_as(icc(devices[0]) + " --quality 100", output("device.jpg"));
  write_as(icc(devices[0]) + " -d uint16", output("device16.tif"));
  // JPEG's own arithmetic (YCbCr in whole numbers) is two codes; its squares are flat.
  EXPECT_LE(worst("JPEG against TIFF", output("device.jpg"), output("device16.tif")), 2.0);
  const Finished done =
      run("jpgicc -q100 -o'*sRGB' " + quoted(output("device.jpg")) + " " + quoted(output("back.jpg")));
  ASSERT_EQ(done.exit_code, 0) << done.said;
  EXPECT_LE(worst("back from JPEG", output("back.jpg"), as_srgb()), 4.5);
}

TEST(Icc, png_holds_the_profile) {
  NEEDS("tificc");
  NEEDS("oiiotool");
  NEEDS_PROFILES;
  write_as(icc(devices[0]), output("device.png"));
  const Finished moved =
      run("oiiotool " + quoted(output("device.png")) + " -o " + quoted(output("moved.tif")));
  ASSERT_EQ(moved.exit_code, 0) << moved.said;
  const Finished done =
      run("tificc -w16 -c0 -t1 -o'*sRGB' " + quoted(output("moved.tif")) + " " + quoted(output("back.tif")));
  ASSERT_EQ(done.exit_code, 0) << done.said;
  EXPECT_LE(worst("PNG, tificc", output("back.tif"), as_srgb()), 1.0);
}

TEST(Icc, another_library_s_colour_management_agrees) {
  NEEDS("cctiff");
  NEEDS_PROFILES;
  write_as(icc(devices[0]) + " -d uint16", output("device.tif"));
  const Finished done =
      run("cctiff -p -ir " + quoted(output("device.tif")) + " -ir " + quoted(profiles + "sRGB.icc") + " " +
          quoted(output("device.tif")) + " " + quoted(output("argyll.tif")));
  ASSERT_EQ(done.exit_code, 0) << done.said;
  EXPECT_LE(worst("Adobe RGB, cctiff", output("argyll.tif"), as_srgb()), 1.0);
}

}  // namespace
}  // namespace scotopic::test
