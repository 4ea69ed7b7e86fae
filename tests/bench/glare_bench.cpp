// Glare on one thread, beside memcpy of the same planes and a padded FFT of them (FFTW in float, where it is
// there). Times of one run, least of a few: look at the ratios. What the system took of that run to give
// pages is told beside it.
#include <hwy/targets.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#ifdef SCOTOPIC_BENCH_FFTW
#include <fftw3.h>
#endif

#include "stages/glare/filter.h"

namespace {

using namespace scotopic;

constexpr std::array<double, 3> luminance = {0.2126, 0.7152, 0.0722};

struct Planes {
  Planes(int w, int h) : width(w), height(h) {
    for (auto& plane : values) plane.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  }
  GlarePicture view() {
    GlarePicture out;
    for (std::size_t k = 0; k < 3; ++k) out.rgb[k] = values[k].data();
    for (auto& plane : values) out.light.push_back(plane.data());
    out.stride = width;
    return out;
  }
  int width, height;
  std::array<std::vector<float>, 3> values;
};

std::uint32_t hashed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// A night: noise below the threshold of 1, and `share` of all squares of 8 x 8 pixels lit up to 1000.
Planes night(int width, int height, double share) {
  Planes out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint32_t place = hashed(static_cast<std::uint32_t>((y / 8) * 65536 + x / 8));
      const bool lamp = place < share * 4294967295.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        const std::uint32_t noise = hashed(static_cast<std::uint32_t>(at * 3 + k));
        out.values[k][at] = static_cast<float>(noise) * (lamp ? 1000.0f : 0.5f) / 4294967296.0f;
      }
    }
  return out;
}

/// Of the processor, not of the clock on the wall: others may be at work on the machine.
struct Seconds {
  double all, of_system;
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Seconds processor() {
  rusage used;
  getrusage(RUSAGE_SELF, &used);
  const double system = seconds_of(used.ru_stime);
  return {seconds_of(used.ru_utime) + system, system};
}

Seconds seconds(const std::function<void()>& work) {
  const Seconds start = processor();
  work();
  const Seconds end = processor();
  return {end.all - start.all, end.of_system - start.of_system};
}

/// Least of `times` runs, `prepare` before each not counted.
Seconds least_parts(int times, const std::function<void()>& prepare, const std::function<void()>& work) {
  Seconds best = {1e9, 0};
  for (int i = 0; i < times; ++i) {
    prepare();
    const Seconds now = seconds(work);
    if (now.all < best.all) best = now;
  }
  return best;
}

double least(int times, const std::function<void()>& prepare, const std::function<void()>& work) {
  return least_parts(times, prepare, work).all;
}

GlareFilter filter_of(int width, int height, double halo = 0) {
  GlareParameters p;
  p.eye.halo = halo;
  p.grid = {width, height, width / 40.0, width / 40.0, GlareSides::end, 1};
  return GlareFilter(p);
}

void print(const char* what, double time, double pixels, double copy) {
  std::printf("  %-36s %7.2f ns a pixel, %6.2f x memcpy\n", what, time / pixels * 1e9, time / copy);
}

/// `scene` filtered in `work`.
Seconds filtering(const GlareFilter& filter, const Planes& scene, Planes& work, int times) {
  return least_parts(
      times, [&] { work = scene; }, [&] { filter.apply(work.view()); });
}

void print(const char* what, const Seconds& time, double pixels, double copy) {
  std::printf("  %-36s %7.2f ns a pixel, %6.2f x memcpy; of it the system %.2f ns\n", what,
              time.all / pixels * 1e9, time.all / copy, time.of_system / pixels * 1e9);
}

#ifdef SCOTOPIC_BENCH_FFTW
int smooth(int n) {
  for (;; ++n) {
    int left = n;
    for (const int f : {2, 3, 5, 7})
      while (left % f == 0) left /= f;
    if (left == 1) return n;
  }
}

/// Four planes (R, G, B, mask) padded to the sum of sizes, there and back, times a kernel known beforehand.
double fft(int width, int height) {
  const int w = smooth(2 * width), h = smooth(2 * height), half = w / 2 + 1;
  float* const plane = fftwf_alloc_real(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  fftwf_complex* const spectrum =
      fftwf_alloc_complex(static_cast<std::size_t>(half) * static_cast<std::size_t>(h));
  const fftwf_plan there = fftwf_plan_dft_r2c_2d(h, w, plane, spectrum, FFTW_ESTIMATE);
  const fftwf_plan back = fftwf_plan_dft_c2r_2d(h, w, spectrum, plane, FFTW_ESTIMATE);
  std::fill_n(plane, static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0.25f);
  const double one = least(
      2, [] {},
      [&] {
        fftwf_execute(there);
        for (std::size_t i = 0; i < static_cast<std::size_t>(half) * static_cast<std::size_t>(h); ++i) {
          spectrum[i][0] *= 0.5f;
          spectrum[i][1] *= 0.5f;
        }
        fftwf_execute(back);
      });
  fftwf_destroy_plan(there);
  fftwf_destroy_plan(back);
  fftwf_free(plane);
  fftwf_free(spectrum);
  return 4 * one;
}
#endif

/// A row that has just been decoded goes into planes; with and without its greatest component being kept.
double taking_rows(Planes& into, std::vector<float>* greatest) {
  const auto row = static_cast<std::size_t>(into.width);
  std::array<std::vector<float>, 3> decoded;
  for (auto& plane : decoded) plane.assign(row, 0.25f);
  return least(
      5, [] {},
      [&] {
        for (int y = 0; y < into.height; ++y) {
          for (std::size_t k = 0; k < 3; ++k)
            std::memcpy(into.values[k].data() + static_cast<std::size_t>(y) * row, decoded[k].data(),
                        4 * row);
          if (greatest != nullptr)
            (*greatest)[static_cast<std::size_t>(y)] =
                greatest_component({decoded[0].data(), decoded[1].data(), decoded[2].data()}, into.width);
        }
      });
}

void size(int width, int height, int times) {
  const double pixels = static_cast<double>(width) * height;
  std::printf("%d x %d, 40 degrees, three planes\n", width, height);
  Planes work(width, height), copy(width, height);
  const double copying = least(
      times + 2, [] {},
      [&] {
        for (std::size_t k = 0; k < 3; ++k)
          std::memcpy(copy.values[k].data(), work.values[k].data(), work.values[k].size() * sizeof(float));
      });
  print("memcpy", copying, pixels, copying);
  const GlareFilter filter = filter_of(width, height), ringed = filter_of(width, height, 0.033);
  std::printf("  memory %.1f bytes a pixel\n", static_cast<double>(filter.bytes(3, 1)) / pixels);
  for (const double share : {1.0, 0.01, 0.0001, 0.0}) {
    const Planes scene = night(width, height, share);
    const std::string name = "lamps on " + std::to_string(100 * share).substr(0, 6) + " %";
    print(name.c_str(), filtering(filter, scene, work, times), pixels, copying);
    if (share > 0) print("  with a halo", filtering(ringed, scene, work, times), pixels, copying);
    print("  asked whether called for",
          least(
              times, [&] { work = scene; }, [&] { filter.need(work.view(), luminance); }),
          pixels, copying);
  }
  std::vector<float> greatest(static_cast<std::size_t>(height));
  const double without = taking_rows(work, nullptr), with = taking_rows(work, &greatest);
  print("rows' greatest kept while decoding", std::max(0.0, with - without), pixels, copying);
  GlarePicture known = work.view();
  known.greatest = greatest.data();
  print("  asked whether called for, known",
        least(
            times, [] {}, [&] { filter.need(known, luminance); }),
        pixels, copying);
#ifdef SCOTOPIC_BENCH_FFTW
  if (pixels < 1e7) print("padded FFT (FFTW, float, estimate)", fft(width, height), pixels, copying);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  const bool avx2 = argc > 1 && std::string(argv[1]) == "avx2";
  if (avx2) hwy::SetSupportedTargetsForTest(HWY_AVX2 | HWY_SSE4 | HWY_SSSE3);
  std::printf("%s\n", avx2 ? "AVX2" : "the best instruction set here");
  size(1920, 1080, 20);
  size(3840, 2160, 8);
  size(7680, 4320, 5);
}
