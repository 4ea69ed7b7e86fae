// Profiles, LUTs, XMP and spectra with random faults: one line, never a crash or an endless wait.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "base/error.h"
#include "color/icc/embedded_profile.h"
#include "color/lut_trial.h"
#include "files/made_files.h"
#include "files/many_runs.h"

namespace scotopic {
namespace {

/// Mutations of a kind: 3 000 in the long form (SCOTOPIC_LONG=1), few in the suite.
int mutations(int usually) { return std::getenv("SCOTOPIC_LONG") ? 3000 : usually; }

TEST(Mutations, mutated_profiles_never_crash) {
  const std::string good = test::adobe_profile();
  std::mt19937 random(7);
  int refused = 0;
  const int count = mutations(3000);
  for (int i = 0; i < count; ++i) {
    std::string bytes = good;
    for (std::uint32_t n = random() % 4 + 1; n > 0; --n)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    if (random() % 8 == 0) bytes.resize(random() % bytes.size());
    const auto* const start = reinterpret_cast<const std::byte*>(bytes.data());
    try {
      const EmbeddedProfile profile({start, start + bytes.size()}, "file");
      float r = 0.5f, g = 0.25f, b = 0.75f;
      profile.to_xyz(&r, &g, &b, 1);
    } catch (const Error&) {
      ++refused;
    }
  }
  std::printf("profiles: %d mutations, %d refused\n", count, refused);
  EXPECT_GT(refused, count / 10);
}

/// A LUT of each kind that OpenColorIO reads as text.
std::vector<std::pair<std::string, std::string>> luts() {
  std::string cube = "LUT_3D_SIZE 2\n", nodes, spi = "SPILUT 1.0\n3 3\n2 2 2\n";
  for (int b = 0; b < 2; ++b)
    for (int g = 0; g < 2; ++g)
      for (int r = 0; r < 2; ++r) {
        const std::string values = std::to_string(r) + " " + std::to_string(g) + " " + std::to_string(b);
        nodes += values + "\n";
        spi += values + " " + values + "\n";
      }
  const std::string csp = "CSPLUTV100\n3D\n\n2\n0 1\n0 1\n2\n0 1\n0 1\n2\n0 1\n0 1\n\n2 2 2\n" + nodes;
  const std::string spi1d = "Version 1\nFrom 0 1\nLength 2\nComponents 1\n{\n0\n1\n}\n";
  const std::string clf =
      "<?xml version=\"1.0\"?><ProcessList id=\"a\" compCLFversion=\"3\"><Matrix inBitDepth=\"32f\" "
      "outBitDepth=\"32f\">"
      "<Array dim=\"3 3\">1 0 0 0 1 0 0 0 1</Array></Matrix></ProcessList>";
  return {{"m.cube", cube + nodes}, {"m.csp", csp}, {"m.spi3d", spi},
          {"m.spi1d", spi1d},       {"m.clf", clf}, {"m.ctf", clf}};
}

TEST(Mutations, mutated_luts_neither_crash_nor_hang) {
  std::mt19937 random(11);
  for (const auto& [name, good] : luts()) {
    EXPECT_NO_THROW(try_lut_file((test::write_bytes(test::place(name), good), test::place(name)))) << name;
    int refused = 0;
    const int count = mutations(40);
    for (int i = 0; i < count; ++i) {
      std::string bytes = good;
      for (std::uint32_t n = random() % 4 + 1; n > 0; --n)
        bytes[random() % bytes.size()] = static_cast<char>(random() % 96 + 32);
      if (random() % 4 == 0) bytes.resize(random() % bytes.size());
      std::filesystem::remove(test::place(name));
      test::write_bytes(test::place(name), bytes);
      try {
        try_lut_file(test::place(name));
      } catch (const Error& e) {
        ++refused;
        EXPECT_TRUE(e.code() == ExitCode::config || e.code() == ExitCode::limit) << e.what();
      }
    }
    std::printf("%s: %d mutations, %d crashed or hung their reader and are refused\n", name.c_str(), count,
                refused);
  }
}

/// A text with some of its bytes changed, a piece doubled or left out, or cut.
std::string mutated(const std::string& good, std::mt19937& random) {
  std::string text = good;
  for (std::uint32_t n = random() % 4 + 1; n > 0; --n) {
    const std::size_t at = random() % text.size(), size = random() % 40;
    switch (random() % 4) {
      case 0:
        text.insert(at, text.substr(random() % text.size(), size));
        break;
      case 1:
        if (size < text.size() / 2) text.erase(at, size);
        break;
      default:
        text[at] = static_cast<char>(random() % 2 ? random() : random() % 96 + 32);
    }
  }
  if (random() % 8 == 0) text.resize(random() % text.size() + 1);
  return text;
}

/// Each ends with one of the program's own codes, within 5 s and 1 GiB; what is refused, in one line. How
/// many are refused.
int expect_orderly(const std::vector<std::vector<std::string>>& runs, const std::vector<std::string>& texts) {
  const std::vector<test::OneOfMany> ends = test::run_many(runs);
  int refused = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const int code = ends[i].exit_code;
    EXPECT_TRUE(code == 0 || code == 3 || code == 4) << texts[i] << ": exit " << code << " " << ends[i].err;
    EXPECT_TRUE(code == 0 || ends[i].one_line) << texts[i] << ": " << ends[i].err;
    refused += code != 0;
  }
  return refused;
}

/// JPEG with XMP in a segment of its own.
std::string with_xmp(std::string jpeg, const std::string& xmp) {
  const std::string body = std::string("http://ns.adobe.com/xap/1.0/\0", 29) + xmp;
  return jpeg.insert(2, "\xff\xe1" + test::big_endian(static_cast<std::uint32_t>(body.size() + 2), 2) + body);
}

TEST(Mutations, mutated_xmp_neither_crashes_nor_hangs) {
  const std::string good =
      "<?xpacket begin='' id='W5M0MpCehiHzreSzNTczkc9d'?><x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF "
      "xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'><rdf:Description rdf:about='' "
      "xmlns:dc='http://purl.org/dc/elements/1.1/' xmlns:tiff='http://ns.adobe.com/tiff/1.0/' "
      "xmlns:GPano='http://ns.google.com/photos/1.0/panorama/' tiff:Orientation='6' xmp:Rating=\"3\" "
      "GPano:ProjectionType='equirectangular'><!-- a > b --><dc:creator><rdf:Seq><rdf:li>A &amp; "
      "B</rdf:li></rdf:Seq></dc:creator><dc:title><rdf:Alt><rdf:li "
      "xml:lang='x-default'><![CDATA[<t>]]></rdf:li>"
      "</rdf:Alt></dc:title><dc:subject><rdf:Bag><rdf:li>night</rdf:li></rdf:Bag></dc:subject>"
      "</rdf:Description></rdf:RDF></x:xmpmeta><?xpacket end='w'?>";
  test::write_flat_oiio(test::place("plain.jpg"), {0.5f, 0.25f, 0.75f}, false, "");
  std::ostringstream plain;
  plain << std::ifstream(test::place("plain.jpg"), std::ios::binary).rdbuf();
  std::mt19937 random(5);
  const int count = mutations(24);
  std::vector<std::vector<std::string>> runs;
  std::vector<std::string> texts;
  for (int i = 0; i < count; ++i) {
    texts.push_back(mutated(good, random));
    const std::string file = test::place("in" + std::to_string(i) + (i % 2 ? ".jpg" : ".png"));
    const test::Chunk chunk = {"iTXt", "XML:com.adobe.xmp" + std::string(5, '\0') + texts.back()};
    test::write_bytes(file, i % 2 ? with_xmp(plain.str(), texts.back()) : test::flat_png({1, 2, 3}, {chunk}));
    runs.push_back({"explain", file, "--white-luminance", "1"});
  }
  std::printf("XMP: %d mutations, %d refused, the others read\n", count, expect_orderly(runs, texts));
}

TEST(Mutations, mutated_spectra_neither_crash_nor_hang) {
  const std::string good =
      "# a lamp\nnm,power\n380,0.5\n400.5;1e-3\n500 1.25\n555\t1.0\n600,2\n650,1\n700,1e0\n780,0.0\n";
  test::write_flat_exr(test::place("in.exr"), {1, 1, 1});
  std::mt19937 random(3);
  const int count = mutations(24);
  std::vector<std::vector<std::string>> runs;
  std::vector<std::string> texts;
  for (int i = 0; i < count; ++i) {
    texts.push_back(mutated(good, random));
    const std::string lamp = test::place("lamp" + std::to_string(i) + ".csv");
    test::write_bytes(lamp, texts.back());
    runs.push_back({"explain", test::place("in.exr"), "--white-luminance", "1", "--illuminant", lamp});
  }
  const int refused = expect_orderly(runs, texts);
  std::printf("spectra: %d mutations, %d refused, the others read\n", count, refused);
  EXPECT_LT(refused, count);
}

TEST(Mutations, a_run_that_dies_is_told_and_the_next_one_goes_on) {
  const std::vector<test::OneOfMany> ends = test::run_many({{"--version"}, {"(crash)"}, {"--version"}});
  ASSERT_EQ(ends.size(), 3u);
  EXPECT_EQ(ends[0].exit_code, 0);
  EXPECT_EQ(ends[1].exit_code, 128 + SIGSEGV);
  EXPECT_EQ(ends[2].exit_code, 0);
}

}  // namespace
}  // namespace scotopic
