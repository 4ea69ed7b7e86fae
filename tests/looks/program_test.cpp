// scotopic bake and scotopic check as their users run them.
#include <OpenColorIO/OpenColorIO.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "color/primaries.h"
#include "io/pixel_source.h"
#include "io/pixels/pixel_type.h"
#include "looks/support.h"
#include "cli/run_program.h"
#include "stages/shared/colour_difference.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;
namespace OCIO = OCIO_NAMESPACE;
using test::Outcome;
using test::run_program;

const std::string shipped = std::string(SCOTOPIC_SOURCE_DIR) + "/ocio_config/config.ocio";

class Bake : public testing::Test {
 protected:
  /// Must fail with this code, one line that says why, and nothing written.
  void refuses(int code, std::vector<std::string> arguments, const std::string& why,
               const char* output = "x.clf") {
    arguments.insert(arguments.begin(), "bake");
    arguments.insert(arguments.end(), {"-o", folder_.path(output)});
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(fs::is_empty(folder_.path()));
  }

  test::Folder folder_;
};

TEST_F(Bake, what_makes_no_sense_is_refused_with_its_reason) {
  refuses(2, {}, "--adaptation");
  for (const char* la : {"0", "-1", "nan", "inf", "0.1x", ""})
    refuses(2, {"--adaptation", la}, "--adaptation");
  refuses(2, {"--adaptation", "auto"}, "does not see the image");
  refuses(2, {"--adaptation", "0.1", "--size", "20"}, "--size");
  refuses(2, {"--adaptation", "0.1", "--model", "kirk"}, "--model");
  refuses(2, {"--adaptation", "0.1", "--effects", "acuity"}, "no LUT sees");
  refuses(2, {"--adaptation", "0.1", "--dry-run"}, "--into");
  refuses(2, {"--adaptation", "0.1", "--beside", "kirk2011"}, "--beside");
  refuses(2, {"--adaptation", "0.1", "--luts", "x"}, "--luts");
  refuses(2, {"--adaptation", "0.1", "--max-error", "x"}, "--max-error");
  refuses(2, {"--adaptation", "0.1", "--config", folder_.path("new")}, "one of");
  refuses(2, {"--adaptation", "0.1"}, "no LUT format", "x.lut");
  refuses(6, {"--adaptation", "0.1", "--colorspace", "ACEScctt"}, "did you mean");
  refuses(6, {"--adaptation", "0.1", "--iconfig", folder_.path("none.ocio")}, "none.ocio");
}

TEST_F(Bake, plain_cubes_of_linear_light_are_refused_with_the_reason) {
  refuses(2, {"--adaptation", "0.1"}, "miss", "x.cube");
  refuses(2, {"--adaptation", "0.1"}, "miss", "x.spi3d");
}

TEST_F(Bake, a_bake_worse_than_allowed_fails_and_leaves_nothing) {
  refuses(1, {"--adaptation", "0.1", "--size", "17", "--max-error", "0.1"}, "exceeds");
}

TEST_F(Bake, every_format_comes_out_the_same_twice_and_is_sound) {
  for (const char* name : {"a.clf", "a.ctf", "a.cube", "a.spi3d"}) {
    const std::string file = folder_.path(name);
    std::vector<std::string> arguments = {"bake", "--adaptation", "0.05", "--size", "17", "-o", file};
    if (name[2] == 's' || std::string(name) == "a.cube")
      arguments.insert(arguments.end(), {"--colorspace", "sRGB - Texture"});
    ASSERT_EQ(run_program(arguments).exit_code, 0) << name;
    const std::string first = test::read_text(file);
    ASSERT_EQ(run_program(arguments).exit_code, 0);
    EXPECT_TRUE(test::read_text(file) == first) << name;
    if (name[2] == 's') continue;  // .spi3d has no room for words
    const Outcome checked = run_program({"check", file});
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
    EXPECT_NE(checked.out.find("mean"), std::string::npos);
  }
}

TEST_F(Bake, linear_light_of_other_primaries_is_taken_as_such) {
  const std::string file = folder_.path("cg.clf");
  ASSERT_EQ(run_program({"bake", "--adaptation", "0.1", "--colorspace", "ACEScg", "-o", file}).exit_code, 0);
  EXPECT_NE(test::read_text(file).find("space=ACEScg; gamut=working; xyz_from_rgb=0.65223"),
            std::string::npos)
      << test::read_text(file).substr(0, 1200);
  EXPECT_EQ(run_program({"check", file, "--max-error", "2.5"}).exit_code, 0);
}

// What the planner says of a look is what is baked of it.
TEST_F(Bake, a_look_that_calls_for_nothing_is_a_no_op_and_one_of_chroma_alone_a_matrix) {
  const struct {
    std::vector<std::string> options;
    bool lut, no_op;
  } rows[] = {{{"--adaptation", "4.999"}, true, false},
              {{"--adaptation", "5"}, false, true},
              {{"--adaptation", "5.001"}, false, true},
              {{"--adaptation", "0.01", "--effects", "none"}, false, true},
              {{"--adaptation", "0.01", "--strength", "0"}, false, true},
              {{"--adaptation", "0.01", "--effects", "chroma", "--weight", "global"}, false, false},
              {{"--adaptation", "0.01", "--effects", "chroma"}, true, false},
              {{"--adaptation", "0.01", "--effects", "shift", "--weight", "global"}, true, false}};
  for (const auto& row : rows) {
    // A name of its own: OpenColorIO keeps files by their names.
    const std::string file = folder_.path("plan" + std::to_string(&row - rows) + ".clf");
    std::vector<std::string> arguments = {"bake", "--size", "17", "-o", file};
    arguments.insert(arguments.end(), row.options.begin(), row.options.end());
    const Outcome baked = run_program(arguments);
    ASSERT_EQ(baked.exit_code, 0) << baked.err;
    const std::string text = test::read_text(file);
    EXPECT_EQ(text.find("<LUT3D") != std::string::npos, row.lut) << row.options[1] << text.substr(0, 900);
    EXPECT_EQ(text.find("<Log") != std::string::npos, row.lut);
    const OCIO::FileTransformRcPtr transform = OCIO::FileTransform::Create();
    transform->setSrc(file.c_str());
    const auto processor = OCIO::Config::CreateRaw()->getProcessor(transform)->getDefaultCPUProcessor();
    float pixels[4] = {0.75f, 1e-4f, -0.002f, 0.5f};
    processor->applyRGBA(pixels);
    EXPECT_EQ(pixels[0] == 0.75f && pixels[1] == 1e-4f && pixels[2] == -0.002f, row.no_op) << row.options[1];
    // A matrix is exact: to what float holds. check measures it against the operator.
    if (row.lut) continue;
    const Outcome checked = run_program({"check", file, "--max-error", "0.001"});
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  }
}

/// R, G, B of a file's first row.
std::vector<Vec3<double>> row_of(const std::string& file) {
  const auto source = open_source(file, Limits{});
  Band band;
  source->read(0, 0, 1, band);
  std::vector<Vec3<double>> out(static_cast<std::size_t>(band.width));
  std::vector<float> row(out.size());
  const auto& channels = source->subimages()[0].channels;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::size_t place = std::string("RGB").find(channels[c].name);
    if (place == std::string::npos) continue;
    load_row(band.channels[c].row(0), row.size(), row.data());
    for (std::size_t i = 0; i < row.size(); ++i) out[i][place] = row[i];
  }
  return out;
}

TEST_F(Bake, a_look_holds_the_lamp_that_apply_is_told) {
  const std::vector<std::string> eye = {"--adaptation", "0.1", "--white-luminance", "1",
                                        "--illuminant", "hps", "--adapt-white",     "lamp"};
  const std::string look = folder_.path("hps.clf"), in = folder_.path("in.exr"),
                    out = folder_.path("out.exr");
  std::vector<std::string> bake = {"bake", "--size", "65", "-o", look}, apply = {"apply", in, "-o", out};
  bake.insert(bake.end(), eye.begin(), eye.end());
  apply.insert(apply.end(), eye.begin(), eye.end());
  apply.insert(apply.end(), {"--effects", "shift,luminance,chroma"});
  ASSERT_EQ(run_program(bake).exit_code, 0);
  EXPECT_NE(test::read_text(look).find("of the colour of a lamp"), std::string::npos);
  EXPECT_EQ(run_program({"check", look}).exit_code, 0);
  test::write_picture(in, 512, 8);
  ASSERT_EQ(run_program(apply).exit_code, 0);
  const OCIO::FileTransformRcPtr transform = OCIO::FileTransform::Create();
  transform->setSrc(look.c_str());
  transform->setInterpolation(OCIO::INTERP_TETRAHEDRAL);
  const auto processor = OCIO::Config::CreateRaw()->getProcessor(transform)->getDefaultCPUProcessor();
  const Matrix3<double> xyz = gamut_xyz_matrix("rec709").value();
  const std::vector<Vec3<double>> came = row_of(in), seen = row_of(out);
  double sum = 0, worst = 0, moved = 0;
  for (std::size_t i = 0; i < came.size(); ++i) {
    float pixel[3] = {static_cast<float>(came[i][0]), static_cast<float>(came[i][1]),
                      static_cast<float>(came[i][2])};
    processor->applyRGB(pixel);
    const double d = exposed_difference(xyz * seen[i], xyz * Vec3<double>{pixel[0], pixel[1], pixel[2]});
    sum += d;
    worst = std::max(worst, d);
    moved = std::max(moved, exposed_difference(xyz * seen[i], xyz * came[i]));
  }
  const double mean = sum / static_cast<double>(came.size());
  std::printf("look against apply, sodium: mean %.3f, max %.3f; the lamp moves up to %.1f\n", mean, worst,
              moved);
  EXPECT_LE(mean, 0.2);
  EXPECT_LE(worst, 2.5);
  EXPECT_GE(moved, 3);
}

TEST_F(Bake, d65_is_no_lamp_and_a_shader_has_none) {
  const std::vector<std::string> plain = {"bake", "--adaptation", "0.1", "--size", "17", "-o"};
  std::vector<std::string> a = plain, b = plain;
  a.push_back(folder_.path("a.clf"));
  b.insert(b.end(), {folder_.path("b.clf"), "--adapt-white", "0.3127,0.3290"});
  ASSERT_EQ(run_program(a).exit_code, 0);
  ASSERT_EQ(run_program(b).exit_code, 0);
  EXPECT_TRUE(test::read_text(folder_.path("a.clf")) == test::read_text(folder_.path("b.clf")));
  const Outcome refused =
      run_program({"bake", "--shader", "glsl", "--adapt-white", "0.5266,0.4133", "--colorspace",
                   "Linear Rec.709 (sRGB)", "-o", folder_.path("x.glsl")});
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_NE(refused.err.find("not in a shader"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(folder_.path("x.glsl")));
}

TEST_F(Bake, several_luminances_get_a_file_each) {
  ASSERT_EQ(run_program({"bake", "--adaptation", "0.1", "--adaptation", "0.02", "--size", "17", "-o",
                         folder_.path("n.clf")})
                .exit_code,
            0);
  EXPECT_TRUE(fs::exists(folder_.path("n_0.1.clf")));
  EXPECT_TRUE(fs::exists(folder_.path("n_0.02.clf")));
}

TEST_F(Bake, a_whole_config_is_sound) {
  const Outcome baked =
      run_program({"bake", "-q", "--adaptation", "0.1", "--size", "17", "--config", folder_.path("new")});
  ASSERT_EQ(baked.exit_code, 0) << baked.err;
  EXPECT_EQ(baked.err, "");
  const Outcome checked = run_program({"check", folder_.path("new/config.ocio")});
  EXPECT_EQ(checked.exit_code, 0) << checked.out;
  EXPECT_NE(checked.out.find("/MANIFEST: sound\n"), std::string::npos) << checked.out;
}

TEST_F(Bake, into_shows_first_then_adds_and_keeps_the_original) {
  ASSERT_EQ(run_program({"bake", "-q", "--adaptation", "0.1", "--size", "17", "--config", folder_.path()})
                .exit_code,
            0);
  const std::string config = folder_.path("config.ocio"), before = test::read_text(config);
  const std::vector<std::string> add = {"bake", "--adaptation", "0.02", "--size", "17", "--into", config};
  std::vector<std::string> dry = add;
  dry.push_back("--dry-run");
  const Outcome shown = run_program(dry);
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_NE(shown.out.find("+    name: Mesopic 0.02 nit"), std::string::npos) << shown.out;
  EXPECT_TRUE(test::read_text(config) == before);
  EXPECT_FALSE(fs::exists(folder_.path("luts/scotopic")));

  const Outcome added = run_program(add);
  ASSERT_EQ(added.exit_code, 0) << added.err;
  EXPECT_TRUE(test::read_text(config + ".before_scotopic") == before);
  EXPECT_EQ(run_program({"check", config, "Mesopic 0.02 nit"}).exit_code, 0);
  const Outcome again = run_program(add);
  EXPECT_EQ(again.exit_code, 6);
  EXPECT_NE(again.err.find("Mesopic 0.02 nit"), std::string::npos);
}

TEST(Check, the_shipped_look_is_as_good_as_it_says_and_no_better) {
  const std::string look = "Mesopic 0.1 nit (street lighting)";
  EXPECT_EQ(run_program({"check", shipped, look}).exit_code, 0);
  EXPECT_EQ(run_program({"check", shipped, look, "--max-error", "0.1"}).exit_code, 1);
  EXPECT_EQ(run_program({"check", shipped, "Mesopic 7 nit"}).exit_code, 6);
  EXPECT_EQ(run_program({"check", "/nonexistent.clf"}).exit_code, 3);
}

TEST(Check, on_an_image_the_look_is_the_operator) {
  const test::Folder folder;
  test::write_picture(folder.path("in.exr"), 64, 48);
  const Outcome outcome = run_program({"check", shipped, "Mesopic 0.1 nit (street lighting)", "--image",
                                       folder.path("in.exr"), "--max-error", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  std::printf("%s", outcome.out.c_str());
}

}  // namespace
}  // namespace scotopic
