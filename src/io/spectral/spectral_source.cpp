#include "io/spectral/spectral_source.h"

#include <Imath/ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <set>

#include "base/error.h"
#include "io/exr/exr_headers.h"
#include "io/exr/exr_source.h"
#include "io/exr/exr_tags.h"
#include "io/exr/open_exr.h"
#include "io/pixels/row_bands.h"
#include "io/spectral/spectral_header.h"
#include "receptors/illuminant.h"
#include "receptors/receptor_space.h"

namespace scotopic {
namespace {

// Bands of so many bytes are read before they are weighed: enough to keep threads busy, small enough for
// caches.
constexpr std::size_t bytes_at_once = std::size_t{16} << 20;

/// A channel somewhere in the files.
struct Place {
  std::size_t file;
  int part;
  std::string channel;
  Imf::PixelType type;
};

Window window(const Imath::Box2i& box) { return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1}; }

std::string one_line(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  while (!line.empty() && line.back() == '.') line.pop_back();
  return line;
}

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
  void add_file(const std::string& name, const Limits& limits);
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
  Imf::MultiPartInputFile& at(std::size_t file) { return *files_[file]; }
  const Imf::Header& header_of(const Place& place) const { return files_[place.file]->header(place.part); }

  std::vector<std::string> names_;
  std::vector<WavelengthFile> sequence_;
  std::vector<std::unique_ptr<Imf::MultiPartInputFile>> files_;
  std::vector<Place> channels_;  // every channel of every file
  SpectralLayout layout_;
  std::vector<Place> bands_;   // those that weigh something
  std::vector<Place> passed_;  // those handed on as they are
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
    for (const WavelengthFile& one : sequence_) add_file(one.file, limits);
  } else {
    add_file(file(), limits);
  }
}

void ExrSpectralSource::add_file(const std::string& name, const Limits& limits) {
  names_.push_back(name);
  watch(name);
  check_exr_headers(name, limits);
  const std::size_t file_index = files_.size();
  files_.push_back(open_exr(name));
  Imf::MultiPartInputFile& opened = *files_.back();
  for (int part = 0; part < opened.parts(); ++part) {
    if (!opened.partComplete(part))
      throw Error(ExitCode::input, name, "is truncated: it was not written to its end");
    if (opened.header(part).hasType() && !Imf::isImage(opened.header(part).type())) continue;  // deep
    const Imf::ChannelList& list = opened.header(part).channels();
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
      const bool whole = channel.channel().xSampling == 1 && channel.channel().ySampling == 1;
      if (whole) channels_.push_back({file_index, part, channel.name(), channel.channel().type});
    }
  }
}

bool ExrSpectralSource::find_bands(const SpectralOptions& options) {
  if (!sequence_.empty()) {
    find_bands_of_files();
    return true;
  }
  std::vector<ChannelName> names;
  for (const Place& place : channels_)
    names.push_back({place.channel, wavelength_attribute(header_of(place), place.channel)});
  if (!options.receptor_channels.empty()) {
    layout_ = receptor_layout(names, options.receptor_channels, file());
    return true;
  }
  auto found = find_spectral_layout(names, options.layer, file());
  if (!found) {
    for (int part = 0; part < at(0).parts(); ++part)
      if (at(0).header(part).find("spectralLayoutVersion") != at(0).header(part).end())
        fail("says it is spectral but has no band");
    return false;
  }
  layout_ = std::move(*found);
  return true;
}

// One colour channel a file: whatever it is called.
void ExrSpectralSource::find_bands_of_files() {
  for (std::size_t i = 0; i < sequence_.size(); ++i) {
    std::vector<std::size_t> candidates;
    for (std::size_t c = 0; c < channels_.size(); ++c)
      if (channels_[c].file == i && channels_[c].channel != "A") candidates.push_back(c);
    if (candidates.size() != 1)
      throw Error(ExitCode::input, sequence_[i].file,
                  fmt::format("has {} channels where a file of one wavelength has one", candidates.size()));
    layout_.bands.push_back({candidates[0], sequence_[i].nm});
  }
}

void ExrSpectralSource::check_places() const {
  const Place& first = channels_[layout_.bands.front().channel];
  for (const SpectralBand& band : layout_.bands) {
    const Place& place = channels_[band.channel];
    if (place.type == Imf::UINT) fail(fmt::format("channel \"{}\" holds integers, not light", place.channel));
    if (header_of(place).dataWindow() != header_of(first).dataWindow())
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
  const Imf::Header& any = header_of(channels_[layout_.bands.front().channel]);
  const std::string units = text_attribute(any, "emissiveUnits");
  const auto [unit, why] = band_unit_of(units, options.band_unit);
  (states_radiance(units) || options.band_unit ? report_.notes : layout_.notes).push_back(why);
  return emissive_weights(grid, options.sampling, unit);
}

namespace {

// nm; eight bands over the visible, the fewest that renderers use, lie 50 apart.
constexpr double widest_usual_step = 51;

/// What lies between neighbours, as far as it is within 380 to 780 nm; `centres` rise.
double widest_visible_step(const std::vector<double>& centres) {
  double widest = 0;
  for (std::size_t i = 1; i < centres.size(); ++i)
    widest = std::max(widest, std::min(centres[i], 780.0) - std::max(centres[i - 1], 380.0));
  return widest;
}

}  // namespace

void ExrSpectralSource::weigh(const SpectralOptions& options) {
  for (int part = 0; part < at(0).parts(); ++part) {
    const std::string version = text_attribute(at(0).header(part), "spectralLayoutVersion");
    if (version.empty() || version == "1.0") continue;
    layout_.notes.push_back("spectralLayoutVersion \"" + version + "\" is read as \"1.0\"");
    break;
  }
  report_.kind = layout_.kind;
  report_.bands = layout_.bands.size();
  if (layout_.kind == SpectralKind::receptors) {
    for (const SpectralBand& band : layout_.bands) bands_.push_back(channels_[band.channel]);
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
    bands_.push_back(channels_[layout_.bands[band].channel]);
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
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const Place& place = channels_[c];
    const bool band = std::any_of(layout_.bands.begin(), layout_.bands.end(),
                                  [c](const SpectralBand& b) { return b.channel == c; });
    if (band || is_spectral_channel(place.channel)) continue;  // Stokes components, other layers
    if (header_of(place).dataWindow() != header_of(bands_.front()).dataWindow()) continue;
    if (taken.insert(place.channel).second) passed_.push_back(place);
  }
}

void ExrSpectralSource::describe_subimage(const Limits& limits) {
  Subimage subimage;
  const Imf::Header& first = header_of(bands_.front());
  subimage.data = window(first.dataWindow());
  subimage.display = window(first.displayWindow());
  list_other_channels();
  for (const Place& place : passed_) subimage.channels.push_back({place.channel, pixel_type(place.type)});
  for (const Place& place : bands_)
    subimage.chunk_rows = std::max(subimage.chunk_rows, rows_compressed_together(header_of(place)));
  if (report_.kind != SpectralKind::reflective) subimage.white_luminance = 1.0;
  subimage.notes = layout_.notes;  // what is left out is said, how the rest is read only when asked
  subimage.computed_bytes = signals_ * sizeof(float);
  band_type_ = std::all_of(bands_.begin(), bands_.end(), [](const Place& p) { return p.type == Imf::HALF; })
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
    throw Error(ExitCode::input, names_.empty() ? file() : names_.back(),
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
  return attributes_without_spectral_ones(header_of(bands_.front()));
}

void ExrSpectralSource::read_rows(int y0, int rows, Band& band) {
  const Window& window = subimages_[0].data;
  const std::size_t size = band_type_ == Imf::HALF ? 2 : 4;
  const std::size_t line = size * static_cast<std::size_t>(window.width());
  buffer_.resize(line * bands_.size() * static_cast<std::size_t>(rows));
  std::set<std::pair<std::size_t, int>> parts;
  for (const auto* places : {&bands_, &passed_})
    for (const Place& place : *places) parts.insert({place.file, place.part});
  const auto slice = [&](Imf::PixelType type, std::byte* data, std::size_t x_stride, std::size_t y_stride) {
    const auto origin = reinterpret_cast<std::intptr_t>(data) -
                        static_cast<std::intptr_t>(x_stride) * window.x0 -
                        static_cast<std::intptr_t>(y_stride) * y0;
    return Imf::Slice(type, reinterpret_cast<char*>(origin), x_stride, y_stride);
  };
  for (const auto& [file_index, part] : parts) {
    Imf::FrameBuffer frame;
    for (std::size_t b = 0; b < bands_.size(); ++b)
      if (bands_[b].file == file_index && bands_[b].part == part)
        frame.insert(bands_[b].channel,
                     slice(band_type_, buffer_.data() + b * line, size, bands_.size() * line));
    for (std::size_t c = 0; c < passed_.size(); ++c)
      if (passed_[c].file == file_index && passed_[c].part == part) {
        const ChannelRows& to = band.channels[c];
        frame.insert(passed_[c].channel,
                     slice(exr_type(to.type), to.data + (y0 - band.y0) * to.row_stride,
                           static_cast<std::size_t>(to.stride), static_cast<std::size_t>(to.row_stride)));
      }
    Imf::InputPart input(at(file_index), part);
    input.setFrameBuffer(frame);
    try {
      input.readPixels(y0, y0 + rows - 1);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw Error(ExitCode::input, names_[file_index],
                  fmt::format("damaged or cut short: {}", one_line(error.what())));
    }
  }
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
