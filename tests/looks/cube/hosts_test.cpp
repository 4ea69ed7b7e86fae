// Programs for video and for the command line that take a cube or a Hald image of it.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "looks/cube/cube_hosts.h"

namespace scotopic {
namespace {

using test::CubeHosts;

constexpr double of_16_bits = 2e-5;
// ACEScct's own figures are 0.066 and 0.48, DaVinci Intermediate's 0.078 and 0.79 (tetrahedral).
constexpr double mean = 0.08, p99 = 0.65, davinci_p99 = 0.85;

TEST_F(CubeHosts, ffmpeg_lut3d) {
  NEEDS("ffmpeg");
  const auto with = [](const std::string& reading) {
    return "ffmpeg -v error -y -i in.png -vf format=rgb48,lut3d=file=street.cube:interp=" + reading +
           " -pix_fmt rgb48be out.png";
  };
  expect("ffmpeg lut3d tetrahedral", with("tetrahedral"), {Reading::tetrahedral, of_16_bits, mean, p99});
  expect("ffmpeg lut3d tetrahedral", with("tetrahedral"),
         {Reading::tetrahedral, of_16_bits, mean, davinci_p99}, davinci);
  expect("ffmpeg lut3d trilinear", with("trilinear"), {Reading::trilinear, of_16_bits, mean, p99});
  // Neither is what a cube is fitted for.
  expect("ffmpeg lut3d pyramid", with("pyramid"), {Reading::tetrahedral, 0.004, mean, p99});
  expect("ffmpeg lut3d prism", with("prism"), {Reading::tetrahedral, 0.004, mean, p99});
}

TEST_F(CubeHosts, ffmpeg_haldclut) {
  NEEDS("ffmpeg");
  expect("ffmpeg haldclut of 64 nodes",
         hald() +
             " && ffmpeg -v error -y -i in.png -i hald.png -filter_complex "
             "'[0:v]format=rgb48[a];[1:v]format=rgb48[b];[a][b]haldclut=interp=tetrahedral' -pix_fmt rgb48be "
             "out.png",
         {Reading::tetrahedral, 0.002, mean, p99});
}

TEST_F(CubeHosts, imagemagick_hald) {
  NEEDS("ffmpeg");
  const std::string convert = test::have("magick") ? "magick" : "convert-im6.q16";
  NEEDS(convert);
  const std::string command =
      hald() + " && " + convert + " in.png hald.png -hald-clut -depth 16 -alpha off out.png";
  expect("ImageMagick -hald-clut of 64 nodes", command, {Reading::trilinear, 0.003, mean, p99});
  // Integers hold no nodes below 0: a few dark saturated colours are off, by up to 9.5.
  expect("ImageMagick -hald-clut of 64 nodes", command, {Reading::trilinear, 0.006, mean, 0.95}, davinci);
}

TEST_F(CubeHosts, graphicsmagick_hald) {
  NEEDS("ffmpeg");
  NEEDS("gm");
  expect("GraphicsMagick -hald-clut of 64 nodes",
         hald() + " && gm convert in.png -hald-clut hald.png out.png",
         {Reading::trilinear, 0.003, mean, p99});
}

TEST_F(CubeHosts, gmic_map_clut) {
  NEEDS("gmic");
  // Its codes are 0 to 255. For a code v it reads node v N/256, not v (N - 1)/255 (2.9): with 257 nodes that
  // is the same.
  const std::string command =
      "gmic -v 0 in.png div 257 street.cube r[1] 257,257,257,3,3 map_clut[0] [1] keep[0] mul 257 output "
      "out.tif,ushort";
  expect("G'MIC map_clut of 257 nodes", command, {Reading::trilinear, 5e-5, mean, p99}, acescct, "out.tif");
  expect("G'MIC map_clut of 257 nodes", command, {Reading::trilinear, 5e-5, mean, davinci_p99}, davinci,
         "out.tif");
}

TEST_F(CubeHosts, mlt_avfilter_lut3d_in_8_bits) {
  NEEDS("melt");
  std::ofstream(folder(acescct) + "/square.profile")
      << "description=square\nframe_rate_num=25\nframe_rate_den=1\nwidth=128\nheight=128\nprogressive=1\n"
         "sample_aspect_num=1\nsample_aspect_den=1\ndisplay_aspect_num=1\ndisplay_aspect_den=1\n"
         "colorspace=709\n";
  // Its pictures have 8 bits: half a code in, half a code out, and the operator's slope between.
  expect(
      "MLT avfilter.lut3d tetrahedral",
      "melt -profile ./square.profile in.png out=0 -filter avfilter.lut3d av.file=street.cube "
      "av.interp=tetrahedral -consumer avformat:out.png vcodec=png an=1 mlt_image_format=rgb pix_fmt=rgb24",
      {Reading::tetrahedral, 0.015, 2, 10});
}

}  // namespace
}  // namespace scotopic
