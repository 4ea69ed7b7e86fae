// HDR pictures that are an SDR rendition and a gain map: the rendition is read, the map left out, which is
// said.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <fstream>

#include "files/brothers/table.h"
#include "support/file_bytes.h"

namespace scotopic {
namespace {

using test::bytes_of;
using test::with_segment;

std::string jpeg() {
  test::write_flat_oiio(test::place("plain.jpg"), {0.5f, 0.25f, 0.75f}, false, "");
  return bytes_of(test::place("plain.jpg"));
}

std::string xmp(const std::string& properties) {
  return std::string("http://ns.adobe.com/xap/1.0/\0", 29) +
         "<x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF "
         "xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'>"
         "<rdf:Description " +
         properties + "/></rdf:RDF></x:xmpmeta>";
}

/// Both images of a Multi-Picture Format (CIPA DC-007): an index with tag 0xb002 alone.
std::string multi_picture(const std::string& first, const std::string& second) {
  const auto index = [](std::uint32_t size, std::uint32_t offset, std::uint32_t size_of_second) {
    const auto n = [](std::uint32_t value, int bytes = 4) { return test::big_endian(value, bytes); };
    return std::string("MPF\0MM\0*", 8) + n(8) + n(1, 2) + n(0xb002, 2) + n(7, 2) + n(32) + n(26) + n(0) +
           n(0x20030000) + n(size) + n(0) + n(0) + n(0) + n(size_of_second) + n(offset) + n(0);
  };
  const std::string all = with_segment(first, '\xe2', index(0, 0, 0));
  const auto size = static_cast<std::uint32_t>(all.size());
  // Offsets count from behind "MPF\0", which is at byte 6.
  return with_segment(first, '\xe2', index(size, size - 10, static_cast<std::uint32_t>(second.size()))) +
         second;
}

struct Case {
  const char* what;
  std::string bytes;
  const char* extension;
};

std::vector<Case> pictures() {
  const std::string plain = jpeg();
  const std::string adobe = xmp("xmlns:hdrgm='http://ns.adobe.com/hdr-gain-map/1.0/' hdrgm:Version='1.0'");
  const std::string apple =
      xmp("xmlns:apdi='http://ns.apple.com/pixeldatainfo/1.0/' "
          "apdi:AuxiliaryImageType='urn:com:apple:photo:2020:aux:hdrgainmap'");
  const std::string iso = std::string("urn:iso:std:iso:ts:21496:-1\0\0\0\0\0", 32);
  const std::string png = test::flat_png({9000, 8000, 7000}, {{"gmAP", "x"}, {"gdAT", "y"}});
  return {{"Adobe's XMP", with_segment(plain, '\xe1', adobe), "jpg"},
          {"ISO 21496-1", with_segment(plain, '\xe2', iso), "jpg"},
          {"Adobe's, in the second image", multi_picture(plain, with_segment(plain, '\xe1', adobe)), "jpg"},
          {"ISO's, in the second image", multi_picture(plain, with_segment(plain, '\xe2', iso)), "jpg"},
          {"Apple's, in the second image", multi_picture(plain, with_segment(plain, '\xe1', apple)), "jpg"},
          {"PNG's", png, "png"}};
}

TEST(GainMaps, are_left_out_of_every_output_and_that_is_said) {
  for (const Case& c : pictures()) {
    const std::string in = test::place(std::string("in.") + c.extension);
    test::write_bytes(in, c.bytes);
    for (const char* name : {"out.jpg", "out.png", "out.tif", "out.exr"}) {
      const test::Run done = test::apply(in, test::place(name), {"--adaptation", "0.1"});
      ASSERT_EQ(done.exit_code, 0) << c.what << done.err;
      EXPECT_NE(done.err.find("its gain map is left out"), std::string::npos) << c.what << done.err;
      const std::string out = bytes_of(test::place(name));
      for (const char* sign : {"hdrgm", "hdrgainmap", "21496", "MPF", "gmAP", "gdAT"})
        EXPECT_EQ(out.find(sign), std::string::npos) << c.what << " " << name << " " << sign;
    }
  }
}

TEST(GainMaps, what_is_read_is_the_rendition) {
  const std::string plain = jpeg();
  ASSERT_EQ(test::apply(test::place("plain.jpg"), test::place("plain.exr")).exit_code, 0);
  for (const Case& c : pictures()) {
    if (c.extension != std::string("jpg")) continue;
    test::write_bytes(test::place("in.jpg"), c.bytes);
    ASSERT_EQ(test::apply(test::place("in.jpg"), test::place("out.exr")).exit_code, 0);
    EXPECT_EQ(test::pixel_of(test::place("out.exr"), {"R", "G", "B"}),
              test::pixel_of(test::place("plain.exr"), {"R", "G", "B"}))
        << c.what;
  }
}

TEST(GainMaps, other_images_behind_the_first_are_said_to_be_left_out) {
  const std::string plain = jpeg();
  test::write_bytes(test::place("in.jpg"), multi_picture(plain, plain));
  const test::Run done = test::apply(test::place("in.jpg"), test::place("out.exr"));
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_NE(done.err.find("1 more images of its Multi-Picture Format are left out"), std::string::npos)
      << done.err;
  EXPECT_EQ(done.err.find("gain map"), std::string::npos) << done.err;
}

TEST(GainMaps, an_index_that_points_anywhere_does_no_harm) {
  const std::string plain = jpeg();
  const std::string whole = multi_picture(plain, plain);
  for (std::size_t at = 6; at < 70; at += 5)
    for (const char value : {'\0', '\x7f', '\xff'}) {
      std::string bytes = whole;
      bytes[at] = value;
      test::write_bytes(test::place("in.jpg"), bytes);
      EXPECT_EQ(test::apply(test::place("in.jpg"), test::place("out.exr"), {"-q"}).exit_code, 0) << at;
    }
}

TEST(GainMaps, heif_is_refused_by_its_name) {
  for (const char* brand : {"heic", "mif1", "avif"}) {
    test::write_bytes(test::place("in.heic"), test::big_endian(24) + "ftyp" + brand + std::string(12, '\0'));
    const test::Run done = test::apply(test::place("in.heic"), test::place("out.exr"));
    EXPECT_EQ(done.exit_code, 3);
    EXPECT_NE(done.err.find("is HEIF, AVIF"), std::string::npos) << done.err;
  }
}

TEST(GainMaps, photo_spheres_are_panoramas_where_they_are_whole) {
  const std::string plain = jpeg();
  const auto sphere = [&](const std::string& full, const std::string& cropped) {
    const std::string properties =
        "xmlns:GPano='http://ns.google.com/photos/1.0/panorama/' "
        "GPano:ProjectionType='equirectangular' GPano:FullPanoWidthPixels='" +
        full + "' GPano:CroppedAreaImageWidthPixels=\"" + cropped + "\"";
    test::write_bytes(test::place("in.jpg"), with_segment(plain, '\xe1', xmp(properties)));
    return test::apply(test::place("in.jpg"), test::place("out.exr"),
                       {"--adaptation", "0.01", "--effects", "detail"})
        .err;
  };
  EXPECT_NE(sphere("8", "8").find("a panorama: 360 degrees wide"), std::string::npos) << sphere("8", "8");
  EXPECT_EQ(sphere("16", "8").find("a panorama: 360 degrees wide"), std::string::npos);
}

}  // namespace
}  // namespace scotopic
