#include "clients/host.h"

#include <OpenImageIO/imageio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "looks/verify/measure.h"
#include "color/primaries.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic::test {
namespace {

constexpr int side = 64;

struct WorkFolder {
  std::string path;
  WorkFolder()
      : path(std::filesystem::temp_directory_path() / ("scotopic_clients_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path);
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

Pixels make_pixels() {
  const Matrix3<double> rec709 = gamut_xyz_matrix("rec709").value(), ap1 = gamut_xyz_matrix("ap1").value();
  const std::size_t count = side * side;
  const Colours inside = stop_colours(count, rec709, rec709), wide = stop_colours(count, ap1, rec709);
  Pixels pixels;
  for (std::size_t i = 0; i < count; ++i) {
    const Colours& c = i % 5 == 0 ? wide : inside;
    pixels.insert(pixels.end(), {c.r[i], c.g[i], c.b[i], static_cast<float>(i % 65) / 64});
  }
  return pixels;
}

}  // namespace

Finished run(const std::string& command) {
  const std::string line = "unset OCIO SCOTOPIC_LA; export LC_ALL=C; { " + command + " ; } 2>&1";
  Finished result;
  std::FILE* pipe = popen(("timeout 60 sh -c " + quoted(line)).c_str(), "r");
  if (!pipe) return result;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    result.said.append(buffer.data(), n);
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

bool have(const std::string& program) { return run("command -v " + program).exit_code == 0; }

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

const std::string& work_folder() {
  static const WorkFolder folder;
  return folder.path;
}

const Pixels& test_pixels() {
  static const Pixels pixels = make_pixels();
  return pixels;
}

const std::string& test_image() {
  static const std::string file = [] {
    const std::string name = work_folder() + "/in.exr";
    write_pixels(name, test_pixels(), side);
    return name;
  }();
  return file;
}

void write_pixels(const std::string& file, const Pixels& pixels, int width) {
  OIIO::ImageSpec spec(width, static_cast<int>(pixels.size()) / 4 / width, 4, OIIO::TypeFloat);
  spec.attribute("compression", "none");
  const auto out = OIIO::ImageOutput::create(file);
  if (!out || !out->open(file, spec) || !out->write_image(OIIO::TypeFloat, pixels.data()) || !out->close())
    throw std::runtime_error("cannot write " + file);
}

Pixels read_pixels(const std::string& file) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in || in->spec().nchannels != 4) return {};
  Pixels pixels(static_cast<std::size_t>(in->spec().image_pixels()) * 4);
  if (!in->read_image(0, 0, 0, 4, OIIO::TypeFloat, pixels.data())) return {};
  return pixels;
}

std::string config_file() { return SCOTOPIC_SOURCE_DIR "/ocio_config/config.ocio"; }

OCIO::ConstConfigRcPtr config() {
  static const OCIO::ConstConfigRcPtr shipped = OCIO::Config::CreateFromFile(config_file().c_str());
  return shipped;
}

Pixels expected(const OCIO::ConstTransformRcPtr& transform) {
  Pixels pixels = test_pixels();
  OCIO::PackedImageDesc image(pixels.data(), side, side, 4);
  config()->getProcessor(transform)->getDefaultCPUProcessor()->apply(image);
  return pixels;
}

OCIO::TransformRcPtr look_transform(const std::string& look) {
  OCIO::LookTransformRcPtr transform = OCIO::LookTransform::Create();
  transform->setSrc(linear.c_str());
  transform->setDst(linear.c_str());
  transform->setLooks(look.c_str());
  return transform;
}

OCIO::TransformRcPtr view_transform(const std::string& display, const std::string& view) {
  OCIO::DisplayViewTransformRcPtr transform = OCIO::DisplayViewTransform::Create();
  transform->setSrc(linear.c_str());
  transform->setDisplay(display.c_str());
  transform->setView(view.c_str());
  return transform;
}

bool programs_have_this_ocio() {
  static const bool same = [] {
    const std::string version = OCIO::GetVersion();  // "2.1.2"
    const std::string library = "libOpenColorIO.so." + version.substr(0, version.find('.', 2));
    for (const char* program : {"oiiotool", "ocioconvert"})
      if (have(program))
        return run("ldd \"$(command -v " + std::string(program) + ")\"").said.find(library) !=
               std::string::npos;
    return true;
  }();
  return same;
}

double worst_difference(const std::string& what, const Pixels& got, const Pixels& wanted) {
  const bool same = programs_have_this_ocio();
  double worst = got.size() == wanted.size() ? 0 : std::numeric_limits<double>::infinity();
  std::size_t where = 0;
  for (std::size_t i = 0; i + 3 < std::min(got.size(), wanted.size()); i += 4) {
    double size = same ? 1e-30 : 0.05, difference = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      size = std::max(size, std::abs(static_cast<double>(wanted[i + c])));
      difference = std::max(difference,
                            std::abs(static_cast<double>(got[i + c]) - static_cast<double>(wanted[i + c])));
    }
    const bool alpha = std::abs(got[i + 3] - wanted[i + 3]) <= (same ? 0.0f : 2e-5f);
    const double error =
        alpha && std::isfinite(difference) ? difference / size : std::numeric_limits<double>::infinity();
    if (error > worst) worst = error, where = i / 4;
  }
  std::printf("%s: worst difference %.3g of a pixel's largest component, at pixel %zu\n", what.c_str(), worst,
              where);
  return worst;
}

}  // namespace scotopic::test
