// Files in every combination of format, type, compression, tiling, window, alpha, colour tag and orientation,
// made on the fly: each gives the light that an independent reading (OpenImageIO's pixels, and the formulas
// of the tags written again here) has of it, or is refused in one line.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>

#include "base/error.h"
#include "files/made_files.h"
#include "pipeline/apply_image.h"

namespace scotopic {
namespace {

using test::Rgb;
using Matrix = std::array<Rgb, 3>;

constexpr int width = 19, height = 11;

/// What values mean, by the file's tag: a power (0: sRGB's curve, 1: linear) and the matrix to linear BT.709.
struct Meaning {
  double power = 1;
  Matrix to_709{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

// Columns of CIE XYZ of both spaces (their chromaticities, white D65; AP1 and AP0 by Bradford), multiplied
// out in numpy.
constexpr Matrix identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Matrix from_adobe{{{1.39835574, -0.39835574, 0}, {0, 1, 0}, {0, -0.04292898, 1.04292898}}};
constexpr Matrix from_ap1{{{1.70505099, -0.62179212, -0.08325887},
                           {-0.13025642, 1.14080474, -0.01054832},
                           {-0.02400336, -0.12896898, 1.15297233}}};
constexpr Matrix from_ap0{{{2.52168619, -1.13413099, -0.38755520},
                           {-0.27647991, 1.37271909, -0.09623917},
                           {-0.01537806, -0.15297534, 1.16835340}}};

double decode(double v, double power) {
  if (power == 0) return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  return v > 0 ? std::pow(v, power) : v;
}

/// Light of a pixel: straight colour is decoded and multiplied by alpha; of encoded colour that alpha stands
/// before, that is undone first.
Rgb light_of(Rgb pixel, double alpha, bool straight, const Meaning& meaning) {
  const bool encoded = meaning.power != 1;
  Rgb linear;
  for (std::size_t c = 0; c < 3; ++c) {
    const double v = !straight && encoded && alpha > 0 ? pixel[c] / alpha : pixel[c];
    linear[c] = decode(v, meaning.power) * (straight || (encoded && alpha > 0) ? alpha : 1);
  }
  Rgb out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i] += meaning.to_709[i][j] * linear[j];
  return out;
}

struct Sample {
  std::string file;
  std::string what;
  Meaning meaning;
  int orientation = 1;
  double gain = 1;
};

struct Tally {
  int files = 0, right = 0, refused = 0, wrong = 0;
  double worst = 0;
  std::string worst_at;
};

/// What OpenImageIO reads: RGBA rows, grey thrice, alpha 1 where there is none.
struct Reading {
  int width = 0, height = 0;
  bool straight = false;
  std::vector<std::array<double, 4>> pixels;
};

Reading read(const std::string& file) {
  Reading out;
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = OIIO::ImageInput::open(file, &hints);
  if (!in) return out;
  const OIIO::ImageSpec& spec = in->spec();
  out.width = spec.width;
  out.height = spec.height;
  out.straight = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
  const auto n = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> values(static_cast<std::size_t>(spec.width * spec.height) * n);
  in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data());
  for (std::size_t i = 0; i < values.size(); i += n)
    out.pixels.push_back(
        {values[i], values[i + (n > 2 ? 1 : 0)], values[i + (n > 2 ? 2 : 0)], n == 4 ? values[i + 3] : 1});
  return out;
}

/// Where an upright pixel is stored: Exif's orientations, written as a table of (x, y).
std::pair<int, int> stored(int orientation, int x, int y, int w, int h) {
  const std::array<std::pair<int, int>, 9> table = {{{x, y},
                                                     {x, y},
                                                     {w - 1 - x, y},
                                                     {w - 1 - x, h - 1 - y},
                                                     {x, h - 1 - y},
                                                     {y, x},
                                                     {y, h - 1 - x},
                                                     {w - 1 - y, h - 1 - x},
                                                     {w - 1 - y, x}}};
  return table[static_cast<std::size_t>(orientation)];
}

void treat(const std::string& in, const std::string& out) {
  static const ColourConfig config = ColourConfig::own();
  ImageRequest request;
  request.output_colourspace = "Linear Rec.709 (sRGB)";
  request.type = PixelType::float32;
  OutputFile file(out);
  const std::unique_ptr<PixelSource> source = open_source(in, Limits());
  const ImageLayout layout = plan_layout(*source, out, config, request);
  apply_image(*source, layout, config, ImageStages(), file);
}

double worst_difference(const Sample& sample, const std::string& out) {
  const Reading in = read(sample.file), got = read(out);
  const bool turned = sample.orientation >= 5;
  if (got.width != (turned ? in.height : in.width) || got.height != (turned ? in.width : in.height))
    return INFINITY;
  double worst = 0;
  for (int y = 0; y < got.height; ++y)
    for (int x = 0; x < got.width; ++x) {
      const auto [sx, sy] = stored(sample.orientation, x, y, in.width, in.height);
      const auto& p = in.pixels[static_cast<std::size_t>(sy * in.width + sx)];
      const auto& g = got.pixels[static_cast<std::size_t>(y * got.width + x)];
      const Rgb wanted = light_of({p[0], p[1], p[2]}, p[3], in.straight, sample.meaning);
      const double size = std::abs(wanted[0]) + std::abs(wanted[1]) + std::abs(wanted[2]) + 0.01;
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(g[c] - wanted[c] * sample.gain) / size / std::max(1.0, sample.gain));
    }
  return worst;
}

void judge(const Sample& sample, Tally& tally) {
  ++tally.files;
  const std::string out = test::place("out.exr");
  try {
    treat(sample.file, out);
  } catch (const Error& e) {
    ++tally.refused;
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << sample.what;
    return;
  }
  const double difference = worst_difference(sample, out);
  const bool right = difference < 1e-3;
  right ? ++tally.right : ++tally.wrong;
  EXPECT_TRUE(right) << sample.what << ": off by " << difference;
  if (difference > tally.worst) tally.worst = difference, tally.worst_at = sample.what;
}

std::vector<float> pixels_of(int channels, bool associated) {
  std::vector<float> out;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float alpha = channels % 2 == 0 ? 0.25f + 0.05f * static_cast<float>(x % 15) : 1.0f;
      const int colours = channels > 2 ? 3 : 1;
      for (int c = 0; c < colours; ++c)
        out.push_back((0.1f + 0.8f * static_cast<float>((x * (c + 1) + y * 3) % 17) / 16.0f) *
                      (associated ? alpha : 1.0f));
      if (channels % 2 == 0) out.push_back(alpha);
    }
  return out;
}

bool write(const std::string& file, const OIIO::ImageSpec& spec, const std::vector<float>& pixels) {
  const auto out = OIIO::ImageOutput::create(file);
  return out && out->open(file, spec) && out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) &&
         out->close();
}

OIIO::ImageSpec spec_of(int channels, OIIO::TypeDesc type, int tile) {
  OIIO::ImageSpec spec(width, height, channels, type);
  if (tile > 0) spec.tile_width = spec.tile_height = tile;
  return spec;
}

void set_profile(OIIO::ImageSpec& spec) {
  static const std::string profile = test::adobe_profile();
  spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                 profile.data());
}

/// OpenEXR: types, compressions, tiles, tags, alpha, windows.
void exr_files(Tally& tally) {
  const std::map<std::string, Meaning> tags = {{"", {1, identity}},
                                               {"chromaticities", {1, from_adobe}},
                                               {"lin_ap1_scene", {1, from_ap1}},
                                               {"srgb_rec709_scene", {0, identity}},
                                               {"lin_ap0_scene", {1, from_ap0}}};
  for (const OIIO::TypeDesc type : {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT})
    for (const char* compression :
         {"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"})
      for (const int tile : {0, 16})
        for (const auto& [tag, meaning] : tags)
          for (const int channels : {1, 3, 4})
            for (const int window : {0, -7}) {
              OIIO::ImageSpec spec = spec_of(channels, type, tile);
              if (channels == 1) spec.channelnames = {"Y"};
              spec.attribute("compression", compression);
              spec.x = spec.y = window;
              const float adobe[8] = {0.64f, 0.33f, 0.21f, 0.71f, 0.15f, 0.06f, 0.3127f, 0.3290f};
              if (tag == "chromaticities")
                spec.attribute("chromaticities", OIIO::TypeDesc("float[8]"), adobe);
              else if (!tag.empty())
                spec.attribute("colorInteropID", tag);
              const std::string file = test::place("in.exr");
              const std::string what = std::string("exr ") + type.c_str() + " " + compression + " tile " +
                                       std::to_string(tile) + " " + tag + " channels " +
                                       std::to_string(channels) + " at " + std::to_string(window);
              if (write(file, spec, pixels_of(channels, true))) judge({file, what, meaning}, tally);
            }
}

void tiff_files(Tally& tally) {
  for (const OIIO::TypeDesc type : {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16, OIIO::TypeDesc::FLOAT})
    for (const char* compression : {"none", "lzw", "zip", "packbits"})
      for (const int tile : {0, 16})
        for (const int channels : {1, 3, 4})
          for (const bool straight : {false, true})
            for (const bool profile : {false, true})
              for (const int orientation : {1, 3, 6, 8}) {
                if (straight && channels != 4) continue;
                OIIO::ImageSpec spec = spec_of(channels, type, tile);
                spec.attribute("compression", compression);
                spec.attribute("Orientation", orientation);
                if (straight) spec.attribute("oiio:UnassociatedAlpha", 1);
                if (profile) set_profile(spec);
                Meaning meaning{type == OIIO::TypeDesc::FLOAT ? 1.0 : 0.0, identity};
                if (profile) meaning = {563.0 / 256, from_adobe};
                const std::string file = test::place("in.tif");
                const std::string what = std::string("tiff ") + type.c_str() + " " + compression + " tile " +
                                         std::to_string(tile) + " channels " + std::to_string(channels) +
                                         (straight ? " straight" : "") + (profile ? " profile" : "") +
                                         " orientation " + std::to_string(orientation);
                if (write(file, spec, pixels_of(channels, !straight)))
                  judge({file, what, meaning, orientation}, tally);
              }
}

void png_files(Tally& tally) {
  const test::Chunk chrm = {"cHRM", test::big_endian(31270) + test::big_endian(32900) +
                                        test::big_endian(64000) + test::big_endian(33000) +
                                        test::big_endian(21000) + test::big_endian(71000) +
                                        test::big_endian(15000) + test::big_endian(6000)};
  const auto gamma = [](std::uint32_t v) { return test::Chunk{"gAMA", test::big_endian(v)}; };
  const std::vector<std::pair<std::vector<test::Chunk>, Meaning>> tags = {
      {{}, {0, identity}},
      {{gamma(100000)}, {1, identity}},
      {{gamma(45455)}, {1 / 0.45455, identity}},
      {{gamma(55556), chrm}, {1 / 0.55556, from_adobe}},
      {{chrm}, {0, from_adobe}},
      {{{"sRGB", std::string(1, '\0')}, gamma(45455)}, {0, identity}},
      {{{"cICP", std::string("\x1\xd\0\x1", 4)}}, {0, identity}},
      {{{"cICP", std::string("\x1\x8\0\x1", 4)}, gamma(45455)}, {1, identity}},
      {{test::png_profile(test::adobe_profile())}, {563.0 / 256, from_adobe}},
  };
  int tag = 0;
  for (const auto& [chunks, meaning] : tags) {
    for (const std::size_t channels : {1u, 3u, 4u})
      for (const std::uint16_t base : std::array<std::uint16_t, 4>{300, 9000, 30000, 65535}) {
        const std::vector<std::uint16_t> pixel = {base, static_cast<std::uint16_t>(base / 2),
                                                  static_cast<std::uint16_t>(base / 3), 40000};
        test::write_bytes(
            test::place("in.png"),
            test::flat_png({pixel.begin(), pixel.begin() + static_cast<long>(channels)}, chunks));
        judge({test::place("in.png"),
               "png tag " + std::to_string(tag) + " channels " + std::to_string(channels) + " of " +
                   std::to_string(base),
               meaning},
              tally);
      }
    ++tag;
  }
}

void jpeg_files(Tally& tally) {
  for (const char* subsampling : {"4:4:4", "4:2:0"})
    for (const int channels : {1, 3})
      for (const bool profile : {false, true})
        for (int orientation = 1; orientation <= 8; ++orientation) {
          OIIO::ImageSpec spec = spec_of(channels, OIIO::TypeDesc::UINT8, 0);
          spec.attribute("jpeg:subsampling", subsampling);
          spec.attribute("Orientation", orientation);
          if (profile) set_profile(spec);
          const Meaning meaning = profile ? Meaning{563.0 / 256, from_adobe} : Meaning{0, identity};
          const std::string what = std::string("jpeg ") + subsampling + " channels " +
                                   std::to_string(channels) + (profile ? " profile" : "") + " orientation " +
                                   std::to_string(orientation);
          if (write(test::place("in.jpg"), spec, pixels_of(channels, false)))
            judge({test::place("in.jpg"), what, meaning, orientation}, tally);
        }
}

void hdr_files(Tally& tally) {
  const std::vector<std::pair<std::string, int>> orders = {
      {"-Y 2 +X 3", 1}, {"-Y 2 -X 3", 2}, {"+Y 2 -X 3", 3}, {"+Y 2 +X 3", 4},
      {"+X 2 -Y 3", 5}, {"+X 2 +Y 3", 6}, {"-X 2 +Y 3", 7}, {"-X 2 -Y 3", 8}};
  for (const auto& [order, orientation] : orders)
    for (const double exposure : {1.0, 0.25, 3.0})
      for (const bool primaries : {false, true}) {
        std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=" + std::to_string(exposure) + "\n";
        if (primaries) text += "PRIMARIES=0.64 0.33 0.21 0.71 0.15 0.06 0.3127 0.3290\n";
        text += "\n" + order + "\n";
        for (int i = 1; i <= 6; ++i)
          text +=
              std::string({static_cast<char>(i * 32), static_cast<char>(i * 16), 9, static_cast<char>(128)});
        test::write_bytes(test::place("in.hdr"), text);
        judge({test::place("in.hdr"),
               "hdr " + order + " exposure " + std::to_string(exposure) + (primaries ? " primaries" : ""),
               {1, primaries ? from_adobe : identity},
               orientation,
               1 / exposure},
              tally);
      }
}

TEST(Corpus, no_file_is_silently_wrong) {
  Tally tally;
  const std::vector<std::pair<const char*, void (*)(Tally&)>> kinds = {{"OpenEXR", exr_files},
                                                                       {"TIFF", tiff_files},
                                                                       {"PNG", png_files},
                                                                       {"JPEG", jpeg_files},
                                                                       {"HDR", hdr_files}};
  for (const auto& [name, files] : kinds) {
    const int before = tally.files;
    files(tally);
    std::printf("%s: %d files\n", name, tally.files - before);
  }
  std::printf("corpus: %d files, %d right, %d refused, %d silently wrong; worst %.2g (%s)\n", tally.files,
              tally.right, tally.refused, tally.wrong, tally.worst, tally.worst_at.c_str());
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_GT(tally.right, 1500);
}

}  // namespace
}  // namespace scotopic
