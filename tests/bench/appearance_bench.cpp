// The operator against memcpy and against plain scalar code, on each SIMD target of this machine, in one run;
// and how far float and double are from exact arithmetic (GNU MPFR). Usage: bench_appearance [ROUNDS]
// [--json].
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "batch/batch.h"
#include "stages/reference.h"
#include "looks/verify/contenders.h"
#include "looks/verify/timing.h"
#include "looks/verify/evaluators.h"
#include "pipeline/apply_image.h"
#include "io/pixels/row_bands.h"
#include "properties/mpfr_reference.h"
#include "support/primaries.h"

namespace {

using namespace scotopic;

constexpr std::size_t width = 3840, height = 2160, pixels = width * height;
constexpr std::size_t scalar_rows = height / 16;

AppearanceParameters parameters(double adaptation) {
  AppearanceParameters p;
  p.adaptation = adaptation;
  p.white_luminance = adaptation / 0.18;
  p.xyz_from_rgb = test::rec709;
  p.xyz_from_gamut = test::rec709;
  return p;
}

AppearanceParameters kernel_alone() {
  AppearanceParameters p = parameters(0.1);
  p.model = Model::safko2019;
  return p;
}

/// One frame, as planes and as RGBA, and copies of both to work on.
struct Frames {
  TimedPicture picture = night_picture(width, height, parameters(0.1));
  Colours work = picture.pixels;
  std::vector<float> rgba, rgba_work;

  Frames() : rgba(4 * pixels, 1.0f) {
    for (std::size_t i = 0; i < pixels; ++i) {
      rgba[4 * i] = work.r[i];
      rgba[4 * i + 1] = work.g[i];
      rgba[4 * i + 2] = work.b[i];
    }
    rgba_work = rgba;
  }
  void restore() {
    std::copy(picture.pixels.r.begin(), picture.pixels.r.end(), work.r.begin());
    std::copy(picture.pixels.g.begin(), picture.pixels.g.end(), work.g.begin());
    std::copy(picture.pixels.b.begin(), picture.pixels.b.end(), work.b.begin());
  }
  PixelRows row(std::size_t y) {
    PixelRows out;
    out.r = work.r.data() + y * width, out.g = work.g.data() + y * width, out.b = work.b.data() + y * width;
    out.count = width;
    return out;
  }
};

struct Named {
  std::string name;
  TimedRun run;
};

TimedRun planes(Frames& f, std::shared_ptr<AppearanceBatch> batch, bool threaded) {
  const auto work = [&f, batch](int first, int last) {
    for (int y = first; y < last; ++y) batch->apply(f.row(static_cast<std::size_t>(y)));
  };
  return {[&f] { f.restore(); },
          [work, threaded] {
            if (threaded)
              parallel_rows(static_cast<int>(height), 8, work);
            else
              work(0, static_cast<int>(height));
          },
          pixels};
}

TimedRun interleaved(Frames& f, std::shared_ptr<AppearanceBatch> batch) {
  return {[&f] { std::copy(f.rgba.begin(), f.rgba.end(), f.rgba_work.begin()); },
          [&f, batch] { batch->apply_rgba(f.rgba_work.data(), pixels); }, pixels};
}

TimedRun scalar(Frames& f, const AppearanceParameters& p) {
  const auto reference = std::make_shared<AppearanceReference>(p);
  return {[&f] { f.restore(); },
          [&f, reference] {
            for (std::size_t y = 0; y < scalar_rows; ++y) {
              const PixelRows rows = f.row(y);
              for (std::size_t i = 0; i < width; ++i) {
                const Vec3<double> out = (*reference)({{rows.r[i], rows.g[i], rows.b[i]}});
                rows.r[i] = static_cast<float>(out[0]);
                rows.g[i] = static_cast<float>(out[1]);
                rows.b[i] = static_cast<float>(out[2]);
              }
            }
          },
          scalar_rows * width};
}

/// The thesis' formula as it is first written down: a pixel at a time, in double, a matrix at a time.
struct NaiveKernel {
  AppearanceParameters p = kernel_alone();
  OperatorConstants constants{p};
  KernelPreset preset = kernel_preset(p.model);
  Matrix3<double> lms_from_opponent = inverse(opponent_from_lms), rgb_from_lms = rgb_from_lms_cat02(p);
  bool power;  // 1/sqrt(x) as pow(x, -1/2)

  explicit NaiveKernel(bool with_power) : power(with_power) {}

  void operator()(const PixelRows& rows, std::size_t i) const {
    const Vec3<double> rgb = {rows.r[i], rows.g[i], rows.b[i]};
    const Vec3<double> lms = constants.lms_from_rgb * rgb;
    const double t = p.safko_scale * p.white_luminance;
    const double rod = t * rod_signal_from_rgb(constants, rgb);
    Vec3<double> gained{}, seen{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double signal = 1 + preset.gain[k] * std::max(0.0, t * lms[k] + preset.kappa[k] * rod);
      gained[k] = rod * (power ? std::pow(signal, -0.5) : 1 / std::sqrt(signal));
    }
    const Vec3<double> shift = lms_from_opponent * (preset.opponent * gained);
    for (std::size_t k = 0; k < 3; ++k) seen[k] = lms[k] + shift[k] / t;
    const Vec3<double> out = rgb_from_lms * seen;
    rows.r[i] = static_cast<float>(out[0]);
    rows.g[i] = static_cast<float>(out[1]);
    rows.b[i] = static_cast<float>(out[2]);
  }
};

TimedRun naive(Frames& f, bool power) {
  const auto kernel = std::make_shared<NaiveKernel>(power);
  return {[&f] { f.restore(); },
          [&f, kernel] {
            for (std::size_t y = 0; y < scalar_rows; ++y) {
              const PixelRows rows = f.row(y);
              for (std::size_t i = 0; i < width; ++i) (*kernel)(rows, i);
            }
          },
          scalar_rows * width};
}

std::vector<Named> cases(Frames& f) {
  const auto batch = [](const AppearanceParameters& p, Precision precision) {
    return std::make_shared<AppearanceBatch>(p, precision);
  };
  const AppearanceParameters full = parameters(0.1), kernel = kernel_alone(), light = parameters(10);
  using enum Precision;
  return {
      {"memcpy", {nullptr, [&f] { std::copy(f.rgba.begin(), f.rgba.end(), f.rgba_work.begin()); }, pixels}},
      {"kernel, float", planes(f, batch(kernel, single), false)},
      {"kernel, float, RGBA", interleaved(f, batch(kernel, single))},
      {"kernel, double inside", planes(f, batch(kernel, dual), false)},
      {"operator, float", planes(f, batch(full, single), false)},
      {"operator, float, RGBA", interleaved(f, batch(full, single))},
      {"operator, double inside", planes(f, batch(full, dual), false)},
      {"operator, float, photopic", planes(f, batch(light, single), false)},
      {"operator, float, 2 threads", planes(f, batch(full, single), true)},
      {"operator, double inside, 2 threads", planes(f, batch(full, dual), true)},
      {"kernel, naive double, pow", naive(f, true)},
      {"kernel, naive double, sqrt", naive(f, false)},
      {"kernel, scalar double", scalar(f, kernel)},
      {"operator, scalar double", scalar(f, full)}};
}

void time_target(Frames& f, std::int64_t target, int rounds, bool json, bool& first) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().DeInit();
  const std::vector<Named> named = cases(f);
  std::vector<TimedRun> runs;
  for (const Named& n : named) runs.push_back(n.run);
  const std::vector<RunTime> times = time_interleaved(runs, rounds);
  for (std::size_t i = 0; i < named.size(); ++i) {
    const double ratio = times[i].median / times[0].median;
    if (json)
      std::printf("%s{\"target\":\"%s\",\"what\":\"%s\",\"ns\":%.4g,\"ratio\":%.4g,\"spread\":%.3g}",
                  first ? "" : ",\n", hwy::TargetName(target), named[i].name.c_str(), times[i].median, ratio,
                  times[i].spread());
    else
      std::printf("%-6s %-36s %8.2f ns/pixel %7.2f x memcpy  (spread %.0f %%)\n", hwy::TargetName(target),
                  named[i].name.c_str(), times[i].median, ratio, 100 * times[i].spread());
    first = false;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

/// Worst error over colours of 28 stops: of the pixel's largest component, and of a component in its float
/// ulps.
struct Worst {
  double pixel = 0, ulps = 0;
  Vec3<double> pixel_in{}, ulps_in{};
};

double ulp(double x) {
  const float a = std::abs(static_cast<float>(x));
  return static_cast<double>(std::nextafter(a, INFINITY)) - static_cast<double>(a);
}

void judge(const Vec3<double>& in, const Vec3<test::Mp>& exact, const Vec3<double>& got, Worst& worst) {
  double size = 0, error = 0, ulps = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double is = std::abs(static_cast<double>(exact[c] - test::Mp(got[c])));
    size = std::max({size, std::abs(in[c]), std::abs(static_cast<double>(exact[c]))});
    error = std::max(error, is);
    ulps = std::max(ulps, is / ulp(static_cast<double>(exact[c])));
  }
  if (size > 0 && error / size > worst.pixel) worst.pixel = error / size, worst.pixel_in = in;
  if (ulps > worst.ulps) worst.ulps = ulps, worst.ulps_in = in;
}

void judge_adaptation(double adaptation, bool json, bool& first) {
  const AppearanceParameters p = parameters(adaptation);
  const Colours in = stop_colours(20000, p.xyz_from_rgb, p.xyz_from_rgb);
  const test::ExactOperator<test::Mp> exact(p);
  const AppearanceReference reference(p);
  Colours outs[2] = {in, in};
  const Precision precisions[2] = {Precision::single, Precision::dual};
  for (int k = 0; k < 2; ++k) {
    PixelRows rows;
    rows.r = outs[k].r.data(), rows.g = outs[k].g.data(), rows.b = outs[k].b.data(), rows.count = in.size();
    AppearanceBatch(p, precisions[k]).apply(rows);
  }
  Worst worst[3];
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Vec3<double> rgb = {in.r[i], in.g[i], in.b[i]};
    const Vec3<test::Mp> should = exact({rgb});
    judge(rgb, should, reference({rgb}), worst[0]);
    for (std::size_t k = 0; k < 2; ++k)
      judge(rgb, should, {outs[k].r[i], outs[k].g[i], outs[k].b[i]}, worst[k + 1]);
  }
  const char* const names[3] = {"reference", "float", "double inside"};
  for (std::size_t k = 0; k < 3; ++k) {
    const Worst& w = worst[k];
    const char* const format =
        json
            ? "%s{\"adaptation\":%g,\"way\":\"%s\",\"pixel\":%.3g,\"pixelAt\":[%.9g,%.9g,%.9g],\"ulps\":%.3g,"
              "\"ulpsAt\":[%.9g,%.9g,%.9g]}"
            : "%sLa %-6g %-14s %9.3g of the pixel, at (%.9g, %.9g, %.9g);  %9.3g float ulps of a component, "
              "at (%.9g, "
              "%.9g, %.9g)\n";
    std::printf(format, !json || first ? "" : ",\n", adaptation, names[k], w.pixel, w.pixel_in[0],
                w.pixel_in[1], w.pixel_in[2], w.ulps, w.ulps_in[0], w.ulps_in[1], w.ulps_in[2]);
    first = false;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool json = argc > 1 && std::strcmp(argv[argc - 1], "--json") == 0;
  const int rounds = argc > 1 && !std::strchr(argv[1], '-') ? std::max(1, std::atoi(argv[1])) : 9;
  set_threads(2);
  bool first = true;
  if (json) std::printf("{\"times\":[\n");
  {
    Frames frames;
    // The best three that the batch is compiled for: what is slower is for machines of before 2008.
    std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
    std::erase_if(targets, [](std::int64_t t) { return t == HWY_SSSE3; });
    targets.resize(std::min<std::size_t>(3, targets.size()));
    for (const std::int64_t target : targets) time_target(frames, target, rounds, json, first);
  }
  if (json) std::printf("],\n\"exact\":[\n");
  first = true;
  for (const double adaptation : {0.001, 0.01, 0.1, 1.0}) judge_adaptation(adaptation, json, first);
  if (json) std::printf("]}\n");
}
