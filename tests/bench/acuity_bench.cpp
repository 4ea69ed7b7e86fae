// The acuity filter against cv::bilateralFilter (CIELAB in float, d = 0) and against memcpy, on one machine
// in one run: ratios are printed at the end. Usage: bench_acuity [image file] [--benchmark_...]; with no
// file, a night by formula. bench_acuity --accuracy IMAGE...: how far from brute force in double.
#include <OpenImageIO/imagebuf.h>
#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <thread>

#include "stages/acuity/scenes.h"

namespace {

using scotopic::AcuityEngine;
using scotopic::AcuityFilter;
using scotopic::AcuityParameters;
using scotopic::AcuitySpace;
using scotopic::test::Image;

std::map<std::string, double> nanoseconds_per_pixel;

/// The file's pixels, repeated from the start to fill the size.
Image from_file(const std::string& path, int width, int height) {
  OIIO::ImageBuf file(path);
  Image image(width, height);
  float pixel[4] = {};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      file.getpixel(file.xbegin() + x % file.spec().width, file.ybegin() + y % file.spec().height, pixel, 3);
      for (int k = 0; k < 3; ++k) image.planes[k][image.at(x, y)] = pixel[k];
    }
  return image;
}

double white_of(const Image& image) {
  double sum = 0.0;
  for (std::size_t i = 0; i < image.planes[1].size(); ++i)
    sum += std::log(1e-6 + std::max(0.0f, image.planes[1][i]));
  return std::exp(sum / static_cast<double>(image.planes[1].size())) / 0.18;
}

struct Picture {
  Image image;
  double white;
};

std::string picture_file;

const Picture& picture(bool large) {
  static std::map<bool, Picture> made;
  if (!made.contains(large)) {
    const int w = large ? 3840 : 1024, h = large ? 2160 : 512;
    Image image = picture_file.empty() ? scotopic::test::night(w, h, 0.1) : from_file(picture_file, w, h);
    const double white = white_of(image);
    made.emplace(large, Picture{std::move(image), white});
  }
  return made.at(large);
}

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Runs and times passes; keeps the best, as others only ever add to it. Processor time, shared between the
/// threads that worked: other programs on the machine then show less than in elapsed time.
template <typename F>
void time_passes(benchmark::State& state, const std::string& name, int threads, std::size_t pixels, F pass) {
  double best = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const double start = processor_seconds();
    pass();
    const double seconds = (processor_seconds() - start) / threads;
    state.SetIterationTime(seconds);
    best = std::min(best, 1e9 * seconds / static_cast<double>(pixels));
  }
  state.counters["best_ns_per_pixel"] = best;
  const auto [entry, fresh] = nanoseconds_per_pixel.try_emplace(name, best);
  entry->second = std::min(entry->second, best);
}

void run_threads(int threads, int count, const std::function<void(int)>& task) {
  std::atomic<int> next{0};
  std::vector<std::jthread> pool;
  for (int t = 0; t < threads; ++t)
    pool.emplace_back([&] {
      for (int i; (i = next++) < count;) task(i);
    });
}

struct Case {
  std::string name;
  double sigma, range_sigma;
  AcuitySpace space;
  AcuityEngine engine;
  bool large;
  int threads;
  std::int64_t targets;  // of Highway; 0: the best
};

void filter_case(benchmark::State& state, const Case& c) {
  const Picture& p = picture(c.large);
  AcuityParameters parameters = scotopic::test::parameters(c.sigma, c.range_sigma);
  parameters.white = p.white;
  parameters.space = c.space;
  parameters.engine = c.engine;
  hwy::SetSupportedTargetsForTest(c.targets);
  hwy::GetChosenTarget().DeInit();
  const AcuityFilter filter(parameters);
  Image out(p.image.width, p.image.height);
  const scotopic::ParallelFor parallel = [&](int count, const std::function<void(int)>& task) {
    if (c.threads == 1) return scotopic::serial_for(count, task);
    run_threads(c.threads, count, task);
  };
  time_passes(state, c.name, c.threads, p.image.planes[0].size(), [&] {
    filter.filter(scotopic::test::window_of(p.image), scotopic::test::tile_of(out), parallel);
  });
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

void opencv_case(benchmark::State& state, const std::string& name, double sigma, double range_sigma) {
  const Picture& p = picture(false);
  const AcuityParameters parameters = [&] {
    AcuityParameters q = scotopic::test::parameters(sigma);
    q.white = p.white;
    return q;
  }();
  cv::Mat lab(p.image.height, p.image.width, CV_32FC3), out;
  for (int y = 0; y < p.image.height; ++y)
    for (int x = 0; x < p.image.width; ++x) {
      const auto v = scotopic::test::cielab(parameters, scotopic::test::pixel(p.image, x, y));
      lab.at<cv::Vec3f>(y, x) =
          cv::Vec3f(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
    }
  cv::setNumThreads(1);
  time_passes(state, name, 1, p.image.planes[0].size(),
              [&] { cv::bilateralFilter(lab, out, 0, range_sigma, sigma); });
}

/// As many copies of a 3840x2160 RGBA float frame at once as there are threads; the time of one of them.
void memcpy_case(benchmark::State& state, const std::string& name, int threads) {
  const Picture& p = picture(true);
  const std::size_t floats = 4 * p.image.planes[0].size();
  std::vector<std::vector<float>> from(static_cast<std::size_t>(threads), std::vector<float>(floats, 1.0f)),
      to = from;
  time_passes(state, name, threads, p.image.planes[0].size(), [&] {
    run_threads(threads, threads, [&](int i) {
      const auto at = static_cast<std::size_t>(i);
      std::memcpy(to[at].data(), from[at].data(), floats * sizeof(float));
      benchmark::DoNotOptimize(to[at].data());
    });
  });
}

void print_ratio(const char* what, const std::string& a, const std::string& b) {
  if (!nanoseconds_per_pixel.contains(a) || !nanoseconds_per_pixel.contains(b)) return;
  std::printf("%-64s %6.2f\n", what, nanoseconds_per_pixel[a] / nanoseconds_per_pixel[b]);
}

void register_all() {
  using enum AcuityEngine;
  const auto light = AcuitySpace::light, lab = AcuitySpace::lab;
  std::vector<Case> cases = {
      {"window 2 light", 2, 15, light, window, false, 1, 0},
      {"window 2 lab", 2, 15, lab, window, false, 1, 0},
      {"window 4 light", 4, 15, light, window, false, 1, 0},
      {"window 4 lab", 4, 15, lab, window, false, 1, 0},
      {"cells 4 light", 4, 15, light, cells, false, 1, 0},
      {"cells 4 lab", 4, 15, lab, cells, false, 1, 0},
      {"cells 8 light", 8, 15, light, cells, false, 1, 0},
      {"cells 8 lab", 8, 15, lab, cells, false, 1, 0},
      {"cells 16 light", 16, 15, light, cells, false, 1, 0},
      {"cells 16 lab", 16, 15, lab, cells, false, 1, 0},
      {"cells 48 light", 48, 15, light, cells, false, 1, 0},
      {"cells 48 lab", 48, 15, lab, cells, false, 1, 0},
      {"4K 2 light", 2.1, 15, light, automatic, true, 2, 0},
      {"4K 4 light", 4, 15, light, automatic, true, 2, 0},
      {"4K 8 light", 8, 15, light, automatic, true, 2, 0},
      {"4K 16 light", 16, 15, light, automatic, true, 2, 0},
      {"4K 60 light", 60, 15, light, automatic, true, 2, 0},
      {"4K 8 lab", 8, 15, lab, automatic, true, 2, 0},
      {"4K 60 lab", 60, 15, lab, automatic, true, 2, 0},
      {"4K 2 lab", 2.1, 15, lab, automatic, true, 2, 0},
  };
#if HWY_ARCH_X86
  cases.push_back({"AVX2 window 4 light", 4, 15, light, window, false, 1, HWY_AVX2});
  cases.push_back({"AVX2 cells 16 light", 16, 15, light, cells, false, 1, HWY_AVX2});
#endif
  for (const Case& c : cases)
    benchmark::RegisterBenchmark(c.name.c_str(), [c](benchmark::State& s) { filter_case(s, c); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime();
  for (int sigma : {4, 16, 48}) {
    const std::string name = "OpenCV " + std::to_string(sigma);
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& s) { opencv_case(s, name, sigma, 15); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime();
  }
  benchmark::RegisterBenchmark("memcpy 4K", [](benchmark::State& s) { memcpy_case(s, "memcpy 4K", 2); })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime();
}

void print_ratios() {
  std::printf("\nRatios of the best passes\n");
  for (const char* space : {"light", "lab"})
    for (const char* sigma : {"4", "16", "48"})
      print_ratio(("OpenCV / cells, sigma " + std::string(sigma) + ", " + space).c_str(),
                  "OpenCV " + std::string(sigma), "cells " + std::string(sigma) + " " + space);
  print_ratio("4K, sigma 60 / sigma 8, light", "4K 60 light", "4K 8 light");
  print_ratio("4K, sigma 60 / sigma 8, lab", "4K 60 lab", "4K 8 lab");
  print_ratio("AVX2 / best, window, sigma 4", "AVX2 window 4 light", "window 4 light");
  print_ratio("AVX2 / best, cells, sigma 16", "AVX2 cells 16 light", "cells 16 light");
  for (const char* name : {"4K 2 light", "4K 2 lab", "4K 4 light", "4K 8 light", "4K 8 lab", "4K 16 light"})
    print_ratio((std::string(name) + ", 2 threads / memcpy of the frame by each").c_str(), name, "memcpy 4K");
}

/// PSNR in dB of CIELAB, and the worst pixel's distance, at every 31st pixel of every 31st row.
void print_accuracy(const std::string& file) {
  const OIIO::ImageBuf pixels(file);
  const Image image = from_file(file, pixels.spec().width, pixels.spec().height);
  for (const double range : {15.0, 5.0})
    for (const double sigma : {2.1, 4.0, 8.0, 16.0, 48.0}) {
      AcuityParameters p = scotopic::test::parameters(sigma, range);
      p.white = white_of(image);
      const auto a = scotopic::test::agreement(p, image, 31);
      std::printf("%s sigma %4.1f range %2.0f: %.1f dB, worst %.2f CIELAB at (%d, %d)\n", file.c_str(), sigma,
                  range, a.psnr, a.worst, a.x, a.y);
    }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "--accuracy") == 0) {
    for (int i = 2; i < argc; ++i) print_accuracy(argv[i]);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  if (argc > 1) picture_file = argv[1];
  register_all();
  benchmark::RunSpecifiedBenchmarks();
  print_ratios();
}
