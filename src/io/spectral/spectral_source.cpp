#include "io/spectral/spectral_source.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <set>

#include "base/error.h"
#include "io/exr/exr_source.h"
#include "io/exr/exr_tags.h"
#include "io/pixels/row_bands.h"
#include "io/spectral/spectral_files.h"
#include "io/spectral/spectral_header.h"
#include "receptors/illuminant.h"
#include "receptors/receptor_space.h"

namespace scotopic {
namespace {

// Bands of so many bytes are read before they are weighed: enough to keep threads busy, small enough for
// caches.
constexpr std::size_t bytes_at_once = std::size_t{16} << 20;

class ExrSpectralSource final : public SpectralSource {
 public:
  ExrSpectralSource(const std::string& file, const SpectralOptions& options)
      : SpectralSource(file, "openexr") {
    accumulation_ = options.accumulation;
    signals_ = options.xyz ? signal_count : index(Signal::x);
  }

  /// False if there are no bands.
  bool open(const SpectralOptions& options, const Limits& limits);

  void read(std::size_t index, int y0, int rows, Band& band) override;
  ColourChannels colour(std::size_t index, const std::string& layer) const override;
  std::vector<Attribute> attributes(std::size_t index) const override;

 private:
  void open_files(const Limits& limits);
  bool find_bands(const SpectralOptions& options);
  void find_bands_of_files();
  void check_places() const;
  void weigh(const SpectralOptions& options);
  SpectralWeights weights(const BandGrid& grid, const SpectralOptions& options);
  void keep_weighed_bands(SpectralWeights weights);
  void describe_subimage(const Limits& limits);
  void list_other_channels();
  void read_rows(int y0, int rows, Band& band);
  void weigh_rows(int first, int rows, Band& band) const;
  void copy_receptors(const float* from, std::size_t count, const SignalRows& out) const;

  SpectralFiles files_;
  std::vector<WavelengthFile> sequence_;
  SpectralLayout layout_;
  std::vector<ChannelPlace> bands_;   // those that weigh something
  std::vector<ChannelPlace> passed_;  // those handed on as they are
  Imf::PixelType band_type_ = Imf::FLOAT;
  Accumulation accumulation_ = Accumulation::dual;
  std::size_t signals_ = signal_count;
  std::optional<SpectralIntegrator> integrator_;
  std::vector<std::byte> buffer_;  // [row][band][x]
};

void ExrSpectralSource::open_files(const Limits& limits) {
  if (is_wavelength_pattern(file())) {
    sequence_ = files_of_pattern(file());
    check_limit(file(), "files", static_cast<std::int64_t>(sequence_.size()), limits.bands, "--max-bands");
  }
  const auto add = [&](const std::string& name) {
    watch(name);
    files_.add(name, limits);
  };
  for (const WavelengthFile& one : sequence_) add(one.file);
  if (sequence_.empty()) add(file());
}

bool ExrSpectralSource::find_bands(const SpectralOptions& options) {
  if (!sequence_.empty()) {
    find_bands_of_files();
    return true;
  }
  std::vector<ChannelName> names;
  for (const ChannelPlace& place : files_.channels())
    names.push_back({place.channel, wavelength_attribute(files_.header_of(place), place.channel)});
  if (!options.receptor_channels.empty()) {
    layout_ = receptor_layout(names, options.receptor_channels, file());
    return true;
  }
  auto found = find_spectral_layout(names, options.layer, file());
  if (!found) {
    for (const Imf::Header* header : files_.headers())
      if (header->find("spectralLayoutVersion") != header->end()) fail("says it is spectral but has no band");
    return false;
  }
  layout_ = std::move(*found);
  return true;
}

// One colour channel a file: whatever it is called.
void ExrSpectralSource::find_bands_of_files() {
  for (std::size_t i = 0; i < sequence_.size(); ++i) {
    std::vector<std::size_t> candidates;
    for (std::size_t c = 0; c < files_.channels().size(); ++c)
      if (files_.channels()[c].file == i && files_.channels()[c].channel != "A") candidates.push_back(c);
    if (candidates.size() != 1)
      throw Error(ExitCode::input, sequence_[i].file,
                  fmt::format("has {} channels where a file of one wavelength has one", candidates.size()));
    layout_.bands.push_back({candidates[0], sequence_[i].nm});
  }
}

void ExrSpectralSource::check_places() const {
  const ChannelPlace& first = files_.channels()[layout_.bands.front().channel];
  for (const SpectralBand& band : layout_.bands) {
    const ChannelPlace& place = files_.channels()[band.channel];
    if (place.type == Imf::UINT) fail(fmt::format("channel \"{}\" holds integers, not light", place.channel));
    if (files_.header_of(place).dataWindow() != files_.header_of(first).dataWindow())
      fail(fmt::format("channel \"{}\" has another data window than \"{}\"", place.channel, first.channel));
  }
}

SpectralWeights ExrSpectralSource::weights(const BandGrid& grid, const SpectralOptions& options) {
  if (layout_.kind == SpectralKind::reflective) {
    report_.notes.push_back(fmt::format("reflectance lit by {}", options.illuminant_name));
    const auto named = options.illuminant ? options.illuminant : illuminant_spectrum(options.illuminant_name);
    if (!named)
      throw Error(
          ExitCode::usage, "",
          fmt::format("reflectance needs an illuminant's spectrum, not \"{}\"", options.illuminant_name));
    return reflective_weights(grid, options.sampling, named->curve());
  }
  const Imf::Header& any = files_.header_of(files_.channels()[layout_.bands.front().channel]);
  const std::string units = text_attribute(any, "emissiveUnits");
  const auto [unit, why] = band_unit_of(units, options.band_unit);
  (states_radiance(units) || options.band_unit ? report_.notes : layout_.notes).push_back(why);
  return emissive_weights(grid, options.sampling, unit);
}

void ExrSpectralSource::weigh(const SpectralOptions& options) {
  if (const std::string version = later_layout(files_.headers()); !version.empty())
    layout_.notes.push_back("spectralLayoutVersion \"" + version + "\" is read as \"1.0\"");
  report_.kind = layout_.kind;
  report_.bands = layout_.bands.size();
  if (layout_.kind == SpectralKind::receptors) {
    for (const SpectralBand& band : layout_.bands) bands_.push_back(files_.channels()[band.channel]);
    report_.notes.emplace_back(
        "receptor channels taken as integrals of W/(m2 sr nm) over l, m, s and V' of peak 1");
    return;
  }
  if (layout_.bands.size() < 2) fail("has a single band, which has no width");
  std::vector<double> centres;
  for (const SpectralBand& band : layout_.bands) centres.push_back(band.nm);
  report_.first_nm = centres.front();
  report_.last_nm = centres.back();
  if (const double step = widest_visible_step(centres); step > widest_usual_step)
    layout_.notes.push_back(fmt::format("up to {:.4g} nm of the visible lie between two bands", step));
  keep_weighed_bands(weights(BandGrid(std::move(centres)), options));
}

void ExrSpectralSource::keep_weighed_bands(SpectralWeights all) {
  report_.outside = all.outside;
  const std::vector<bool> weighed = weighed_bands(all);
  SpectralWeights kept;
  for (std::size_t band = 0; band < weighed.size(); ++band) {
    if (!weighed[band]) continue;
    bands_.push_back(files_.channels()[layout_.bands[band].channel]);
    for (std::size_t s = 0; s < signal_count; ++s) kept.of[s].push_back(all.of[s][band]);
  }
  if (bands_.empty())
    fail(fmt::format("has no visible band, only {:.6g} to {:.6g} nm", report_.first_nm, report_.last_nm));
  if (bands_.size() < weighed.size())
    report_.notes.push_back(
        fmt::format("{} bands outside the visible are not read", weighed.size() - bands_.size()));
  integrator_.emplace(kept, accumulation_);
}

// Everything but bands and the preview made of them; the parts that have the bands' window.
void ExrSpectralSource::list_other_channels() {
  std::set<std::string> taken = {"R", "G", "B"};
  for (std::size_t c = 0; c < files_.channels().size(); ++c) {
    const ChannelPlace& place = files_.channels()[c];
    const bool band = std::any_of(layout_.bands.begin(), layout_.bands.end(),
                                  [c](const SpectralBand& b) { return b.channel == c; });
    if (band || is_spectral_channel(place.channel)) continue;  // Stokes components, other layers
    if (files_.header_of(place).dataWindow() != files_.header_of(bands_.front()).dataWindow()) continue;
    if (taken.insert(place.channel).second) passed_.push_back(place);
  }
}

void ExrSpectralSource::describe_subimage(const Limits& limits) {
  Subimage subimage;
  const Imf::Header& first = files_.header_of(bands_.front());
  subimage.data = window_of(first.dataWindow());
  subimage.display = window_of(first.displayWindow());
  list_other_channels();
  for (const ChannelPlace& place : passed_)
    subimage.channels.push_back({place.channel, pixel_type(place.type)});
  for (const ChannelPlace& place : bands_)
    subimage.chunk_rows = std::max(subimage.chunk_rows, rows_compressed_together(files_.header_of(place)));
  if (report_.kind != SpectralKind::reflective) subimage.white_luminance = 1.0;
  subimage.notes = layout_.notes;  // what is left out is said, how the rest is read only when asked
  subimage.computed_bytes = signals_ * sizeof(float);
  band_type_ =
      std::all_of(bands_.begin(), bands_.end(), [](const ChannelPlace& p) { return p.type == Imf::HALF; })
          ? Imf::HALF
          : Imf::FLOAT;
  if (!integrator_) band_type_ = Imf::FLOAT;
  subimages_.push_back(subimage);
  check_limits(limits);
  const auto row = static_cast<std::int64_t>(bands_.size() * sizeof(float)) * subimage.data.width();
  check_limit(file(), "bytes of memory planned", planned_bytes(subimage) + row * subimage.chunk_rows,
              limits.memory, "--max-memory");
}

bool ExrSpectralSource::open(const SpectralOptions& options, const Limits& limits) {
  try {
    const auto side = static_cast<int>(std::min<std::int64_t>(limits.side, INT32_MAX));
    Imf::Header::setMaxImageSize(side, side);
    Imf::Header::setMaxTileSize(side, side);
    open_files(limits);
    if (!find_bands(options)) return false;
    check_limit(file(), "bands", static_cast<std::int64_t>(layout_.bands.size()), limits.bands,
                "--max-bands");
    check_places();
    weigh(options);
    describe_subimage(limits);
    return true;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ExitCode::input, files_.last_name().empty() ? file() : files_.last_name(),
                fmt::format("cannot be read: {}", one_line(error.what())));
  }
}

ColourChannels ExrSpectralSource::colour(std::size_t, const std::string&) const {
  ColourChannels colour;
  colour.kind = ColourChannels::Kind::computed;
  for (std::size_t c = 0; c < passed_.size(); ++c)
    if (passed_[c].channel == "A") colour.alpha = c;
  return colour;
}

std::vector<Attribute> ExrSpectralSource::attributes(std::size_t) const {
  return attributes_without_spectral_ones(files_.header_of(bands_.front()));
}

void ExrSpectralSource::read_rows(int y0, int rows, Band& band) {
  const Window& window = subimages_[0].data;
  const std::size_t size = band_type_ == Imf::HALF ? 2 : 4;
  const std::size_t line = size * static_cast<std::size_t>(window.width());
  buffer_.resize(line * bands_.size() * static_cast<std::size_t>(rows));
  const auto slice = [&](Imf::PixelType type, std::byte* data, std::size_t x_stride, std::size_t y_stride) {
    const auto origin = reinterpret_cast<std::intptr_t>(data) -
                        static_cast<std::intptr_t>(x_stride) * window.x0 -
                        static_cast<std::intptr_t>(y_stride) * y0;
    return Imf::Slice(type, reinterpret_cast<char*>(origin), x_stride, y_stride);
  };
  std::vector<ChannelTarget> targets;
  for (std::size_t b = 0; b < bands_.size(); ++b)
    targets.push_back({&bands_[b], slice(band_type_, buffer_.data() + b * line, size, bands_.size() * line)});
  for (std::size_t c = 0; c < passed_.size(); ++c) {
    const ChannelRows& to = band.channels[c];
    targets.push_back(
        {&passed_[c], slice(exr_type(to.type), to.data + (y0 - band.y0) * to.row_stride,
                            static_cast<std::size_t>(to.stride), static_cast<std::size_t>(to.row_stride))});
  }
  files_.read(y0, rows, targets);
}

void ExrSpectralSource::copy_receptors(const float* from, std::size_t count, const SignalRows& out) const {
  const double k = luminance_units_per_watt();
  const Matrix3<double>& xyz = xyz_from_lms();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<double> lms = {k * from[i], k * from[count + i], k * from[2 * count + i]};
    const Vec3<double> colour = xyz * lms;
    for (std::size_t s = 0; s < 3; ++s) {
      out[s][i] = static_cast<float>(lms[s]);
      if (float* const plane = out[index(Signal::x) + s]) plane[i] = static_cast<float>(colour[s]);
    }
    out[index(Signal::rod)][i] = static_cast<float>(k * from[3 * count + i]);
  }
}

void ExrSpectralSource::weigh_rows(int first, int rows, Band& band) const {
  const auto width = static_cast<std::size_t>(band.width);
  const std::size_t row_values = width * bands_.size();
  const auto weigh_row = [&](std::size_t r) {
    SignalRows out{};
    for (std::size_t s = 0; s < signals_; ++s)
      out[s] = band.signals[s].data() + (static_cast<std::size_t>(first - band.y0) + r) * width;
    if (!integrator_) {
      copy_receptors(reinterpret_cast<const float*>(buffer_.data()) + r * row_values, width, out);
    } else if (band_type_ == Imf::HALF) {
      const auto* half = reinterpret_cast<const std::uint16_t*>(buffer_.data());
      integrator_->integrate_half(half + r * row_values, width, width, out);
    } else {
      integrator_->integrate(reinterpret_cast<const float*>(buffer_.data()) + r * row_values, width, width,
                             out);
    }
  };
  parallel_rows(rows, 4, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) weigh_row(static_cast<std::size_t>(row));
  });
}

void ExrSpectralSource::read(std::size_t, int y0, int rows, Band& band) {
  const Subimage& subimage = subimages_[0];
  band.allocate_planar(subimage.channels, y0, rows, subimage.data.width());
  const auto pixels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(band.width);
  for (std::size_t s = 0; s < signals_; ++s) band.signals[s].resize(pixels);
  const std::size_t row = bands_.size() * sizeof(float) * static_cast<std::size_t>(band.width);
  const auto chunk = static_cast<std::size_t>(subimage.chunk_rows);
  const int step = static_cast<int>(chunk * std::max<std::size_t>(1, bytes_at_once / (row * chunk)));
  for (int y = y0; y < y0 + rows; y += step) {
    const int count = std::min(step, y0 + rows - y);
    read_rows(y, count, band);
    weigh_rows(y, count, band);
  }
}

}  // namespace

std::unique_ptr<SpectralSource> open_spectral_source(const std::string& file, const SpectralOptions& options,
                                                     const Limits& limits) {
  auto source = std::make_unique<ExrSpectralSource>(file, options);
  if (!source->open(options, limits)) return nullptr;
  return source;
}

}  // namespace scotopic
