// Images with one fault each, named for it: refused with one line, nothing written, no memory taken for what
// a header merely says.
#include <OpenEXR/ImfCompression.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>

#include "faults/inputs.h"
#include "faults/rig.h"

namespace scotopic::test {
namespace {

namespace fs = std::filesystem;

template <typename T>
std::string little(T value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}
std::string text0(const std::string& text) { return text + std::string(1, '\0'); }

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return text0(name) + text0(type) + little(static_cast<std::int32_t>(value.size())) + value;
}
std::string box(std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1) {
  return little(x0) + little(y0) + little(x1) + little(y1);
}
std::string channel(const std::string& name, std::int32_t type = 1, std::int32_t x = 1, std::int32_t y = 1) {
  return text0(name) + little(type) + little(std::int32_t{0}) + little(x) + little(y);
}
std::string channels(const std::string& list) {
  return attribute("channels", "chlist", list + std::string(1, '\0'));
}

/// An uncompressed RGB half image of 4 x 2 pixels; each piece can be another.
struct Exr {
  std::uint32_t magic = 20000630, version = 2;
  std::string channel_list = channels(channel("B") + channel("G") + channel("R"));
  std::string compression = attribute("compression", "compression", std::string(1, '\0'));
  std::string window = attribute("dataWindow", "box2i", box(0, 0, 3, 1));
  std::string display = attribute("displayWindow", "box2i", box(0, 0, 3, 1));
  std::string order = attribute("lineOrder", "lineOrder", std::string(1, '\0'));
  std::string aspect = attribute("pixelAspectRatio", "float", little(1.0f));
  std::string centre = attribute("screenWindowCenter", "v2f", little(0.0f) + little(0.0f));
  std::string width = attribute("screenWindowWidth", "float", little(1.0f));
  std::string more;
  std::int32_t chunk_bytes = 24, first_row = 0;
  std::int64_t offset_error = 0;
  bool no_end = false;

  std::string bytes() const {
    std::string head = little(magic) + little(version) + channel_list + compression + window + display +
                       order + aspect + centre + width + more;
    if (no_end) return head;
    head += '\0';
    const auto start = static_cast<std::int64_t>(head.size()) + 16;
    head += little(start + offset_error) + little(start + 32 + offset_error);
    for (std::int32_t row = 0; row < 2; ++row) {
      head += little(first_row + row) + little(chunk_bytes);
      for (int i = 0; i < 12; ++i) head += little(std::uint16_t{0x3000});
    }
    return head;
  }
};

std::string exr(const std::function<void(Exr&)>& change) {
  Exr file;
  change(file);
  return file.bytes();
}

std::string file_of(const char* name) {
  std::ifstream in(input(name), std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::string big(std::uint32_t value) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xff);
  return out;
}

std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}
std::string png_chunk(const std::string& type, const std::string& data) {
  return big(static_cast<std::uint32_t>(data.size())) + type + data + big(crc_of(type + data));
}
std::string png(std::uint32_t width, std::uint32_t height, int depth, int colour, const std::string& rest) {
  std::string head = big(width) + big(height);
  head += static_cast<char>(depth);
  head += static_cast<char>(colour);
  head += std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", head) + rest;
}

std::string tiff_entry(std::uint16_t tag, std::uint16_t type, std::uint32_t count, std::uint32_t value) {
  return little(tag) + little(type) + little(count) + little(value);
}
/// 4 x 2 pixels of RGB uint8; `changes` replace entries of their tag.
std::string tiff(std::map<std::uint16_t, std::string> changes = {}, std::uint32_t next = 0,
                 std::uint32_t first = 8) {
  std::map<std::uint16_t, std::string> entries = {
      {256, tiff_entry(256, 4, 1, 4)}, {257, tiff_entry(257, 4, 1, 2)}, {258, tiff_entry(258, 3, 1, 8)},
      {259, tiff_entry(259, 3, 1, 1)}, {262, tiff_entry(262, 3, 1, 2)}, {273, tiff_entry(273, 4, 1, 200)},
      {277, tiff_entry(277, 3, 1, 3)}, {278, tiff_entry(278, 4, 1, 2)}, {279, tiff_entry(279, 4, 1, 24)},
      {284, tiff_entry(284, 3, 1, 1)}};
  for (auto& [tag, entry] : changes) entries[tag] = entry;
  std::string out =
      std::string("II*\0", 4) + little(first) + little(static_cast<std::uint16_t>(entries.size()));
  for (const auto& [tag, entry] : entries) out += entry;
  out += little(next);
  out.resize(200, '\0');
  return out + std::string(24, '\x40');
}
std::string tiff_with(std::uint16_t tag, std::uint16_t type, std::uint32_t value) {
  return tiff({{tag, tiff_entry(tag, type, 1, value)}});
}

struct MalformedImage {
  const char* fault;
  std::string bytes;
  int code;
  const char* says;
};

std::vector<MalformedImage> exr_rows() {
  const auto window = [](std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1) {
    return exr([&](Exr& e) { e.window = attribute("dataWindow", "box2i", box(x0, y0, x1, y1)); });
  };
  const auto more = [](const std::string& text) { return exr([&](Exr& e) { e.more = text; }); };
  const auto list = [](const std::string& text) {
    return exr([&](Exr& e) { e.channel_list = channels(text); });
  };
  const auto tiles = [](std::uint32_t x, std::uint32_t y, char mode) {
    return exr([&](Exr& e) {
      e.version |= 0x200;
      e.more = attribute("tiles", "tiledesc", little(x) + little(y) + std::string(1, mode));
    });
  };
  std::string many;
  for (int i = 0; i < 5000; ++i) many += channel("c" + std::to_string(10000 + i));
  const std::string rgb = channel("B") + channel("G") + channel("R");
  std::string endless = more("");
  endless = endless.substr(0, 8) + std::string(100000, 'x');
  std::string half_attribute = exr([](Exr& e) { e.no_end = true; });
  return {
      {"magic only", little(std::uint32_t{20000630}), 3, "ends within its header"},
      {"version 3", exr([](Exr& e) { e.version = 3; }), 3, "OpenEXR"},
      {"unknown flags", exr([](Exr& e) { e.version |= 0x800000; }), 3, "OpenEXR"},
      {"no attributes", little(std::uint32_t{20000630}) + little(2u) + std::string(1, '\0'), 3, ""},
      {"header without end", half_attribute, 3, "ends within its header"},
      {"name without end", endless, 3, "name without end"},
      {"no data window", exr([](Exr& e) { e.window = ""; }), 3, ""},
      {"no channels", exr([](Exr& e) { e.channel_list = ""; }), 3, "OpenEXR"},
      {"empty channel list", list(""), 3, ""},
      {"no compression", exr([](Exr& e) { e.compression = ""; }), 3, ""},
      {"window inside out", window(3, 1, 0, 0), 3, "OpenEXR"},
      {"window of the extremes of int", window(INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX), 4,
       "side 4294967296"},
      {"window too wide", window(0, 0, 1 << 20, 0), 4, "--max-side"},
      {"window too high", window(0, 0, 0, 1 << 20), 4, "--max-side"},
      {"too many pixels", window(0, 0, 200000, 200000), 4, "--max-pixels"},
      {"rows that are not there", window(0, 0, 3, 100000), 3, "table of its 100001 chunks"},
      {"display window inside out",
       exr([](Exr& e) { e.display = attribute("displayWindow", "box2i", box(5, 5, 0, 0)); }), 3, "OpenEXR"},
      {"five thousand channels", list(many), 4, "--max-channels"},
      {"channel of no known type", list(channel("B", 77) + channel("G") + channel("R")), 3, ""},
      {"channel sampled at 0", list(channel("B", 1, 0, 0) + channel("G") + channel("R")), 3, "OpenEXR"},
      {"channel sampled at -1", list(channel("B", 1, -1, -1) + channel("G") + channel("R")), 3, "OpenEXR"},
      {"subsampled colour", list(channel("B", 1, 2, 1) + channel("G") + channel("R")), 3, ""},
      {"the same channel twice", list(channel("B") + channel("B") + channel("B")), 3, ""},
      {"channel list longer than it says", exr([&](Exr& e) {
         e.channel_list =
             text0("channels") + text0("chlist") + little(std::int32_t{10}) + rgb + std::string(1, '\0');
       }),
       3, ""},
      {"unknown compression",
       exr([](Exr& e) { e.compression = attribute("compression", "compression", "\x63"); }), 3,
       "by a newer OpenEXR"},
      {"compression of OpenEXR 3.4",
       exr([](Exr& e) { e.compression = attribute("compression", "compression", "\x0a"); }), 3,
       Imf::NUM_COMPRESSION_METHODS > 10 ? "" : "by a newer OpenEXR"},
      {"compression that is not this data's",
       exr([](Exr& e) { e.compression = attribute("compression", "compression", "\x03"); }), 3, ""},
      {"unknown order of lines", exr([](Exr& e) { e.order = attribute("lineOrder", "lineOrder", "\x09"); }),
       3, ""},
      {"aspect that is no number",
       exr([](Exr& e) { e.aspect = attribute("pixelAspectRatio", "float", little(NAN)); }), 3, "OpenEXR"},
      {"negative screen window",
       exr([](Exr& e) { e.width = attribute("screenWindowWidth", "float", little(-1.0f)); }), 3, "OpenEXR"},
      {"attribute of negative size", more(text0("owner") + text0("string") + little(std::int32_t{-5})), 3,
       "attribute owner has -5 bytes"},
      {"attribute of two gigabytes", more(text0("owner") + text0("string") + little(INT32_MAX)), 3,
       "attribute owner has 2147483647 bytes"},
      {"attribute of another type than its name", more(attribute("owner", "box2i", "abc")), 3, ""},
      {"preview of 4 GB", more(attribute("preview", "preview", little(65535u) + little(65535u))), 3,
       "its preview"},
      {"tiles of no width", tiles(0, 64, '\0'), 3, "OpenEXR"},
      {"tiles of 2^31", tiles(0x80000000u, 64, '\0'), 4, "side of a tile"},
      {"tiles of unknown levels", tiles(64, 64, '\x2f'), 3, ""},
      {"tiled without a description", exr([](Exr& e) { e.version |= 0x200; }), 3, ""},
      {"a million tiles of a pixel", exr([](Exr& e) {
         e.version |= 0x200;
         e.window = attribute("dataWindow", "box2i", box(0, 0, 9999, 9999));
         e.more = attribute("tiles", "tiledesc", little(1u) + little(1u) + std::string(1, '\0'));
       }),
       3, "table of its 100000000 chunks"},
      {"parts without a header", exr([](Exr& e) { e.version |= 0x1000; }), 3, ""},
      {"part of no known type", exr([](Exr& e) {
         e.version |= 0x1000;
         e.more = attribute("name", "string", "a") + attribute("type", "string", "wormhole") +
                  attribute("chunkCount", "int", little(std::int32_t{2})) + std::string(1, '\0');
       }),
       3, ""},
      {"negative count of chunks", exr([](Exr& e) {
         e.version |= 0x1000;
         e.more = attribute("name", "string", "a") + attribute("type", "string", "scanlineimage") +
                  attribute("chunkCount", "int", little(std::int32_t{-2})) + std::string(1, '\0');
       }),
       3, ""},
      {"chunks beyond the end", exr([](Exr& e) { e.offset_error = 100000; }), 3, ""},
      {"chunks at negative places", exr([](Exr& e) { e.offset_error = -100000; }), 3, ""},
      {"chunk of negative size", exr([](Exr& e) { e.chunk_bytes = -24; }), 3, ""},
      {"chunk of two gigabytes", exr([](Exr& e) { e.chunk_bytes = INT32_MAX; }), 3, ""},
      {"chunk of a row that is not there", exr([](Exr& e) { e.first_row = 1000; }), 3, ""},
      {"no colour", list(channel("Z")), 3, "has no channels R, G, B"},
      {"luminance and chroma", list(channel("BY") + channel("RY") + channel("Y")), 3, ""},
      {"says it is spectral and has no band", more(attribute("spectralLayoutVersion", "string", "1.0")), 3,
       "no band"},
      {"one band", list(channel("S0.500nm")), 3, "single band"},
      {"bands without numbers", list(channel("S0.nm") + channel("S0.500nm") + channel("S0.x")), 3,
       "no number"},
  };
}

std::vector<MalformedImage> other_rows() {
  const std::string jpeg_start = "\xff\xd8\xff\xe0";
  std::string jpeg_size = "\xff\xd8\xff\xc0" + std::string("\0\x11\x08", 3) + "\xff\xff\xff\xff" +
                          std::string("\x03\x01\x11\0\x02\x11\0\x03\x11\0", 10);
  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  std::string pages = file_of("pages.tif");
  return {
      {"PNG: signature only", "\x89PNG\r\n\x1a\n", 3, ""},
      {"PNG: no width", png(0, 4, 8, 2, ""), 3, ""},
      {"PNG: width of 2^31-1", png(0x7fffffff, 1, 8, 2, ""), 4, "--max-side"},
      {"PNG: width over the limit", png(500000, 1, 8, 2, png_chunk("IDAT", "")), 4, "--max-side"},
      {"PNG: too many pixels", png(200000, 200000, 8, 2, png_chunk("IDAT", "")), 4, "--max-pixels"},
      {"PNG: depth of 3 bits", png(4, 4, 3, 2, ""), 3, ""},
      {"PNG: colour type 9", png(4, 4, 8, 9, ""), 3, ""},
      {"PNG: no data", png(4, 4, 8, 2, png_chunk("IEND", "")), 3, ""},
      {"PNG: data that is no zlib stream",
       png(4, 4, 8, 2, png_chunk("IDAT", "garbage") + png_chunk("IEND", "")), 3, ""},
      {"PNG: wrong checksum",
       "\x89PNG\r\n\x1a\n" + big(13) + "IHDR" + big(4) + big(4) + std::string("\x08\x02\0\0\0", 5) + big(0),
       3, ""},
      {"PNG: chunk of 2 GB", png(4, 4, 8, 2, big(0x7fffffff) + "IDAT"), 3, ""},
      {"PNG: palette missing", png(4, 4, 8, 3, png_chunk("IDAT", "x")), 3, ""},
      {"TIFF: header only", std::string("II*\0\x08\0\0\0", 8), 3, ""},
      {"TIFF: directory at 0", tiff({}, 0, 0), 3, ""},
      {"TIFF: directory beyond the end", tiff({}, 0, 100000), 3, ""},
      {"TIFF: directory of no entries", std::string("II*\0\x08\0\0\0\0\0\0\0\0\0", 14), 3, ""},
      {"TIFF: no width", tiff_with(256, 4, 0), 3, ""},
      {"TIFF: width over the limit", tiff_with(256, 4, 500000), 4, "--max-side"},
      {"TIFF: width of 2^32-1", tiff_with(256, 4, 0xffffffff), 3, ""},
      {"TIFF: height over the limit", tiff_with(257, 4, 500000), 4, "--max-side"},
      {"TIFF: 65535 channels", tiff_with(277, 3, 65535), 4, ""},
      {"TIFF: no channels", tiff_with(277, 3, 0), 3, ""},
      {"TIFF: 7 bits", tiff_with(258, 3, 7), 3, ""},
      {"TIFF: 32-bit integers", tiff_with(258, 3, 32), 3, "can be read"},
      {"TIFF: unknown compression", tiff_with(259, 3, 54321), 3, ""},
      {"TIFF: strip beyond the end", tiff_with(273, 4, 1000000), 3, ""},
      {"TIFF: no strips", tiff_with(278, 4, 0), 3, ""},
      {"TIFF: complex numbers", tiff({{339, tiff_entry(339, 3, 1, 6)}, {258, tiff_entry(258, 3, 1, 64)}}), 3,
       ""},
      {"TIFF: tiles of 2^31",
       tiff({{322, tiff_entry(322, 4, 1, 0x7ffffff0)},
             {323, tiff_entry(323, 4, 1, 0x7ffffff0)},
             {324, tiff_entry(324, 4, 1, 200)}}),
       3, ""},
      {"TIFF: second page missing", pages.substr(0, pages.size() / 2), 3, ""},
      {"JPEG: start only", jpeg_start, 3, ""},
      {"JPEG: 65535 x 65535 without data", jpeg_size, 3, ""},
      {"JPEG: garbage after the start", jpeg_start + std::string(200, '\x55'), 3, ""},
      {"HDR: title only", "#?RADIANCE\n", 3, ""},
      {"HDR: no size", hdr, 3, ""},
      {"HDR: negative size", hdr + "-Y -4 +X -4\n", 3, ""},
      {"HDR: size that is no number", hdr + "-Y four +X four\n", 3, ""},
      {"HDR: size over the limit", hdr + "-Y 999999 +X 1\n", 4, "--max-side"},
      {"HDR: no pixels", hdr + "-Y 400 +X 400\n", 3, ""},
      {"HDR: run longer than its row",
       hdr + "-Y 1 +X 16\n\x02\x02" + std::string("\0\x10", 2) + std::string(40, '\xff'), 3, ""},
  };
}

std::vector<MalformedImage> strange_rows() {
  std::vector<MalformedImage> rows = {{"empty", "", 3, "is empty"}};
  for (const auto& [name, start] :
       std::vector<std::pair<const char*, std::string>>{{"GIF", "GIF89a"},
                                                        {"BMP", "BM"},
                                                        {"WebP", "RIFF\x10\0\0\0WEBP"},
                                                        {"Photoshop", "8BPS"},
                                                        {"DPX", "SDPX"},
                                                        {"DPX, other way round", "XPDS"},
                                                        {"Cineon", "\x80\x2a\x5f\xd7"},
                                                        {"PNM", "P6\n4 4\n255\n"},
                                                        {"SGI", "\x01\xda"},
                                                        {"FITS", "SIMPLE  ="},
                                                        {"JPEG 2000", std::string("\0\0\0\x0cjP  ", 8)},
                                                        {"Targa", std::string("\0\0\x02\0", 4)},
                                                        {"program",
                                                         "\x7f"
                                                         "ELF"},
                                                        {"PDF", "%PDF-1.7"},
                                                        {"zip", "PK\x03\x04"},
                                                        {"script", "#!/bin/sh\n"}})
    rows.push_back({name, start + std::string(64, '\0'), 3, "is not an image"});
  rows.push_back({"HEIC",
                  std::string("\0\0\0\x18"
                              "ftypheic",
                              12) +
                      std::string(64, '\0'),
                  3, "is HEIF"});
  rows.push_back({"three bytes", "abc", 3, "is not an image"});
  return rows;
}

void check_all(const std::vector<MalformedImage>& rows, const char* what) {
  const std::string folder = work_folder("malformed");
  long wrong = 0;
  for (const MalformedImage& row : rows) {
    const std::string file = folder + "/in";
    std::ofstream(file, std::ios::binary) << row.bytes;
    Attempt it;
    it.arguments = {"apply", file, "-o", folder + "/out.exr", "--adaptation", "0.1", "-q"};
    // What a header merely says must not be allocated: the pictures are tiny, the limit is not.
    it.address_space = 1l << 30;
    const Ended ended = run(it);
    std::string broken = broken_report(ended, {row.code});
    if (broken.empty() && ended.err.find(row.says) == std::string::npos) broken = "says " + ended.err;
    if (broken.empty() && files_in(folder).size() != 1) broken = "wrote";
    wrong += !broken.empty();
    EXPECT_EQ(broken, "") << row.fault;
    fs::remove(folder + "/out.exr");
  }
  tally(what, static_cast<long>(rows.size()), "refused (3; 4 over a limit) in 1 GiB",
        wrong == 0 ? "as expected" : "WRONG " + std::to_string(wrong));
}

TEST(MalformedImages, openexr) {
  Attempt sound;
  const std::string file = work_folder("sound") + "/in";
  std::ofstream(file, std::ios::binary) << Exr().bytes();
  sound.arguments = {"apply", file, "-o", file + ".exr", "--adaptation", "0.1", "-q"};
  ASSERT_EQ(run(sound).exit_code, 0) << "without a fault it is taken";
  check_all(exr_rows(), "malformed OpenEXR files, one fault each");
}

TEST(MalformedImages, tiff_png_jpeg_hdr) {
  for (const auto& [bytes, name] : {std::pair{tiff(), "TIFF"}}) {
    Attempt sound;
    const std::string file = work_folder("sound") + "/in";
    std::ofstream(file, std::ios::binary) << bytes;
    sound.arguments = {"apply", file, "-o", file + ".exr", "--adaptation", "0.1", "-q"};
    ASSERT_EQ(run(sound).exit_code, 0) << name;
  }
  check_all(other_rows(), "malformed TIFF, PNG, JPEG and HDR files, one fault each");
}

TEST(MalformedImages, other_formats_are_not_opened) {
  check_all(strange_rows(), "formats that are not opened");
}

}  // namespace
}  // namespace scotopic::test
