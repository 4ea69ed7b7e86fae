#include "looks/cube/cube_hosts.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

#include "cli/run_program.h"
#include "color/primaries.h"
#include "looks/cube/cube_colours.h"
#include "looks/cube/cubes.h"

namespace scotopic::test {
namespace {

constexpr int side = 128;
constexpr std::size_t edge = 33;

struct Subject {
  std::string folder;
  std::unique_ptr<CubeGoal> goal;
  Colours codes;
};
std::unique_ptr<Folder> files;
std::array<Subject, 2> subjects;

void write(const std::string& file, int width, const std::vector<float>& pixels) {
  const auto out = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(out && out->open(file, OIIO::ImageSpec(width, width, 3, OIIO::TypeDesc::UINT16)));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
  out->close();
}

Colours read(const std::string& file) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in) return {};
  std::vector<float> pixels(static_cast<std::size_t>(side * side * 3));
  EXPECT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data())) << in->geterror();
  Colours out;
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    out.r.push_back(pixels[i]);
    out.g.push_back(pixels[i + 1]);
    out.b.push_back(pixels[i + 2]);
  }
  return out;
}

Subject made(const char* space, const std::string& folder) {
  std::filesystem::create_directory(folder);
  EXPECT_EQ(run_program({"bake", "--adaptation", "0.1", "--colorspace", space, "--size", "33", "-q", "-o",
                         folder + "/street.cube"})
                .exit_code,
            0);
  const ColourConfig config = ColourConfig::own();
  Subject out{folder, std::make_unique<CubeGoal>(cube_spec(space, 0.1, edge), config), {}};
  out.codes = coded_colours(*out.goal, gamut_xyz_matrix("rec709").value(), config.xyz_from_working(),
                            side * side, {cube_darkest, cube_brightest, 0.125})
                  .codes;
  std::vector<float> pixels;
  for (std::size_t i = 0; i < out.codes.size(); ++i)
    for (auto* plane : {&out.codes.r, &out.codes.g, &out.codes.b}) {
      float& code = (*plane)[i];
      code = std::round(code * 65535) / 65535;
      pixels.push_back(code);
    }
  EXPECT_EQ(out.codes.size(), std::size_t{side * side}) << space;
  write(folder + "/in.png", side, pixels);
  return out;
}

/// A .cube file's nodes, blue fastest.
std::vector<double> nodes_of(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line) && line.rfind("LUT_3D_SIZE", 0) != 0) {
  }
  std::vector<double> nodes(3 * edge * edge * edge);
  for (std::size_t b = 0; b < edge; ++b)
    for (std::size_t g = 0; g < edge; ++g)
      for (std::size_t r = 0; r < edge; ++r)
        for (std::size_t c = 0; c < 3; ++c) in >> nodes[3 * ((r * edge + g) * edge + b) + c];
  EXPECT_TRUE(in) << file;
  return nodes;
}

/// The cube as we read it, within the codes that integers hold.
Colours read_here(const Subject& subject, Reading reading) {
  const std::vector<double> nodes = nodes_of(subject.folder + "/street.cube");
  Colours out;
  for (std::size_t i = 0; i < subject.codes.size(); ++i) {
    const Vec3<double> code =
        read_cube(nodes, edge, {subject.codes.r[i], subject.codes.g[i], subject.codes.b[i]}, reading);
    out.r.push_back(static_cast<float>(std::clamp(code[0], 0.0, 1.0)));
    out.g.push_back(static_cast<float>(std::clamp(code[1], 0.0, 1.0)));
    out.b.push_back(static_cast<float>(std::clamp(code[2], 0.0, 1.0)));
  }
  return out;
}

double worst_code(const Colours& a, const Colours& b) {
  double worst = 0;
  for (const auto plane : {&Colours::r, &Colours::g, &Colours::b})
    for (std::size_t i = 0; i < a.size(); ++i)
      worst = std::max(worst, static_cast<double>(std::abs((a.*plane)[i] - (b.*plane)[i])));
  return worst;
}

void compare(const std::string& host, const Subject& subject, const Colours& got, const HostBounds& bounds) {
  const Colours exact = subject.goal->exact(subject.codes);
  const std::vector<Vec3<double>> wanted = subject.goal->seen(exact), seen = subject.goal->seen(got);
  double sum = 0;
  std::vector<double> differences;
  for (std::size_t i = 0; i < got.size(); ++i) {
    differences.push_back(subject.goal->difference()(wanted[i], seen[i]));
    sum += differences.back();
  }
  std::sort(differences.begin(), differences.end());
  const double mean = sum / static_cast<double>(got.size()), p99 = differences[differences.size() * 99 / 100],
               own = worst_code(got, read_here(subject, bounds.reading));
  std::printf("%-38s mean %.3f, 99 %% %.2f, max %.1f, worst code %.4f; %.1e to the cube as read here\n",
              host.c_str(), mean, p99, differences.back(), worst_code(got, exact), own);
  EXPECT_LE(own, bounds.own) << host;
  EXPECT_LE(mean, bounds.mean) << host;
  EXPECT_LE(p99, bounds.p99) << host;
}

}  // namespace

bool have(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

void CubeHosts::SetUpTestSuite() {
  files = std::make_unique<Folder>();
  subjects[acescct] = made("ACEScct", files->path("acescct"));
  subjects[davinci] = made("DaVinci Intermediate WideGamut", files->path("davinci"));
}

void CubeHosts::TearDownTestSuite() {
  subjects = {};
  files.reset();
}

std::string CubeHosts::folder(Space space) { return subjects[space].folder; }

void CubeHosts::expect(const std::string& host, const std::string& command, const HostBounds& bounds,
                       Space space, const std::string& output) {
  const Subject& subject = subjects[space];
  const std::string picture = subject.folder + "/" + output, log = subject.folder + "/log";
  std::filesystem::remove(picture);
  const std::string whole = "cd " + subject.folder + " && (" + command + ") >log 2>&1 </dev/null";
  ASSERT_EQ(std::system(whole.c_str()), 0) << command << "\n" << read_text(log);
  const Colours got = read(picture);
  ASSERT_EQ(got.size(), subject.codes.size()) << read_text(log);
  compare(host + (space == davinci ? " (DaVinci)" : ""), subject, got, bounds);
}

std::string CubeHosts::hald() {
  constexpr std::size_t nodes = 64;
  std::vector<float> pixels;
  for (std::size_t n = 0; n < nodes * nodes * nodes; ++n)
    for (const std::size_t i : {n % nodes, n / nodes % nodes, n / (nodes * nodes)})
      pixels.push_back(static_cast<float>(i) / static_cast<float>(nodes - 1));
  write(files->path("identity.png"), 512, pixels);
  return "ffmpeg -v error -y -i ../identity.png -vf format=rgb48,lut3d=file=street.cube:interp=tetrahedral "
         "-pix_fmt rgb48be hald.png";
}

}  // namespace scotopic::test
