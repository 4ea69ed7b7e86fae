// Spectral bands to receptor signals: against a pure read of the same bytes, a naive double loop, and reading
// the file with OpenEXR alone. Ratios within one run; medians of --benchmark_repetitions.
//
//   bench_spectral --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <vector>

#include "pipeline/apply_image.h"
#include "io/pixels/row_bands.h"
#include "io/spectral/spectral_source.h"
#include "receptors/spectral_integrator.h"
#include "io/spectral/scene.h"

namespace scotopic {
namespace {

constexpr std::size_t bands = 81;
constexpr std::size_t width = 1920;
constexpr std::size_t rows = 540;  // 336 MB: far beyond any cache

const std::vector<float>& image() {
  static const std::vector<float> values = [] {
    std::vector<float> v(bands * width * rows);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = 0.1f + 1e-3f * static_cast<float>(i % 1013);
    return v;
  }();
  return values;
}

const SpectralWeights& weights() {
  static const SpectralWeights of =
      emissive_weights(BandGrid(test::band_centres(380, 5, 780)), BandSampling::bin, BandUnit::per_nm);
  return of;
}

void set_bytes(benchmark::State& state) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(image().size() * sizeof(float)));
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define WIDEST_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDEST_VECTORS
#endif

// Every byte once, in vectors as wide as the machine has: integers, so that the compiler may make some.
WIDEST_VECTORS std::uint64_t sum_of_words(const std::uint64_t* words, std::size_t count) {
  std::uint64_t sums[32] = {};
  for (std::size_t i = 0; i + 32 <= count; i += 32)
    for (std::size_t k = 0; k < 32; ++k) sums[k] += words[i + k];
  return std::accumulate(std::begin(sums), std::end(sums), std::uint64_t{0});
}

void pure_read(benchmark::State& state) {
  const auto* words = reinterpret_cast<const std::uint64_t*>(image().data());
  for (auto _ : state) benchmark::DoNotOptimize(sum_of_words(words, image().size() / 2));
  set_bytes(state);
}
BENCHMARK(pure_read)->Unit(benchmark::kMillisecond);

void integrate(benchmark::State& state, Accumulation accumulation, std::size_t signals) {
  const SpectralIntegrator integrator(weights(), accumulation);
  std::vector<float> out(signal_count * width);
  SignalRows planes{};
  for (std::size_t s = 0; s < signals; ++s) planes[s] = out.data() + s * width;
  for (auto _ : state)
    for (std::size_t row = 0; row < rows; ++row) {
      integrator.integrate(image().data() + row * bands * width, width, width, planes);
      benchmark::DoNotOptimize(out.data());
    }
  set_bytes(state);
}
BENCHMARK_CAPTURE(integrate, lmsr_sums_in_double, Accumulation::dual, 4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(integrate, lmsr_sums_in_float, Accumulation::single, 4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(integrate, lmsr_and_xyz_in_double, Accumulation::dual, 7)->Unit(benchmark::kMillisecond);

// Four receptors, one after the other, as a first version would have it: pixel by pixel, band by band.
void naive_double_loop(benchmark::State& state) {
  std::vector<float> out(4 * width);
  for (auto _ : state)
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t i = 0; i < width; ++i)
        for (std::size_t s = 0; s < 4; ++s) {
          double sum = 0.0;
          for (std::size_t b = 0; b < bands; ++b)
            sum += weights().of[s][b] * static_cast<double>(image()[(row * bands + b) * width + i]);
          out[s * width + i] = static_cast<float>(sum);
          benchmark::DoNotOptimize(out.data());
        }
  set_bytes(state);
}
BENCHMARK(naive_double_loop)->Unit(benchmark::kMillisecond);

class File {
 public:
  explicit File(int compression) {
    test::TestImage spectral;
    spectral.width = 960;
    spectral.height = 540;
    spectral.compression = compression;
    spectral.parts = {test::band_channels(test::lit(test::reflectances("macbeth"), test::lamp("moon"), 0.05),
                                          spectral.width * spectral.height, test::band_centres(380, 5, 780),
                                          5, test::stokes_name)};
    test::write_exr(path(), spectral);
  }
  std::string path() const { return folder_ / "spectral.exr"; }

 private:
  test::TemporaryFolder folder_;
};

const File& file_of(int compression) {
  static const File none(Imf::NO_COMPRESSION), zip(Imf::ZIP_COMPRESSION);
  return compression == Imf::NO_COMPRESSION ? none : zip;
}

// All bands into memory, sixteen rows at a time, as OpenEXR alone does it best.
void read_with_openexr(benchmark::State& state, int compression) {
  const File& file = file_of(compression);
  set_threads(1);
  for (auto _ : state) {
    Imf::InputFile input(file.path().c_str());
    const int w = input.header().dataWindow().max.x + 1, h = input.header().dataWindow().max.y + 1;
    std::vector<float> room(static_cast<std::size_t>(w) * 16 * bands);
    for (int y = 0; y < h; y += 16) {
      Imf::FrameBuffer frame;
      std::size_t b = 0;
      const auto line = static_cast<std::size_t>(w) * sizeof(float);
      for (auto c = input.header().channels().begin(); c != input.header().channels().end(); ++c, ++b) {
        char* const at =
            reinterpret_cast<char*>(room.data()) + b * line - static_cast<std::ptrdiff_t>(line * bands) * y;
        frame.insert(c.name(), Imf::Slice(Imf::FLOAT, at, sizeof(float), line * bands));
      }
      input.setFrameBuffer(frame);
      input.readPixels(y, std::min(y + 15, h - 1));
      benchmark::DoNotOptimize(room.data());
    }
  }
}

void read_and_weigh(benchmark::State& state, int compression) {
  const File& file = file_of(compression);
  set_threads(1);
  SpectralOptions options;
  options.xyz = false;
  for (auto _ : state) {
    const auto source = open_spectral_source(file.path(), options, Limits{});
    Band band;
    each_band(source->subimages()[0], false, [&](int y0, int count) {
      source->read(0, y0, count, band);
      benchmark::DoNotOptimize(band.signals[0].data());
    });
  }
}
BENCHMARK_CAPTURE(read_with_openexr, uncompressed, Imf::NO_COMPRESSION)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_and_weigh, uncompressed, Imf::NO_COMPRESSION)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_with_openexr, zip, Imf::ZIP_COMPRESSION)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_and_weigh, zip, Imf::ZIP_COMPRESSION)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace scotopic

BENCHMARK_MAIN();
