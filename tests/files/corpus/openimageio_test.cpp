// Files in every combination of format, type, compression, tiling, window, alpha, colour tag and orientation,
// made on the fly with OpenImageIO and by hand: each is read right, in CIE XYZ, or refused in one line.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "files/corpus/corpus.h"

namespace scotopic {
namespace {

using test::judge;
using test::Meaning;
using test::sample_height;
using test::sample_width;
using test::Tally;

std::vector<float> pixels_of(int channels, bool associated) {
  std::vector<float> out;
  for (int y = 0; y < sample_height; ++y)
    for (int x = 0; x < sample_width; ++x) {
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
  OIIO::ImageSpec spec(sample_width, sample_height, channels, type);
  if (tile > 0) spec.tile_width = spec.tile_height = tile;
  return spec;
}

void set_profile(OIIO::ImageSpec& spec) {
  static const std::string profile = test::adobe_profile();
  spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                 profile.data());
}

Meaning of_profile() {
  Meaning out;
  out.profile = test::adobe_profile();
  return out;
}

/// OpenEXR: types, compressions, tiles, tags, alpha, windows.
void exr_files(Tally& tally) {
  const std::map<std::string, Meaning> tags = {{"", {}},
                                               {"chromaticities", {1, test::adobe_rgb}},
                                               {"lin_ap1_scene", {1, test::ap1}},
                                               {"srgb_rec709_scene", {0}},
                                               {"lin_ap0_scene", {1, test::ap0}}};
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
                Meaning meaning{type == OIIO::TypeDesc::FLOAT ? 1.0 : 0.0};
                if (profile) meaning = of_profile();
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
      {{}, {0}},
      {{gamma(100000)}, {}},
      {{gamma(45455)}, {1 / 0.45455}},
      {{gamma(55556), chrm}, {1 / 0.55556, test::adobe_rgb}},
      {{chrm}, {0, test::adobe_rgb}},
      {{{"sRGB", std::string(1, '\0')}, gamma(45455)}, {0}},
      {{{"cICP", std::string("\x1\xd\0\x1", 4)}}, {0}},
      {{{"cICP", std::string("\x1\x8\0\x1", 4)}, gamma(45455)}, {}},
      {{test::png_profile(test::adobe_profile())}, of_profile()},
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
          const Meaning meaning = profile ? of_profile() : Meaning{0};
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
      {"+X 2 -Y 3", 5}, {"-X 2 -Y 3", 6}, {"-X 2 +Y 3", 7}, {"+X 2 +Y 3", 8}};
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
               {1, primaries ? test::adobe_rgb : test::bt709},
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
  test::close("corpus", tally);
  EXPECT_GT(tally.right, 1500);
}

}  // namespace
}  // namespace scotopic
