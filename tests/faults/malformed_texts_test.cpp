// Configs, LUTs and spectra with one fault each, named for it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "faults/inputs.h"
#include "faults/rig.h"

namespace scotopic::test {
namespace {

namespace fs = std::filesystem;

struct MalformedText {
  const char* fault;
  std::string text;
  int code = 6;
  const char* says = "";
};

std::string repeated(const std::string& text, int count) {
  std::string out;
  for (int i = 0; i < count; ++i) out += text;
  return out;
}

/// A config with one space more, "Odd", and more text at its end.
std::string config_text(
    const std::string& transform, const std::string& more = "", const std::string& version = "2",
    const std::string& roles = "  scene_linear: Lin\n  default: Lin\n  aces_interchange: Lin\n") {
  return "ocio_profile_version: " + version + "\nsearch_path: .\nroles:\n" + roles +
         "displays:\n  D:\n    - !<View> {name: V, colorspace: Lin}\n" +
         "colorspaces:\n  - !<ColorSpace>\n    name: Lin\n  - !<ColorSpace>\n    name: Odd\n    "
         "to_scene_reference: " +
         transform + "\n" + more;
}

std::string matrix(const std::string& numbers) { return "!<MatrixTransform> {matrix: [" + numbers + "]}"; }
const std::string unit = "1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1";

/// Each is taken as --config, with --colorspace Odd.
std::vector<MalformedText> config_rows() {
  const std::string good = config_text(matrix(unit));
  return {
      {"empty", ""},
      {"no YAML", "hello, night\n"},
      {"binary", std::string("\0\x01\x02\xff\xfe", 5)},
      {"bracket left open", "ocio_profile_version: [2\n"},
      {"brackets 100000 deep", "a: " + std::string(100000, '[')},
      {"braces 100000 deep", "a: " + repeated("{a: ", 100000)},
      {"tabs for indents", "ocio_profile_version: 2\nroles:\n\tscene_linear: Lin\n"},
      {"a list where a map should be", "- a\n- b\n"},
      {"no version", good.substr(good.find('\n') + 1)},
      {"version 0", config_text(matrix(unit), "", "0")},
      {"version 3", config_text(matrix(unit), "", "3")},
      {"version 2.9", config_text(matrix(unit), "", "2.9")},
      {"version that is no number", config_text(matrix(unit), "", "two")},
      {"cut in the middle", good.substr(0, good.size() / 2)},
      {"no roles", config_text(matrix(unit), "", "2", "")},
      {"no scene_linear", config_text(matrix(unit), "", "2", "  default: Lin\n"), 6, "scene_linear"},
      {"role of a space that is not there", config_text(matrix(unit), "", "2", "  scene_linear: None\n")},
      {"no way to XYZ", config_text(matrix(unit), "", "2", "  scene_linear: Lin\n  default: Lin\n"), 6,
       "interchange"},
      {"no spaces",
       "ocio_profile_version: 2\nroles:\n  scene_linear: Lin\ndisplays:\n  D:\n    - !<View> {name: V, "
       "colorspace: Lin}\n"},
      {"no displays",
       "ocio_profile_version: 2\nroles:\n  scene_linear: Lin\ncolorspaces:\n  - !<ColorSpace>\n    name: "
       "Lin\n"},
      {"two spaces of one name", config_text(matrix(unit), "  - !<ColorSpace>\n    name: Odd\n")},
      {"space without a name", config_text(matrix(unit), "  - !<ColorSpace>\n    family: x\n")},
      {"view of a space that is not there",
       "ocio_profile_version: 2\nroles:\n  scene_linear: Lin\n  default: Lin\n  aces_interchange: "
       "Lin\ndisplays:\n  D:\n    - !<View> {name: V, colorspace: None}\ncolorspaces:\n  - !<ColorSpace>\n   "
       " name: Lin\n"},
      {"unknown transform", config_text("!<WarpTransform> {}")},
      {"matrix of three numbers", config_text(matrix("1, 2, 3"))},
      {"matrix of words", config_text(matrix("a, b, c, d, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1"))},
      {"matrix without inverse", config_text(matrix("0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0"))},
      {"matrix of no numbers", config_text(matrix(".nan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1"))},
      {"matrix of infinities", config_text(matrix(".inf, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1"))},
      {"exponent 0", config_text("!<ExponentTransform> {value: [0, 0, 0, 1]}")},
      {"log of base 1", config_text("!<LogTransform> {base: 1}")},
      {"log of base -2", config_text("!<LogTransform> {base: -2}")},
      {"range inside out",
       config_text(
           "!<RangeTransform> {min_in_value: 1, max_in_value: 0, min_out_value: 0, max_out_value: 1}")},
      {"LUT that is not there", config_text("!<FileTransform> {src: none.clf}")},
      {"LUT without a name", config_text("!<FileTransform> {src: \"\"}")},
      {"LUT that is a folder", config_text("!<FileTransform> {src: .}")},
      {"LUT that is a device", config_text("!<FileTransform> {src: /dev/zero}"), 6, "not a regular file"},
      {"a space that leads to itself", config_text("!<ColorSpaceTransform> {src: Odd, dst: Lin}")},
      {"a space that leads nowhere", config_text("!<ColorSpaceTransform> {src: None, dst: Lin}")},
      {"a look that is not there", config_text("!<LookTransform> {src: Lin, dst: Lin, looks: None}")},
      {"look without a process space", config_text(matrix(unit), "looks:\n  - !<Look>\n    name: L\n")},
      {"look of a space that is not there",
       config_text(matrix(unit), "looks:\n  - !<Look>\n    name: L\n    process_space: None\n")},
      {"unknown built-in", config_text("!<BuiltinTransform> {style: NO_SUCH_STYLE}")},
  };
}

std::string clf(const std::string& nodes, const std::string& head = "compCLFversion=\"3\" id=\"x\"") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<ProcessList " + head + ">\n" + nodes +
         "</ProcessList>\n";
}
std::string lut3d(const std::string& dim, const std::string& numbers) {
  return clf("<LUT3D inBitDepth=\"32f\" outBitDepth=\"32f\"><Array dim=\"" + dim + "\">" + numbers +
             "</Array></LUT3D>\n");
}
std::string lut1d(const std::string& dim, const std::string& numbers) {
  return clf("<LUT1D inBitDepth=\"32f\" outBitDepth=\"32f\"><Array dim=\"" + dim + "\">" + numbers +
             "</Array></LUT1D>\n");
}
const std::string cube_numbers = "0 0 0 0 0 1 0 1 0 0 1 1 1 0 0 1 0 1 1 1 0 1 1 1 ";

struct LutRow {
  const char* fault;
  const char* extension;
  std::string text;
};

/// Each is the LUT of the space "Odd".
std::vector<LutRow> lut_rows() {
  std::string bomb = "<?xml version=\"1.0\"?><!DOCTYPE l [<!ENTITY a \"aaaaaaaaaa\">";
  for (char c = 'b'; c < 'l'; ++c)
    bomb += std::string("<!ENTITY ") + c + " \"" +
            repeated(std::string("&") + static_cast<char>(c - 1) + ";", 10) + "\">";
  bomb += "]><ProcessList id=\"x\" compCLFversion=\"3\"><Description>&k;</Description></ProcessList>";
  const std::string cube = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n";
  std::string spi;
  for (int r = 0; r < 2; ++r)
    for (int g = 0; g < 2; ++g)
      for (int b = 0; b < 2; ++b) {
        const std::string node = std::to_string(r) + " " + std::to_string(g) + " " + std::to_string(b);
        spi += node + " " + node + "\n";
      }
  return {
      {"empty", "clf", ""},
      {"no XML", "clf", "hello, night\n"},
      {"binary", "clf", std::string("\0\xff\x01", 3)},
      {"cut", "clf", lut3d("2 2 2 3", cube_numbers).substr(0, 150)},
      {"no nodes", "clf", clf("")},
      {"another root", "clf", "<?xml version=\"1.0\"?><Process/>\n"},
      {"no version", "clf", clf("", "id=\"x\"")},
      {"version 9", "clf",
       clf("<Matrix inBitDepth=\"32f\" outBitDepth=\"32f\"><Array dim=\"3 3\">1 0 0 0 1 0 0 0 "
           "1</Array></Matrix>",
           "compCLFversion=\"9\" id=\"x\"")},
      {"entities of 10^10 characters", "clf", bomb},
      {"an external entity", "clf",
       "<?xml version=\"1.0\"?><!DOCTYPE p [<!ENTITY x SYSTEM \"file:///etc/passwd\">]><ProcessList id=\"x\" "
       "compCLFversion=\"3\">&x;</ProcessList>"},
      {"elements 100000 deep", "clf", "<?xml version=\"1.0\"?>" + repeated("<ProcessList>", 100000)},
      {"unknown node", "clf", clf("<Warp inBitDepth=\"32f\" outBitDepth=\"32f\"/>")},
      {"unknown bit depth", "clf",
       clf("<Matrix inBitDepth=\"7\" outBitDepth=\"32f\"><Array dim=\"3 3\">1 0 0 0 1 0 0 0 "
           "1</Array></Matrix>")},
      {"cube of no edge", "clf", lut3d("0 0 0 3", "")},
      {"cube of edge 1", "clf", lut3d("1 1 1 3", "0 0 0")},
      {"cube of edge 130", "clf", lut3d("130 130 130 3", "0 0 0")},
      {"cube of edge 100000", "clf", lut3d("100000 100000 100000 3", "0 0 0")},
      {"cube of edge -2", "clf", lut3d("-2 -2 -2 3", cube_numbers)},
      {"cube of unequal edges", "clf", lut3d("2 3 2 3", cube_numbers)},
      {"cube of four colours", "clf", lut3d("2 2 2 4", cube_numbers)},
      {"too few numbers", "clf", lut3d("2 2 2 3", "0 0 0")},
      {"too many numbers", "clf", lut3d("2 2 2 3", cube_numbers + "5 5 5")},
      {"words for numbers", "clf", lut3d("2 2 2 3", repeated("moon ", 24))},
      {"table of no length", "clf", lut1d("0 3", "")},
      {"table of length -1", "clf", lut1d("-1 3", "0 0 0")},
      {"table of 10^9 entries", "clf", lut1d("1000000000 3", "0 0 0")},
      {"table of five columns", "clf", lut1d("2 5", "0 0 0 0 0 1 1 1 1 1")},
      {"matrix of two rows", "clf",
       clf("<Matrix inBitDepth=\"32f\" outBitDepth=\"32f\"><Array dim=\"2 2\">1 0 0 1</Array></Matrix>")},
      {"matrix of too few numbers", "clf",
       clf("<Matrix inBitDepth=\"32f\" outBitDepth=\"32f\"><Array dim=\"3 3\">1 0 0</Array></Matrix>")},
      {"range inside out", "clf",
       clf("<Range inBitDepth=\"32f\" "
           "outBitDepth=\"32f\"><minInValue>1</minInValue><maxInValue>0</maxInValue><minOutValue>0</"
           "minOutValue><maxOutValue>1</maxOutValue></Range>")},
      {"range of words", "clf",
       clf("<Range inBitDepth=\"32f\" "
           "outBitDepth=\"32f\"><minInValue>dusk</minInValue><minOutValue>0</minOutValue></Range>")},
      {"unknown log", "clf", clf("<Log inBitDepth=\"32f\" outBitDepth=\"32f\" style=\"log7\"/>")},
      {"CTF: empty", "ctf", ""},
      {"CTF: version 99", "ctf",
       "<?xml version=\"1.0\"?><ProcessList version=\"99\" id=\"x\"></ProcessList>"},
      {"cube: empty", "cube", ""},
      {"cube: no size", "cube", cube},
      {"cube: size 1", "cube", "LUT_3D_SIZE 1\n0 0 0\n"},
      {"cube: size -2", "cube", "LUT_3D_SIZE -2\n" + cube},
      {"cube: size 10^9", "cube", "LUT_3D_SIZE 1000000000\n" + cube},
      {"cube: size that is no number", "cube", "LUT_3D_SIZE two\n" + cube},
      {"cube: too few lines", "cube", "LUT_3D_SIZE 3\n" + cube},
      {"cube: too many lines", "cube", "LUT_3D_SIZE 2\n" + cube + "0 0 0\n"},
      {"cube: two numbers a line", "cube", "LUT_3D_SIZE 2\n" + repeated("0 0\n", 8)},
      {"cube: words", "cube", "LUT_3D_SIZE 2\n" + repeated("a b c\n", 8)},
      {"spi3d: empty", "spi3d", ""},
      {"spi3d: another title", "spi3d", "MOON 1.0\n3 3\n2 2 2\n" + spi},
      {"spi3d: no size", "spi3d", "SPILUT 1.0\n3 3\n" + spi},
      {"spi3d: size of 10^6", "spi3d", "SPILUT 1.0\n3 3\n1000000 1000000 1000000\n" + spi},
      {"spi3d: too few lines", "spi3d", "SPILUT 1.0\n3 3\n3 3 3\n" + spi},
      {"spi3d: a node beyond the cube", "spi3d", "SPILUT 1.0\n3 3\n2 2 2\n9 9 9 0 0 0\n" + spi},
      {"spi3d: a node before the cube", "spi3d", "SPILUT 1.0\n3 3\n2 2 2\n-1 0 0 0 0 0\n" + spi},
      {"spi1d: empty", "spi1d", ""},
      {"spi1d: length 0", "spi1d", "Version 1\nFrom 0.0 1.0\nLength 0\nComponents 1\n{\n}\n"},
      {"spi1d: length 10^10", "spi1d",
       "Version 1\nFrom 0.0 1.0\nLength 10000000000\nComponents 1\n{\n0\n}\n"},
      {"spi1d: too few lines", "spi1d", "Version 1\nFrom 0.0 1.0\nLength 4\nComponents 1\n{\n0\n1\n}\n"},
      {"spi1d: no components", "spi1d", "Version 1\nFrom 0.0 1.0\nLength 2\nComponents 0\n{\n0\n1\n}\n"},
      {"unknown extension, no LUT", "lut", "hello, night\n"},
  };
}

/// Each is --illuminant.
std::vector<MalformedText> spectrum_rows() {
  return {
      {"empty", "", 3, "no spectrum"},
      {"no numbers", "hello\nnight\n", 3, "line 2"},
      {"binary", std::string("\0\x01\n\xff\n", 5), 3, "line"},
      {"one row", "500 1\n", 3, "fewer than two rows"},
      {"one column", "500\n510\n", 3, "line 1"},
      {"three columns", "500 1 1\n510 1 1\n", 3, "line 1"},
      {"falling wavelengths", "510 1\n500 1\n", 3, "do not ascend"},
      {"the same wavelength twice", "500 1\n500 1\n", 3, "do not ascend"},
      {"negative wavelength", "-500 1\n500 1\n", 3, "wavelength"},
      {"negative power", "500 1\n510 -1\n", 3, "power"},
      {"power that is no number", "500 1\n510 nan\n", 3, "line 2"},
      {"infinite power", "500 1\n510 inf\n", 3, "line 2"},
      {"decimal comma", "500;1,5\n510;1,5\n", 3, ""},
      {"no visible light", "1000 1\n1100 1\n", 3, "no visible light"},
      {"larger than a spectrum", std::string((1 << 20) + 1, '#'), 4, "1048576"},
  };
}

class MalformedTexts : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = work_folder("texts"); }

  /// What is wrong with how it was refused.
  std::string refused(const std::vector<std::string>& arguments, int code, const std::string& says) {
    Attempt it;
    it.arguments = {"apply", input("in.exr"), "-o", folder_ + "/out.exr", "--adaptation", "0.1", "-q"};
    it.arguments.insert(it.arguments.end(), arguments.begin(), arguments.end());
    it.address_space = 1l << 30;
    const Ended ended = run(it);
    std::string broken = broken_report(ended, {code});
    if (broken.empty() && ended.err.find(says) == std::string::npos) broken = "says " + ended.err;
    if (broken.empty() && fs::exists(folder_ + "/out.exr")) broken = "wrote";
    fs::remove(folder_ + "/out.exr");
    return broken;
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ + "/" + name, std::ios::binary) << text;
  }
  std::string folder_;
};

std::string seen(long wrong) { return wrong == 0 ? "as expected" : "WRONG " + std::to_string(wrong); }

TEST_F(MalformedTexts, configs) {
  write("good.ocio", config_text(matrix(unit)));
  EXPECT_EQ(refused({"--config", folder_ + "/good.ocio", "--colorspace", "Odd"}, 0, ""), "wrote")
      << "without a fault";
  long wrong = 0;
  for (const MalformedText& row : config_rows()) {
    write("bad.ocio", row.text);
    const std::string broken =
        refused({"--config", folder_ + "/bad.ocio", "--colorspace", "Odd"}, row.code, row.says);
    wrong += !broken.empty();
    EXPECT_EQ(broken, "") << row.fault;
  }
  tally("malformed configs, one fault each", static_cast<long>(config_rows().size()), "exit 6, one line",
        seen(wrong));
}

TEST_F(MalformedTexts, luts) {
  write("lut.clf", lut3d("2 2 2 3", cube_numbers));
  write("luts.ocio", config_text("!<FileTransform> {src: lut.clf}"));
  EXPECT_EQ(refused({"--config", folder_ + "/luts.ocio", "--colorspace", "Odd"}, 0, ""), "wrote")
      << "without a fault";
  long wrong = 0;
  for (const LutRow& row : lut_rows()) {
    const std::string name = std::string("bad.") + row.extension;
    write(name, row.text);
    write("luts.ocio", config_text("!<FileTransform> {src: " + name + "}"));
    const std::string broken = refused({"--config", folder_ + "/luts.ocio", "--colorspace", "Odd"}, 6, "");
    wrong += !broken.empty();
    EXPECT_EQ(broken, "") << row.fault;
  }
  tally("malformed LUTs, one fault each", static_cast<long>(lut_rows().size()), "exit 6, one line",
        seen(wrong));
}

TEST_F(MalformedTexts, sizes_over_the_limit) {
  write("lut.clf", lut3d("2 2 2 3", cube_numbers));
  write("luts.ocio", config_text("!<FileTransform> {src: lut.clf}"));
  const std::string luts = folder_ + "/luts.ocio";
  EXPECT_EQ(refused({"--config", luts, "--colorspace", "Odd", "--max-lut-size", "100"}, 4, "--max-lut-size"),
            "");
  EXPECT_EQ(
      refused({"--config", luts, "--colorspace", "Odd", "--max-config-size", "100"}, 4, "--max-config-size"),
      "");
  EXPECT_EQ(refused({"--max-memory", "1000"}, 4, "--max-memory"), "");
}

TEST_F(MalformedTexts, spectra) {
  long wrong = 0;
  for (const MalformedText& row : spectrum_rows()) {
    write("lamp.csv", row.text);
    const std::string broken = refused({"--illuminant", folder_ + "/lamp.csv"}, row.code, row.says);
    wrong += !broken.empty();
    EXPECT_EQ(broken, "") << row.fault;
  }
  tally("malformed spectra, one fault each", static_cast<long>(spectrum_rows().size()),
        "exit 3 (4: too large)", seen(wrong));
}

}  // namespace
}  // namespace scotopic::test
