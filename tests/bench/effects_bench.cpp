// What it costs that effects are skipped where a scene does not call for them: the program against nothing
// but reading and writing the file, and the operator where a quarter of the picture is lit. CPU time, one
// thread, in turn. Usage: bench_effects [ROUNDS] [--json]          (bench_effects --copy IN OUT is what the
// program is held to)
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "batch/batch.h"
#include "looks/verify/contenders.h"
#include "looks/verify/timing.h"
#include "io/pixels/pixel_type.h"
#include "support/primaries.h"

namespace {

using namespace scotopic;

constexpr std::size_t tile = 64;

AppearanceParameters night() {
  AppearanceParameters p;
  p.adaptation = 0.01;
  p.white_luminance = p.adaptation / 0.18;
  p.xyz_from_rgb = test::rec709;
  p.xyz_from_gamut = test::rec709;
  return p;
}

// --- Files
// -----------------------------------------------------------------------------------------------------------

void write_exr(const std::string& path, const TimedPicture& picture, Imf::Compression compression) {
  const std::size_t width = picture.width, height = picture.rows();
  std::vector<std::uint16_t> halves(3 * width * height);
  const std::vector<float>* planes[3] = {&picture.pixels.r, &picture.pixels.g, &picture.pixels.b};
  Imf::Header header(static_cast<int>(width), static_cast<int>(height));
  header.compression() = compression;
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < 3; ++c) {
    std::uint16_t* const at = halves.data() + c * width * height;
    store_row(planes[c]->data(), planes[c]->size(), {reinterpret_cast<std::byte*>(at), 2, PixelType::half});
    const std::string name(1, "RGB"[c]);
    header.channels().insert(name, Imf::Channel(Imf::HALF));
    frame.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(at), 2, 2 * width));
  }
  Imf::OutputFile out(path.c_str(), header, 0);
  out.setFrameBuffer(frame);
  out.writePixels(static_cast<int>(height));
}

/// The file again, in bands of 8 MiB, by OpenEXR's own calls.
void copy_exr(const char* from, const char* to) {
  Imf::InputFile in(from, 0);
  Imf::OutputFile out(to, in.header(), 0);
  const Imath::Box2i window = in.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  const int rows = static_cast<int>((std::size_t{8} << 20) / (6 * width)) / 16 * 16;
  std::vector<std::uint16_t> halves(3 * width * static_cast<std::size_t>(rows));
  for (int y = window.min.y; y <= window.max.y; y += rows) {
    const int count = std::min(rows, window.max.y - y + 1);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at =
          reinterpret_cast<std::intptr_t>(halves.data() + c * width * static_cast<std::size_t>(rows));
      const std::intptr_t origin =
          at - std::intptr_t{y} * static_cast<std::intptr_t>(2 * width) - 2 * window.min.x;
      frame.insert(std::string(1, "RGB"[c]),
                   Imf::Slice(Imf::HALF, reinterpret_cast<char*>(origin), 2, 2 * width));
    }
    in.setFrameBuffer(frame);
    in.readPixels(y, y + count - 1);
    out.setFrameBuffer(frame);
    out.writePixels(count);
  }
}

/// CPU seconds of a child, its start and end among them.
double child_seconds(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage used{};
  if (child < 0 || wait4(child, &status, 0, &used) < 0 || status != 0)
    throw std::runtime_error("failed: " + command[0]);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// --- The operator in memory
// ------------------------------------------------------------------------------------------

/// A 4K frame as planes, no pixel lit, or every pixel of each fourth tile; and room for a piece of a row, as
/// the image tool takes them.
struct Frame {
  static constexpr std::size_t piece = 512;
  TimedPicture picture;
  std::vector<float> room = std::vector<float>(3 * piece);

  explicit Frame(bool lit) : picture(night_picture(3840, 2160, night())) {
    const float bright = static_cast<float>(20 / night().white_luminance);  // cd/m2: photopic whatever La is
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      const std::size_t x = i % picture.width / tile, y = i / picture.width / tile;
      const bool light = lit && (x + 2 * y) % 4 == 0;
      for (auto* plane : {&picture.pixels.r, &picture.pixels.g, &picture.pixels.b})
        (*plane)[i] = light ? bright : std::min((*plane)[i], bright / 8);
    }
  }
  /// Of copying each piece into the room and, with a batch, of seeing it there.
  double nanoseconds(const AppearanceBatch* batch) {
    const double start = thread_seconds();
    for (std::size_t y = 0; y < picture.rows(); ++y)
      for (std::size_t x = 0; x < picture.width; x += piece) {
        PixelRows rows;
        rows.r = room.data(), rows.g = rows.r + piece, rows.b = rows.g + piece;
        rows.count = std::min(piece, picture.width - x);
        const std::size_t at = y * picture.width + x;
        std::copy_n(&picture.pixels.r[at], rows.count, rows.r);
        std::copy_n(&picture.pixels.g[at], rows.count, rows.g);
        std::copy_n(&picture.pixels.b[at], rows.count, rows.b);
        if (batch) batch->apply(rows);
      }
    return 1e9 * (thread_seconds() - start) / static_cast<double>(picture.pixels.size());
  }
};

// --- Figures
// ---------------------------------------------------------------------------------------------------------

struct Figure {
  std::string name, unit;
  std::vector<double> is, against;  // one of each a round

  void print(bool json, bool first) const {
    const RunTime a = run_time(is), b = run_time(against);
    std::vector<double> each;
    for (std::size_t i = 0; i < is.size(); ++i) each.push_back(is[i] / against[i]);
    const double ratio = run_time(each).median;
    if (json)
      std::printf(
          "%s{\"what\":\"%s\",\"unit\":\"%s\",\"median\":%.4g,\"against\":%.4g,\"ratio\":%.4g,"
          "\"ratioOfLeast\":%.4g}",
          first ? "" : ",\n", name.c_str(), unit.c_str(), a.median, b.median, ratio, a.least / b.least);
    else
      std::printf("%-62s %8.3f %s against %8.3f: %.3f x (least %.3f x)\n", name.c_str(), a.median,
                  unit.c_str(), b.median, ratio, a.least / b.least);
  }
};

struct FileCase {
  std::string name, file;
  std::vector<std::string> options;
};

Figure time_file(const FileCase& c, const std::string& self, const std::string& out, int rounds) {
  Figure figure{c.name, "s CPU", {}, {}};
  std::vector<std::string> apply = {SCOTOPIC_PROGRAM, "apply", c.file, "-o", out, "--threads", "1", "-q"};
  apply.insert(apply.end(), c.options.begin(), c.options.end());
  for (int round = 0; round <= rounds; ++round) {
    const double is = child_seconds(apply), against = child_seconds({self, "--copy", c.file, out});
    if (round > 0) figure.is.push_back(is), figure.against.push_back(against);
  }
  return figure;
}

Figure time_lit(int rounds) {
  Figure figure{"operator, float, a quarter of the tiles lit, against none", "ns per pixel", {}, {}};
  const AppearanceBatch batch(night());
  Frame lit(true), dark(false);
  for (int round = 0; round <= rounds; ++round) {
    const double is = lit.nanoseconds(&batch) - lit.nanoseconds(nullptr);
    const double against = dark.nanoseconds(&batch) - dark.nanoseconds(nullptr);
    if (round > 0) figure.is.push_back(is), figure.against.push_back(against);
  }
  return figure;
}

int measure(const std::string& self, int rounds, bool json) {
  char pattern[] = "/tmp/bench_effects_XXXXXX";
  if (!mkdtemp(pattern)) throw std::runtime_error("no temporary folder");
  const std::string folder = pattern, out = folder + "/out.exr";
  const auto file = [&](const char* name) { return folder + "/" + name; };
  write_exr(file("4k.exr"), night_picture(3840, 2160, night()), Imf::ZIP_COMPRESSION);
  write_exr(file("1080.exr"), night_picture(1920, 1080, night()), Imf::ZIP_COMPRESSION);
  write_exr(file("1080_plain.exr"), night_picture(1920, 1080, night()), Imf::NO_COMPRESSION);
  const std::vector<std::string> light = {"--adaptation", "1000"}, dark = {"--adaptation", "0.01"};
  const std::vector<std::string> blurred = {"--adaptation", "0.01", "--ppd", "20"};
  const std::vector<FileCase> cases = {
      {"4K half ZIP, photopic, against reading + writing", file("4k.exr"), light},
      {"1080p half ZIP, nothing called for", file("1080.exr"), light},
      {"1080p half ZIP, shift, luminance, chroma", file("1080.exr"), dark},
      {"1080p half ZIP, the same and acuity (20 pixels per degree)", file("1080.exr"), blurred},
      {"1080p half uncompressed, nothing called for", file("1080_plain.exr"), light},
      {"1080p half uncompressed, shift, luminance, chroma", file("1080_plain.exr"), dark}};
  std::vector<Figure> figures = {time_lit(rounds)};
  for (const FileCase& c : cases) figures.push_back(time_file(c, self, out, rounds));
  if (json)
    std::printf("[\n");
  else
    std::printf("%s, medians of %d rounds, each against its pair of the same round\n", simd_target(), rounds);
  for (std::size_t i = 0; i < figures.size(); ++i) figures[i].print(json, i == 0);
  if (json) std::printf("]\n");
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 4 && std::strcmp(argv[1], "--copy") == 0) {
      copy_exr(argv[2], argv[3]);
      return 0;
    }
    const bool json = argc > 1 && std::strcmp(argv[argc - 1], "--json") == 0;
    const int rounds = argc > 1 && argv[1][0] != '-' ? std::max(1, std::atoi(argv[1])) : 7;
    return measure(std::filesystem::read_symlink("/proc/self/exe").string(), rounds, json);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_effects: %s\n", e.what());
    return 1;
  }
}
