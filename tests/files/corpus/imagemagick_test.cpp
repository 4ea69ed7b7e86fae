// Files that ImageMagick writes, of every depth, compression, kind of pixel, byte order, profile and
// orientation that it has for a format. What they mean is told from their tags by a reader of the test's own;
// what the values of those without loss were is known besides.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "files/corpus/corpus.h"
#include "support/file_bytes.h"

namespace scotopic {
namespace {

using test::bytes_of;

using test::Meaning;
using test::Sample;
using test::sample_height;
using test::sample_width;
using test::Tally;
using Words = std::vector<std::string>;

std::uint32_t number(const std::string& bytes, std::size_t at) {
  std::uint32_t out = 0;
  for (std::size_t i = at; i < at + 4 && i < bytes.size(); ++i)
    out = out << 8 | static_cast<unsigned char>(bytes[i]);
  return out;
}

/// Runs convert; false where it fails.
bool convert(const Words& words) {
  std::vector<std::string> all = {"convert"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : all) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execvp("convert", argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// What ImageMagick is given: codes of 16 bits that 8 bits hold too, R, G, B or grey, then alpha.
struct Source {
  std::string file;
  Words words;                ///< that read it
  std::vector<float> values;  ///< R, G, B of each pixel
  std::vector<double> alpha;  ///< of each, where there is any
};

Source make_source(bool colour, bool alpha) {
  Source out;
  std::string bytes;
  for (int y = 0; y < sample_height; ++y)
    for (int x = 0; x < sample_width; ++x) {
      std::array<int, 4> codes = {(x * 13 + y * 3) % 256, (x * 5 + y * 21) % 256, (x * 9 + 40) % 256,
                                  64 + 10 * x};
      if (!colour) codes[1] = codes[2] = codes[0];
      const auto put = [&](int code) { bytes += std::string(2, static_cast<char>(code)); };  // 257 n
      for (std::size_t c = 0; c < (colour ? 3u : 1u); ++c) put(codes[c]);
      if (alpha) put(codes[3]), out.alpha.push_back(codes[3] / 255.0);
      for (std::size_t c = 0; c < 3; ++c) out.values.push_back(static_cast<float>(codes[c]) / 255.0f);
    }
  // ImageMagick's raw formats: gray, graya do not exist apart from alpha in all releases, so grey is of three
  // too.
  out.file = test::place(colour ? (alpha ? "source.rgba" : "source.rgb") : "source.gray");
  test::write_bytes(out.file, bytes);
  const std::string format = colour ? (alpha ? "rgba:" : "rgb:") : "gray:";
  out.words = {"-size", std::to_string(sample_width) + "x" + std::to_string(sample_height), "-depth", "16",
               format + out.file};
  return out;
}

/// Of PNG's chunks, in the order of its third edition: iCCP, sRGB, gAMA with cHRM.
Meaning meaning_of_png(const std::string& file, bool profile) {
  const std::string bytes = bytes_of(file);
  Meaning out{0};
  bool srgb = false, gamma = false;
  for (std::size_t at = 8; at + 8 <= bytes.size(); at += number(bytes, at) + 12) {
    const std::string type = bytes.substr(at + 4, 4);
    if (type == "iCCP" && profile) out.profile = test::adobe_profile();
    if (type == "sRGB") srgb = true;
    if (type == "gAMA") out.power = 100000.0 / number(bytes, at + 8);
    gamma = gamma || type == "gAMA";
    if (type == "cHRM")
      for (std::size_t i = 0; i < 8; ++i)
        out.primaries[(i + 6) % 8] = number(bytes, at + 8 + 4 * i) / 100000.0;
  }
  if (srgb) return Meaning{0};
  if (!gamma) out.power = 0;
  return out;
}

/// Of the lines in front of a Radiance picture.
Meaning meaning_of_hdr(const std::string& file) {
  std::istringstream text(bytes_of(file));
  Meaning out;
  for (std::string line; std::getline(text, line) && !line.empty();) {
    if (line.rfind("GAMMA=", 0) == 0) out.power = 1 / std::atof(line.c_str() + 6);
    if (line.rfind("PRIMARIES=", 0) != 0) continue;
    std::istringstream numbers(line.substr(10));
    test::Chromaticities stated{};
    for (double& v : stated) numbers >> v;
    if (stated != test::Chromaticities{}) out.primaries = stated;
  }
  return out;
}

struct Options {
  std::mt19937 random{17};

  std::string one_of(const Words& words) { return words[random() % words.size()]; }
  bool maybe() { return random() % 2 == 0; }
};

/// Words, and what they ask for.
struct Asked {
  Words words;
  bool colour = true, alpha = false, profile = false;
  int orientation = 1, bits = 8;

  std::string text() const {
    std::string out = colour ? (alpha ? "rgba" : "rgb") : "grey";
    for (const std::string& word : words) out += " " + word;
    return out + (profile ? " with a profile" : "");
  }
};

/// Whether alpha was written as it was given: ImageMagick 7 multiplies associated planes by it again and
/// again, itself included.
bool keeps_alpha(const std::string& file, const Source& source) {
  const std::vector<double> got = test::alpha_in(file);
  if (got.size() != source.alpha.size()) return false;
  for (std::size_t i = 0; i < got.size(); ++i)
    if (std::abs(got[i] - source.alpha[i]) > 0.003) return false;
  return true;
}

/// Writes it and judges it; `lossless`: the values are known.
void make(const Asked& asked, const std::string& target, const std::string& file,
          Meaning (*meaning)(const Asked&, const std::string&), bool lossless, Tally& tally) {
  const Source source = make_source(asked.colour, asked.alpha);
  Words words = source.words;
  if (asked.profile) {
    test::write_bytes(test::place("adobe.icc"), test::adobe_profile());
    // Given to a picture without one it is attached, not converted to.
    words.insert(words.end(), {"-profile", test::place("adobe.icc")});
  }
  words.insert(words.end(), asked.words.begin(), asked.words.end());
  words.push_back(target);
  if (!convert(words) || (asked.alpha && !keeps_alpha(file, source))) return;
  Sample sample{file, target.substr(0, target.find(':')) + " " + asked.text(), meaning(asked, file),
                asked.orientation};
  if (lossless && !asked.alpha) {
    sample.values = source.values;
    sample.step = asked.bits == 8 ? 0.6 / 255 : 0.6 / 65535;
  }
  judge(sample, tally);
}

void tiffs(Options& o, Tally& tally) {
  static const std::map<std::string, int> orientations = {
      {"TopLeft", 1}, {"TopRight", 2}, {"BottomRight", 3}, {"BottomLeft", 4},
      {"LeftTop", 5}, {"RightTop", 6}, {"RightBottom", 7}, {"LeftBottom", 8}};
  for (int i = 0; i < 160; ++i) {
    Asked asked;
    asked.colour = i % 4 != 0;
    asked.alpha = asked.colour && o.maybe();
    asked.profile = o.maybe() && asked.colour;
    asked.bits = o.maybe() ? 8 : 16;
    const std::string turned = o.one_of({"TopLeft", "TopRight", "BottomRight", "BottomLeft", "LeftTop",
                                         "RightTop", "RightBottom", "LeftBottom"});
    asked.orientation = orientations.at(turned);
    asked.words = {"-depth",    std::to_string(asked.bits),
                   "-compress", o.one_of({"None", "LZW", "Zip", "RLE"}),
                   "-orient",   turned,
                   "-define",   "tiff:endian=" + o.one_of({"lsb", "msb"})};
    const auto add = [&](const Words& more) {
      asked.words.insert(asked.words.end(), more.begin(), more.end());
    };
    if (asked.alpha) add({"-define", "tiff:alpha=" + o.one_of({"associated", "unassociated"})});
    if (o.maybe()) add({"-define", "tiff:tile-geometry=16x16"});
    if (o.maybe()) add({"-interlace", "plane"});
    if (asked.bits == 8 && !asked.alpha && asked.colour && i % 5 == 0) add({"-type", "Palette"});
    const std::string big = o.maybe() ? "TIFF64:" : "TIFF:";
    make(
        asked, big + test::place("in.tif"), test::place("in.tif"),
        [](const Asked& a, const std::string&) {
          Meaning out{0};
          if (a.profile) out.profile = test::adobe_profile();
          return out;
        },
        true, tally);
  }
}

void pngs(Options& o, Tally& tally) {
  for (int i = 0; i < 120; ++i) {
    Asked asked;
    asked.colour = i % 4 != 0;
    asked.alpha = asked.colour && o.maybe();
    asked.profile = asked.colour && o.maybe();
    asked.bits = o.maybe() ? 8 : 16;
    asked.words = {"-depth", std::to_string(asked.bits), "-interlace", o.one_of({"None", "PNG"})};
    const std::string excluded = o.one_of({"", "sRGB", "gAMA", "cHRM", "gAMA,cHRM", "all"});
    // "all" leaves out iCCP too: the meaning is told from what is there.
    if (!excluded.empty())
      asked.words.insert(asked.words.end(), {"-define", "png:exclude-chunks=" + excluded});
    const bool palette = asked.bits == 8 && !asked.alpha && i % 6 == 1;
    make(
        asked, (palette ? "PNG8:" : "PNG:") + test::place("in.png"), test::place("in.png"),
        [](const Asked& a, const std::string& file) { return meaning_of_png(file, a.profile); }, !palette,
        tally);
  }
}

void jpegs(Options& o, Tally& tally) {
  for (int i = 0; i < 60; ++i) {
    Asked asked;
    asked.colour = i % 4 != 0;
    asked.profile = asked.colour && o.maybe();
    asked.words = {"-quality",         o.one_of({"75", "95", "100"}),
                   "-sampling-factor", o.one_of({"1x1", "2x1", "2x2"}),
                   "-interlace",       o.one_of({"None", "JPEG"})};
    make(
        asked, "JPEG:" + test::place("in.jpg"), test::place("in.jpg"),
        [](const Asked& a, const std::string&) {
          Meaning out{0};
          if (a.profile) out.profile = test::adobe_profile();
          return out;
        },
        false, tally);
  }
}

void hdrs(Options& o, Tally& tally) {
  for (int i = 0; i < 24; ++i) {
    Asked asked;
    asked.colour = i % 4 != 0;
    if (o.maybe()) asked.words = {"-colorspace", "RGB"};
    if (o.maybe())
      asked.words.insert(asked.words.end(), {"-set", "gamma", o.one_of({"1.0", "0.5", "0.45455"})});
    make(
        asked, "HDR:" + test::place("in.hdr"), test::place("in.hdr"),
        [](const Asked&, const std::string& file) { return meaning_of_hdr(file); }, false, tally);
  }
}

/// Pixels that are no R, G, B.
void others(Tally& tally) {
  const Source source = make_source(true, false);
  for (const char* space : {"CMYK", "Lab", "YCbCr"})
    for (const char* target : {"TIFF", "JPEG"}) {
      if (target == std::string("JPEG") && space == std::string("Lab")) continue;
      const std::string file = test::place("in.img");
      Words words = source.words;
      words.insert(words.end(), {"-colorspace", space, std::string(target) + ":" + file});
      if (!convert(words)) continue;
      judge({file, std::string(target) + " of " + space, {0}}, tally);
    }
}

TEST(Corpus, files_of_imagemagick_are_read_right_or_refused) {
  Options options;
  Tally all;
  const std::vector<std::pair<const char*, void (*)(Options&, Tally&)>> kinds = {
      {"TIFF", tiffs}, {"PNG", pngs}, {"JPEG", jpegs}, {"HDR", hdrs}};
  for (const auto& [name, files] : kinds) {
    Tally tally;
    files(options, tally);
    test::close((std::string("ImageMagick's ") + name).c_str(), tally);
    EXPECT_GT(tally.right, 9 * tally.files / 10) << name;
    all.files += tally.files;
  }
  Tally tally;
  others(tally);
  test::close("ImageMagick's others", tally);
  EXPECT_GE(tally.refused, 3);
  EXPECT_GT(all.files, 300);
}

}  // namespace
}  // namespace scotopic
