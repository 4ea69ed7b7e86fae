// PNG and JPEG: chunks and segments that contradict, come twice, or say what is seldom said.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "files/brothers/table.h"

namespace scotopic {
namespace {

using test::Chunk;
using test::as_codes;
using test::Expected;
using test::in_srgb;
using test::Rgb;

const std::vector<std::uint16_t> pixel = {128 * 257, 64 * 257, 200 * 257};

Chunk gama(std::uint32_t value) { return {"gAMA", test::big_endian(value)}; }
Chunk cicp(char primaries, char transfer) { return {"cICP", std::string({primaries, transfer, 0, 1})}; }

struct PngRow {
  std::vector<Chunk> chunks;
  std::vector<Chunk> behind;  // the pixels
  Expected expected;
};

/// Chunks of another PNG, before IEND of this.
std::string with_chunks_behind(std::string png, const std::vector<Chunk>& chunks) {
  const std::string other = test::flat_png({0}, chunks);
  const std::size_t from = 8 + 12 + 13, to = other.find("IDAT") - 4;
  return png.insert(png.size() - 12, other.substr(from, to - from));
}

TEST(Brothers, chunks_of_png) {
  const std::vector<PngRow> rows = {
      {{cicp(1, 8), cicp(9, 16)},
       {},
       {"two cICP: the first", as_codes, 1e-4, "second chunk cICP is left alone"}},
      {{gama(100000), gama(45455)}, {}, {"two gAMA", as_codes, 1e-4, "second chunk gAMA is left alone"}},
      {{}, {gama(100000)}, {"gAMA behind the pixels", in_srgb, 1e-4, "chunk gAMA stands behind the pixels"}},
      {{}, {cicp(9, 16)}, {"cICP behind the pixels", in_srgb, 1e-4, "chunk cICP stands behind the pixels"}},
      {{{"cICP", "\1\10"}}, {}, {"a short cICP", in_srgb, 1e-4, "cICP is not of its size"}},
      {{gama(0)}, {}, {"gAMA of 0", in_srgb, 1e-4, "gAMA says nothing"}},
      {{{"cHRM", "1234"}}, {}, {"a short cHRM", in_srgb, 1e-4, "cHRM is not of its size"}},
      {{gama(4200000000)}, {}, {"gAMA of 42000", {}, 0, "", "out of all use"}},
      {{{"acTL", test::big_endian(2) + test::big_endian(0)}},
       {},
       {"an animation", in_srgb, 1e-4, "one of its 2 frames"}},
      {{{"eXIf", test::exif_block({}, {{42240, 5, {1}}})}},
       {},
       {"Exif gamma 1", as_codes, 1e-4, "Exif gamma 1"}},
  };
  for (const PngRow& row : rows) {
    test::write_bytes(test::place("in.png"),
                      with_chunks_behind(test::flat_png(pixel, row.chunks), row.behind));
    test::expect_row(test::place("in.png"), row.expected);
  }
}

struct ExifRow {
  std::vector<test::TiffField> main, exif;
  Expected expected;
};

TEST(Brothers, exif_of_jpeg) {
  test::write_flat_oiio(test::place("plain.jpg"), {0.5f, 0.5f, 0.5f}, false, "");
  std::ostringstream plain;
  plain << std::ifstream(test::place("plain.jpg"), std::ios::binary).rdbuf();
  const double code = 128 / 255.0, srgb = test::srgb_light(128);
  const auto grey = [](double v) { return Rgb{v, v, v}; };
  const std::vector<double> adobe = {0.64, 0.33, 0.21, 0.71, 0.15, 0.06}, d65 = {0.3127, 0.3290};
  const std::vector<ExifRow> rows = {
      {{}, {{40961, 3, {1}}, {42240, 5, {2.2}}}, {"sRGB, 2.2: one name for both", grey(srgb)}},
      {{}, {{42240, 5, {1}}}, {"gamma 1", grey(code), 1e-4, "Exif gamma 1"}},
      {{}, {{40961, 3, {0xffff}}, {42240, 5, {1.8}}}, {"gamma 1.8", grey(std::pow(code, 1.8))}},
      {{}, {{40961, 3, {1}}, {42240, 5, {1.8}}}, {"sRGB and 1.8", grey(srgb), 1e-4, "say different things"}},
      {{}, {{42240, 5, {0}}}, {"gamma 0", {}, 0, "", "out of all use"}},
      {{}, {{40961, 3, {0xffff}}}, {"uncalibrated", grey(srgb), 1e-4, "says that it is not sRGB"}},
      {{}, {{40961, 3, {0xfffd}}}, {"a maker's own", grey(srgb), 1e-4, "says that it is not sRGB"}},
      {{{318, 5, d65}, {319, 5, adobe}},
       {{40961, 3, {0xffff}}, {42240, 5, {2.2}}},
       {"primaries and gamma", grey(std::pow(code, 2.2)), 1e-4, "chromaticities, gamma 2.2"}},
      {{{318, 5, d65}, {319, 5, adobe}},
       {{40961, 3, {2}}},
       {"Adobe RGB with its primaries", grey(std::pow(code, 563.0 / 256))}},
  };
  for (const ExifRow& row : rows) {
    const std::string block = std::string("Exif\0\0", 6) + test::exif_block(row.main, row.exif);
    test::write_bytes(test::place("in.jpg"), test::with_segment(plain.str(), '\xe1', block));
    test::expect_row(test::place("in.jpg"), row.expected);
  }
}

}  // namespace
}  // namespace scotopic
