// The shipped config in the programs that people load it into. A program that is not installed is skipped
// with a notice; what it should give is what the OCIO library gives, 2e-6 apart at most on the CPU where both
// are of one release.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "looks/lut/shipped_looks.h"
#include "clients/host.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic::test {
namespace {

// Between releases: what 2.1 and 2.6 give in the dark, with the optimisations of each.
const double cpu_tolerance = programs_have_this_ocio() ? 2e-6 : 2e-3;
const double gpu_tolerance = programs_have_this_ocio() ? 1e-4 : 2e-3;

/// Runs, and compares the file it must have written.
void expect_output(const std::string& what, const std::string& command, const std::string& file,
                   const Pixels& wanted, double tolerance = cpu_tolerance) {
  const Finished result = run(command);
  ASSERT_EQ(result.exit_code, 0) << command << "\n" << result.said;
  EXPECT_LE(worst_difference(what, read_pixels(file), wanted), tolerance) << command;
}

std::string oiiotool(const std::string& operations, const std::string& file) {
  return "oiiotool --colorconfig " + quoted(config_file()) + " " + quoted(test_image()) + " " + operations +
         " -d float --compression none -o " + quoted(file);
}

std::string ociolook(const std::string& options, const std::string& look) {
  return "--ociolook:from=" + quoted("\"" + linear + "\"") + ":to=" + quoted("\"" + linear + "\"") +
         ":unpremult=0" + options + " " + quoted(look);
}

TEST(Oiiotool, look) {
  NEEDS("oiiotool");
  for (const std::string& look : {street, moon, night})
    expect_output("oiiotool --ociolook " + look, oiiotool(ociolook("", look), output("a.exr")),
                  output("a.exr"), expected(look_transform(look)));
}

TEST(Oiiotool, the_no_op_look_returns_every_bit) {
  NEEDS("oiiotool");
  expect_output("oiiotool Photopic", oiiotool(ociolook("", "Photopic"), output("b.exr")), output("b.exr"),
                test_pixels(), 0);
}

TEST(Oiiotool, view_of_each_display) {
  NEEDS("oiiotool");
  for (int d = 0; d < config()->getNumDisplays(); ++d)
    for (const std::string& view : {night, std::string("Night 0.001 nit (starlight)")}) {
      const std::string display = config()->getDisplay(d);
      const std::string operation = "--ociodisplay:from=" + quoted("\"" + linear + "\"") + ":unpremult=0 " +
                                    quoted(display) + " " + quoted(view);
      expect_output("oiiotool " + display + ", " + view, oiiotool(operation, output("c.exr")),
                    output("c.exr"), expected(view_transform(display, view)));
    }
}

TEST(Oiiotool, colour_space) {
  NEEDS("oiiotool");
  const std::string operation = "--colorconvert:unpremult=0 " + quoted(linear) + " " + quoted(moon);
  expect_output("oiiotool --colorconvert", oiiotool(operation, output("d.exr")), output("d.exr"),
                expected(look_transform(moon)));
}

TEST(Oiiotool, context_value_and_environment_choose_the_luminance) {
  NEEDS("oiiotool");
  const std::string look = "Mesopic by SCOTOPIC_LA";
  expect_output("default", oiiotool(ociolook("", look), output("e.exr")), output("e.exr"),
                expected(look_transform(street)));
  expect_output("key and value", oiiotool(ociolook(":key=SCOTOPIC_LA:value=0.01", look), output("e.exr")),
                output("e.exr"), expected(look_transform(moon)));
  expect_output("environment", "SCOTOPIC_LA=0.01 " + oiiotool(ociolook("", look), output("e.exr")),
                output("e.exr"), expected(look_transform(moon)));
}

TEST(Oiiotool, a_context_value_without_a_file_is_an_error_and_no_crash) {
  NEEDS("oiiotool");
  const Finished result =
      run("SCOTOPIC_LA=0.0123 " + oiiotool(ociolook("", "Mesopic by SCOTOPIC_LA"), output("none.exr")));
  EXPECT_NE(result.exit_code, 0);
  EXPECT_LT(result.exit_code, 124) << result.said;
  EXPECT_FALSE(std::filesystem::exists(output("none.exr")));
}

std::string ocioconvert(const std::string& options, const std::string& to, const std::string& file) {
  return "OCIO=" + quoted(config_file()) + " ocioconvert " + options + " " + quoted(test_image()) + " " +
         quoted(linear) + " " + quoted(file) + " " + to;
}

TEST(Ocioconvert, space_and_view) {
  NEEDS("ocioconvert");
  expect_output("ocioconvert space", ocioconvert("", quoted(street), output("f.exr")), output("f.exr"),
                expected(look_transform(street)));
  expect_output("ocioconvert --view",
                ocioconvert("--view", quoted(srgb) + " " + quoted(night), output("g.exr")), output("g.exr"),
                expected(view_transform(srgb, night)));
}

TEST(Ocioconvert, glsl_on_the_gpu_agrees_with_the_cpu) {
  NEEDS("ocioconvert");
  NEEDS("xvfb-run");
  for (const std::string& look : {street, moon}) {
    const std::string file = output("gpu.exr");
    const std::string command =
        "export OCIO=" + quoted(config_file()) + "; LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a ocioconvert --gpu " +
        quoted(test_image()) + " " + quoted(linear) + " " + quoted(file) + " " + quoted(look);
    expect_output("ocioconvert --gpu " + look, command, file, expected(look_transform(look)), gpu_tolerance);
  }
}

TEST(Ociocheck, is_clean_for_every_luminance) {
  NEEDS("ociocheck");
  for (const NamedAdaptation& step : named_adaptations) {
    const Finished result = run("SCOTOPIC_LA=" + adaptation_text(step.adaptation) + " ociocheck --iconfig " +
                                quoted(config_file()));
    EXPECT_EQ(result.exit_code, 0) << result.said;
    EXPECT_EQ(result.said.find("ERROR"), std::string::npos);
  }
}

TEST(Ociochecklut, reads_every_lut_and_leaves_black_black) {
  NEEDS("ociochecklut");
  for (const auto& entry : std::filesystem::directory_iterator(SCOTOPIC_SOURCE_DIR "/luts")) {
    if (entry.path().extension() != ".clf") continue;
    const Finished result = run("ociochecklut " + quoted(entry.path().string()) + " 0 0 0");
    EXPECT_EQ(result.exit_code, 0) << result.said;
    EXPECT_NE(result.said.find("0 0 0"), std::string::npos) << result.said;
  }
}

TEST(Ociobakelut, bakes_a_display_cube_out_of_our_config) {
  NEEDS("ociobakelut");
  const std::string file = output("baked.cube");
  const Finished result = run("ociobakelut --iconfig " + quoted(config_file()) +
                              " --inputspace ACEScct --outputspace " + quoted(srgb) + " --looks " +
                              quoted(street) + " --format resolve_cube --cubesize 17 " + quoted(file));
  EXPECT_EQ(result.exit_code, 0) << result.said;
  std::ifstream cube(file);
  std::string text((std::istreambuf_iterator<char>(cube)), std::istreambuf_iterator<char>());
  EXPECT_NE(text.find("LUT_3D_SIZE 17"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

/// Debian's modules belong to the system's Python, which need not be the first on the path.
std::string python() { return std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3"; }

bool have_module(const std::string& module) {
  return run(python() + " -c " + quoted("import " + module)).exit_code == 0;
}

TEST(Python, pyopencolorio_runs_look_and_view) {
  if (!have_module("PyOpenColorIO")) GTEST_SKIP() << "NOTICE: python3-pyopencolorio is not installed";
  const float* p = &test_pixels()[4 * 77];
  const std::string script =
      "import PyOpenColorIO as o\n"
      "c = o.Config.CreateFromFile('" +
      config_file() +
      "')\n"
      "c.validate()\n"
      "t = o.LookTransform('" +
      linear + "', '" + linear + "', '" + street +
      "', False)\n"
      "print('%.9g %.9g %.9g' % tuple(c.getProcessor(t).getDefaultCPUProcessor().applyRGB([" +
      std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) +
      "])))\n"
      "c.getProcessor('" +
      linear + "', '" + srgb + "', '" + night + "', o.TRANSFORM_DIR_FORWARD)\n";
  const Finished result = run(python() + " -c " + quoted(script));
  ASSERT_EQ(result.exit_code, 0) << result.said;
  float rgb[3] = {std::stof(std::to_string(p[0])), std::stof(std::to_string(p[1])),
                  std::stof(std::to_string(p[2]))};
  config()->getProcessor(look_transform(street))->getDefaultCPUProcessor()->applyRGB(rgb);
  float got[3] = {};
  ASSERT_EQ(std::sscanf(result.said.c_str(), "%f %f %f", &got[0], &got[1], &got[2]), 3) << result.said;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(got[c], rgb[c], cpu_tolerance * static_cast<double>(std::abs(rgb[c])));
}

TEST(Python, openimageio_runs_the_look) {
  if (!have_module("OpenImageIO")) GTEST_SKIP() << "NOTICE: python3-openimageio is not installed";
  const std::string file = output("py.exr");
  const std::string script =
      "import OpenImageIO as o\nb = o.ImageBuf('" + test_image() + "')\nr = o.ImageBufAlgo.ociolook(b, '" +
      street + "', '" + linear + "', '" + linear + "', unpremult=False, colorconfig='" + config_file() +
      "')\nr.specmod().attribute('compression', 'none')\nassert r.write('" + file + "', o.FLOAT)\n";
  expect_output("OpenImageIO for Python", python() + " -c " + quoted(script), file,
                expected(look_transform(street)));
}

TEST(Ffmpeg, lut3d_reads_our_cube) {
  NEEDS("ffmpeg");
  NEEDS("oiiotool");
  const std::string cube = output("moon.cube"), in = output("chart.png"), out = output("seen.png"),
                    own = output("own.png");
  const Finished baked = run(std::string(SCOTOPIC_PROGRAM) +
                             " bake -q --adaptation 0.1 --colorspace 'sRGB - Texture' -o " + quoted(cube));
  ASSERT_EQ(baked.exit_code, 0) << baked.said;
  const Finished chart =
      run("oiiotool --pattern fill:topleft=1,0,0:topright=0,1,0:bottomleft=0,0,1:bottomright=1,1,1 64x64 3 "
          "-d uint16 -o " +
          quoted(in));
  ASSERT_EQ(chart.exit_code, 0) << chart.said;
  // ffmpeg splits its options at colons and commas: a plain relative name has none.
  const Finished seen = run("cd " + quoted(work_folder()) +
                            " && ffmpeg -v error -y -i chart.png -vf "
                            "format=gbrp16le,lut3d=moon.cube:interp=tetrahedral -pix_fmt rgb48be seen.png");
  ASSERT_EQ(seen.exit_code, 0) << seen.said;
  const Finished ocio =
      run("oiiotool --colorconfig " + quoted(config_file()) + " " + quoted(in) +
          " --ociofiletransform:unpremult=0 " + quoted(cube) + " -d uint16 -o " + quoted(own) +
          " && oiiotool --fail 0.004 --warn 0.004 --diff " + quoted(out) + " " + quoted(own));
  EXPECT_EQ(ocio.exit_code, 0) << ocio.said;
}

// 200 MB to install: only where SCOTOPIC_TEST_BLENDER is set.
class Blender : public testing::Test {
 protected:
  /// Runs a script that sees the test image as `i`, the scene as `s`, and leaves 16-bit PNG pixels in `file`;
  /// compares them, without alpha, with what is wanted, cut to 0..1.
  void expect_picture(const std::string& body, const std::string& file, const Pixels& wanted) {
    const std::string script = output("blender.py");
    std::ofstream(script) << "import bpy\ns = bpy.context.scene\n"
                          << "i = bpy.data.images.load('" << test_image() << "')\n"
                          << "i.colorspace_settings.name = '" << linear << "'\n"
                          << "s.display_settings.display_device = '" << srgb << "'\n"
                          << "f = s.render.image_settings\n"
                          << "f.file_format, f.color_depth, f.color_mode = 'PNG', '16', 'RGBA'\n"
                          << body;
    const Finished result = run("OCIO=" + quoted(config_file()) +
                                " blender -b --factory-startup --python-exit-code 9 -P " + quoted(script));
    ASSERT_EQ(result.exit_code, 0) << result.said;
    const Pixels got = read_pixels(file);
    ASSERT_EQ(got.size(), wanted.size()) << result.said;
    double worst = 0;
    for (std::size_t i = 0; i < got.size(); i += 4) {
      if (test_pixels()[i + 3] < 1) continue;  // Blender and PNG have views of their own on alpha
      for (std::size_t c = 0; c < 3; ++c)
        worst =
            std::max(worst, static_cast<double>(std::abs(got[i + c] - std::clamp(wanted[i + c], 0.f, 1.f))));
    }
    std::printf("Blender: worst difference %.3g of full scale\n", worst);
    EXPECT_LE(worst, 2e-4);
  }

  void SetUp() override {
    if (!std::getenv("SCOTOPIC_TEST_BLENDER"))
      GTEST_SKIP() << "NOTICE: set SCOTOPIC_TEST_BLENDER=1 to test with Blender";
    NEEDS("blender");
  }
};

TEST_F(Blender, shows_the_look_as_view) {
  const std::string file = output("view.png");
  expect_picture("s.view_settings.view_transform = '" + night + "'\ni.save_render('" + file + "', scene=s)\n",
                 file, expected(view_transform(srgb, night)));
}

TEST_F(Blender, composites_through_the_look_s_colour_space) {
  const std::string file = output("space0001.png");
  const std::string body =
      "s.view_settings.view_transform = 'Un-tone-mapped'\n"
      "s.use_nodes = True\nt = s.node_tree\nt.nodes.clear()\n"
      "a = t.nodes.new('CompositorNodeImage')\na.image = i\n"
      "b = t.nodes.new('CompositorNodeConvertColorSpace')\n"
      "b.from_color_space, b.to_color_space = '" +
      linear + "', '" + street +
      "'\n"
      "c = t.nodes.new('CompositorNodeOutputFile')\nc.base_path = '" +
      work_folder() +
      "'\n"
      "c.file_slots[0].path = 'space'\n"
      "c.format.file_format, c.format.color_depth, c.format.color_mode = 'PNG', '16', 'RGBA'\n"
      "t.links.new(a.outputs[0], b.inputs[0])\nt.links.new(b.outputs[0], c.inputs[0])\n"
      "bpy.ops.object.camera_add()\ns.camera = bpy.context.object\n"
      "s.render.resolution_x = s.render.resolution_y = 64\ns.render.resolution_percentage = 100\n"
      "s.render.engine = 'CYCLES'\n"
      "s.cycles.samples = 1\nbpy.ops.render.render()\n";
  OCIO::GroupTransformRcPtr through = OCIO::GroupTransform::Create();
  through->appendTransform(look_transform(street));
  through->appendTransform(view_transform(srgb, "Un-tone-mapped"));
  expect_picture(body, file, expected(through));
}

}  // namespace
}  // namespace scotopic::test
