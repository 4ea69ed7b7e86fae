#include "files/brothers/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace scotopic::test {
namespace {

std::string little(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xffu);
  return out;
}

std::string value_of(std::uint32_t type, double v) {
  constexpr double denominator = 1e6;
  switch (type) {
    case 3:
      return little(static_cast<std::uint64_t>(v), 2);
    case 5:
      return little(static_cast<std::uint64_t>(std::llround(v * denominator)), 4) + little(1000000, 4);
    case 11:
      return little(std::bit_cast<std::uint32_t>(static_cast<float>(v)), 4);
    case 12:
      return little(std::bit_cast<std::uint64_t>(v), 8);
    default:
      return little(static_cast<std::uint64_t>(v), 4);
  }
}

std::string sample(const TiffSamples& s, double v) {
  if (s.format == 3 && s.bits == 32) return value_of(11, v);
  return little(static_cast<std::uint64_t>(v), static_cast<int>(s.bits / 8));
}

}  // namespace

std::string tiff_directory(std::vector<TiffField> fields, std::uint32_t at) {
  std::sort(fields.begin(), fields.end(), [](const auto& a, const auto& b) { return a.tag < b.tag; });
  const auto behind = static_cast<std::uint32_t>(at + 2 + 12 * fields.size() + 4);
  std::string out = little(fields.size(), 2), values;
  for (const TiffField& field : fields) {
    std::string bytes;
    for (const double v : field.values) bytes += value_of(field.type, v);
    out += little(field.tag, 2) + little(field.type, 2) + little(field.values.size(), 4);
    if (bytes.size() <= 4) bytes.resize(4);
    out += bytes.size() == 4 ? bytes : little(behind + values.size(), 4);
    if (bytes.size() > 4) values += bytes;
  }
  return out + little(0, 4) + values;
}

std::string flat_tiff(const TiffSamples& s, std::vector<TiffField> more) {
  constexpr std::uint32_t pixels_at = 8;
  std::string pixels;
  for (int i = 0; i < 16; ++i)
    for (const double v : s.pixel) pixels += sample(s, v);
  const std::vector<double> each(s.pixel.size());
  std::vector<double> bits = each, formats = each;
  std::fill(bits.begin(), bits.end(), s.bits);
  std::fill(formats.begin(), formats.end(), s.format);
  more.insert(more.end(), {{256, 3, {4}},
                           {257, 3, {4}},
                           {258, 3, bits},
                           {259, 3, {1}},
                           {262, 3, {static_cast<double>(s.photometric)}},
                           {273, 4, {pixels_at}},
                           {277, 3, {static_cast<double>(s.pixel.size())}},
                           {278, 3, {4}},
                           {279, 4, {static_cast<double>(pixels.size())}},
                           {339, 3, formats}});
  pixels.resize(pixels.size() + pixels.size() % 2);
  const auto at = static_cast<std::uint32_t>(pixels_at + pixels.size());
  return std::string("II*\0", 4) + little(at, 4) + pixels + tiff_directory(std::move(more), at);
}

std::string exif_block(std::vector<TiffField> main, std::vector<TiffField> exif) {
  main.push_back({34665, 4, {0}});
  const auto at = static_cast<std::uint32_t>(8 + tiff_directory(main, 8).size());
  main.back().values[0] = at;
  return std::string("II*\0", 4) + little(8, 4) + tiff_directory(main, 8) +
         tiff_directory(std::move(exif), at);
}

std::string with_segment(const std::string& jpeg, char marker, const std::string& body) {
  const auto size = static_cast<std::uint32_t>(body.size() + 2);
  return jpeg.substr(0, 2) + '\xff' + marker + big_endian(size, 2) + body + jpeg.substr(2);
}

double srgb_light(double code) {
  const double v = code / 255;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

void expect_row(const std::string& file, const Expected& row) {
  const std::string out = place("out.exr");
  const Run run = apply(file, out, {"-d", "float", "--output-colorspace", "Linear Rec.709 (sRGB)"});
  EXPECT_NE(run.err.find(row.refusal.empty() ? row.says : row.refusal), std::string::npos)
      << row.what << ": " << run.err;
  if (!row.refusal.empty()) {
    EXPECT_TRUE(run.exit_code == 2 || run.exit_code == 3) << row.what << ": exit " << run.exit_code;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << row.what << ": " << run.err;
    return;
  }
  ASSERT_EQ(run.exit_code, 0) << row.what << ": " << run.err;
  const std::vector<float> p = pixel_of(out, row.channels);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(p[c], row.light[c], row.tolerance * std::max(1.0, std::abs(row.light[c])))
        << row.what << ", component " << c;
}

}  // namespace scotopic::test
