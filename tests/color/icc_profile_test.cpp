// Devices by their ICC profiles: what values come out, which profiles are refused.
#include "color/icc_profile.h"

#include <gtest/gtest.h>
#include <lcms2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/error.h"
#include "support/exr_files.h"
#include "color/primaries.h"

namespace scotopic {
namespace {

const Matrix3<double> rec709 = gamut_xyz_matrix("rec709").value();

std::string saved_profile(cmsHPROFILE profile, const std::string& name) {
  const std::string file = test::temporary(name);
  EXPECT_TRUE(cmsSaveProfileToFile(profile, file.c_str()));
  cmsCloseProfile(profile);
  return file;
}

/// Primaries of Adobe RGB (1998), D65, a plain power of 2.2.
std::string wide_gamut() {
  const cmsCIExyY white = {0.3127, 0.3290, 1};
  const cmsCIExyYTRIPLE primaries = {{0.64, 0.33, 1}, {0.21, 0.71, 1}, {0.15, 0.06, 1}};
  cmsToneCurve* curve = cmsBuildGamma(nullptr, 2.2);
  cmsToneCurve* const curves[3] = {curve, curve, curve};
  cmsHPROFILE profile = cmsCreateRGBProfile(&white, &primaries, curves);
  cmsFreeToneCurve(curve);
  return saved_profile(profile, "wide.icc");
}

/// A printer whose tables say which intent was asked for: device value = a share of the L* of what comes in.
std::string printer_of_shares(cmsColorSpaceSignature space = cmsSigRgbData) {
  const cmsUInt32Number channels = cmsChannelsOf(space);
  cmsHPROFILE profile = cmsCreateProfilePlaceholder(nullptr);
  cmsSetProfileVersion(profile, 4.3);
  cmsSetDeviceClass(profile, cmsSigOutputClass);
  cmsSetColorSpace(profile, space);
  cmsSetPCS(profile, cmsSigLabData);
  const cmsTagSignature tables[3] = {cmsSigBToA0Tag, cmsSigBToA1Tag, cmsSigBToA2Tag};
  for (int i = 0; i < 3; ++i) {
    cmsPipeline* table = cmsPipelineAlloc(nullptr, 3, channels);
    cmsStage* clut = cmsStageAllocCLut16bit(nullptr, 9, 3, channels, nullptr);
    double share = 1.0 - 0.25 * i;
    cmsStageSampleCLut16bit(
        clut,
        [](const cmsUInt16Number in[], cmsUInt16Number out[], void* cargo) {
          for (int c = 0; c < 3; ++c)
            out[c] = static_cast<cmsUInt16Number>(in[0] * *static_cast<double*>(cargo));
          return 1;
        },
        &share, 0);
    cmsPipelineInsertStage(table, cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
    cmsPipelineInsertStage(table, cmsAT_END, clut);
    cmsPipelineInsertStage(table, cmsAT_END, cmsStageAllocToneCurves(nullptr, channels, nullptr));
    EXPECT_TRUE(cmsWriteTag(profile, tables[i], table));
    cmsPipelineFree(table);
  }
  cmsWriteTag(profile, cmsSigMediaWhitePointTag, cmsD50_XYZ());
  return saved_profile(profile, "printer.icc");
}

Vec3<float> device(const IccProfile& profile, Vec3<float> rgb) {
  profile.apply(rec709, &rgb[0], &rgb[1], &rgb[2], 1);
  return rgb;
}

TEST(IccProfile, a_matrix_profile_gives_what_its_primaries_say) {
  const IccProfile profile(wide_gamut(), RenderingIntent::relative);
  EXPECT_FALSE(profile.bytes().empty());
  const Matrix3<double> wide =
      inverse(xyz_from_rgb({{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, white_d65})) * rec709;
  double worst = 0;
  for (const Vec3<double>& rgb : {Vec3<double>{1, 1, 1},
                                  {0.18, 0.18, 0.18},
                                  {0.5, 0.1, 0.02},
                                  {0.001, 0.03, 0.9},
                                  {0.7, 0.7, 0.001},
                                  {1e-4, 1e-4, 1e-4}}) {
    const Vec3<double> linear = wide * rgb;
    const Vec3<float> got = device(profile, {float(rgb[0]), float(rgb[1]), float(rgb[2])});
    for (std::size_t i = 0; i < 3; ++i)
      worst = std::max(worst, std::abs(double(got[i]) - std::pow(std::max(0.0, linear[i]), 1 / 2.2)));
  }
  std::printf("matrix profile: worst difference %.2g of the full scale\n", worst);
  EXPECT_LE(worst, 5e-4);  // colorants are stored in 1/65536
}

TEST(IccProfile, black_is_black_and_what_is_no_light_is_some_value_of_the_device) {
  for (const RenderingIntent intent :
       {RenderingIntent::relative, RenderingIntent::absolute, RenderingIntent::perceptual})
    for (const std::string& file : {wide_gamut(), printer_of_shares()}) {
      const IccProfile profile(file, intent);
      for (const float x : device(profile, {0, 0, 0}))
        EXPECT_NEAR(x, 0, intent == RenderingIntent::perceptual ? 0.035 : 5e-3);  // ICC.1 v4: black of L* 3.1
      const float nan = std::numeric_limits<float>::quiet_NaN(),
                  infinite = std::numeric_limits<float>::infinity();
      for (const Vec3<float>& odd : {Vec3<float>{nan, 0.2f, 0.2f},
                                     {infinite, 1, 1},
                                     {-infinite, 0, 0},
                                     {1e30f, 1, 1},
                                     {-1e30f, 5, 5},
                                     {2, 3, 4}})
        for (const float x : device(profile, odd)) EXPECT_TRUE(std::isfinite(x));
    }
}

TEST(IccProfile, the_intent_chooses_the_profile_s_table) {
  const std::string file = printer_of_shares();
  const double lightness = 0.5;  // of L* = 50, that is Y = .1842
  const Vec3<float> grey = {0.18419f, 0.18419f, 0.18419f};
  const auto value = [&](RenderingIntent intent) {
    return double(device(IccProfile(file, intent), grey)[1]);
  };
  EXPECT_NEAR(value(RenderingIntent::relative), 0.75 * lightness, 2e-3);
  EXPECT_NEAR(value(RenderingIntent::absolute), 0.75 * lightness, 2e-3);
  EXPECT_NEAR(value(RenderingIntent::saturation), 0.50 * lightness, 0.02);  // black point moved: ICC.1 v4
  EXPECT_NEAR(value(RenderingIntent::perceptual), 1.00 * lightness, 0.02);
}

TEST(IccProfile, rows_do_not_depend_on_their_length) {
  const IccProfile profile(wide_gamut(), RenderingIntent::relative);
  std::array<std::vector<float>, 3> rows;
  for (std::size_t c = 0; c < 3; ++c)
    for (int i = 0; i < 1000; ++i)
      rows[c].push_back(static_cast<float>((i * (7 + 2 * static_cast<int>(c))) % 101) / 100);
  auto whole = rows;
  profile.apply(rec709, whole[0].data(), whole[1].data(), whole[2].data(), 1000);
  for (std::size_t i = 0; i < 1000; i += 37)
    EXPECT_EQ(device(profile, {rows[0][i], rows[1][i], rows[2][i]}),
              (Vec3<float>{whole[0][i], whole[1][i], whole[2][i]}));
}

void expect_refused(const std::string& file, const std::string& says) {
  try {
    const IccProfile profile(file, RenderingIntent::relative);
    ADD_FAILURE() << file << " was taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::config);
    EXPECT_EQ(e.file(), file);
    EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

TEST(IccProfile, what_is_no_profile_of_an_rgb_device_is_refused) {
  const std::string text = test::temporary("text.icc"), empty = test::temporary("empty.icc");
  std::ofstream(text) << "hello, night\n";
  std::ofstream(empty).flush();
  expect_refused(text, "no ICC profile");
  expect_refused(empty, "no ICC profile");
  expect_refused(test::temporary("none.icc"), "cannot be read");
  expect_refused(std::filesystem::temp_directory_path().string(), "");
  expect_refused(saved_profile(cmsCreateLab4Profile(nullptr), "lab.icc"), "of Lab values");
  expect_refused(printer_of_shares(cmsSigCmykData), "of CMYK values");
  const cmsCIExyY white = {0.3127, 0.3290, 1};
  cmsToneCurve* curve = cmsBuildGamma(nullptr, 2.2);
  expect_refused(saved_profile(cmsCreateGrayProfile(&white, curve), "grey.icc"), "of GRAY values");
  cmsFreeToneCurve(curve);
  expect_refused(saved_profile(cmsCreateInkLimitingDeviceLink(cmsSigCmykData, 200), "link.icc"), "");
}

TEST(IccProfile, a_damaged_profile_is_refused_or_usable_and_never_more) {
  for (const std::string& good : {wide_gamut(), printer_of_shares()}) {
    const std::string bytes = test::file_bytes(good);
    int refused = 0, taken = 0;
    const auto try_one = [&](const std::string& damaged) {
      const std::string file = test::temporary("damaged.icc");
      std::ofstream(file, std::ios::binary) << damaged;
      try {
        const IccProfile profile(file, RenderingIntent::perceptual);
        for (const float x : device(profile, {0.2f, 0.5f, 1.5f})) (void)x;
        ++taken;
      } catch (const Error& e) {
        EXPECT_EQ(e.code(), ExitCode::config);
        ++refused;
      }
    };
    for (std::size_t n = 0; n < bytes.size(); n += 1 + bytes.size() / 97) try_one(bytes.substr(0, n));
    std::uint32_t state = 7;
    for (int i = 0; i < 300; ++i) {
      std::string spoilt = bytes;
      for (int k = 0; k < 3; ++k) {
        state = state * 1664525u + 1013904223u;  // Numerical Recipes
        spoilt[(state >> 8) % std::min<std::size_t>(spoilt.size(), 600)] = static_cast<char>(state >> 3);
      }
      try_one(spoilt);
    }
    std::printf("damaged profiles: %d refused, %d usable\n", refused, taken);
    EXPECT_GE(refused, 97);
  }
}

}  // namespace
}  // namespace scotopic
