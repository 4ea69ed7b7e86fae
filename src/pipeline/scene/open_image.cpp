#include "pipeline/scene/open_image.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "pipeline/rows/row_codec.h"
#include "pipeline/scene/angular_resolution.h"

namespace scotopic {
namespace {

// More of the light than this outside the bands changes what is seen: worth a line without being asked.
constexpr double noticeable_share = 0.01;

bool exists(const std::string& file) {
  struct stat info = {};
  return stat(file.c_str(), &info) == 0;
}

bool has_bands(const PixelSource& source) {
  for (const Subimage& subimage : source.subimages())
    for (const Channel& channel : subimage.channels)
      if (is_spectral_channel(channel.name)) return true;
  for (std::size_t i = 0; i < source.subimages().size(); ++i)
    for (const Attribute& attribute : source.attributes(i))
      if (attribute.name == "spectralLayoutVersion") return true;
  return false;
}

std::string shares_outside(const SpectralReport& report) {
  std::string text;
  for (const Signal signal : all_signals)
    text += fmt::format("{}{} {:.3g} %", text.empty() ? "" : ", ", signal_names[index(signal)],
                        100 * std::max(0.0, report.outside[index(signal)]));
  return text;
}

void describe(const SpectralSource& source, const SpectralOptions& options, const Notes& notes) {
  const SpectralReport& report = source.report();
  const std::string& file = source.file();
  for (const std::string& note : report.notes) notes.detail(fmt::format("{}: {}", file, note));
  if (report.kind == SpectralKind::receptors) return;
  notes.detail(fmt::format("{}: {} bands of {}, {:.6g} to {:.6g} nm, taken as {}", file, report.bands,
                           report.kind == SpectralKind::emissive ? "radiance" : "reflectance",
                           report.first_nm, report.last_nm,
                           options.sampling == BandSampling::bin ? "bins" : "points"));
  const double worst = *std::max_element(report.outside.begin(), report.outside.end());
  const std::string line =
      fmt::format("{}: outside the bands lies {} of {}", file, shares_outside(report),
                  report.kind == SpectralKind::emissive ? "equal-energy light" : "the light");
  worst > noticeable_share ? notes.note(line) : notes.detail(line);
}

}  // namespace

std::unique_ptr<PixelSource> open_input(const std::string& input, const SpectralOptions& options,
                                        const Limits& limits, const Notes& notes) {
  const bool pattern = is_wavelength_pattern(input) && !exists(input);
  if (!pattern) {
    std::unique_ptr<PixelSource> source = open_source(input, limits);
    const bool spectral = has_bands(*source) || !options.receptor_channels.empty();
    if (source->format() != "openexr" || !spectral) return source;
  }
  std::unique_ptr<SpectralSource> source = open_spectral_source(input, options, limits);
  if (!source) return open_source(input, limits);
  describe(*source, options, notes);
  return source;
}

std::optional<SpectralReport> spectral_report_of(const PixelSource& source) {
  const auto* spectral = dynamic_cast<const SpectralSource*>(&source);
  return spectral ? std::optional(spectral->report()) : std::nullopt;
}

bool OpenImage::has_receptors() const {
  return std::any_of(layout.light.begin(), layout.light.end(),
                     [](const LightSubimage& light) { return scotopic::has_receptors(light.channels); });
}

OpenImage open_image(const ImageSettings& settings, const std::string& input, const std::string& output,
                     const Notes& notes) {
  OpenImage image;
  image.source = open_input(input, settings.spectral, settings.limits, notes);
  image.layout = plan_layout(*image.source, output, settings.config, settings.request);
  image.layout.wraps = is_panorama(settings.viewing, *image.source, image.layout);
  image.known = known_numbers(settings.choice, *image.source, image.layout, notes);
  return image;
}

OpenImage open_to_read(const ImageSettings& settings, const std::string& input, const Notes& notes) {
  OpenImage image;
  image.source = open_input(input, settings.spectral, settings.limits, notes);
  image.layout = read_layout(*image.source, settings.config, settings.request);
  image.layout.wraps = is_panorama(settings.viewing, *image.source, image.layout);
  image.known = known_numbers(settings.choice, *image.source, image.layout, notes);
  return image;
}

std::string input_space_text(const ImageLayout& layout) {
  const LightSubimage& light = layout.light.front();
  return fmt::format("colour space {} ({})", light.space.name, light.space_reason);
}

std::string space_text(const ImageLayout& layout) {
  return fmt::format("{}, written as {}", input_space_text(layout), layout.output_space.name);
}

void describe_layout(const PixelSource& source, const ColourConfig& config, const ImageLayout& layout,
                     const Notes& notes) {
  const LightSubimage& light = layout.light.front();
  const Window& w = source.subimages()[light.index].data;
  notes.detail(fmt::format("{}: {} x {} pixels, {}, {} pictures, {} with light", source.file(), w.width(),
                           w.height(), source.format(), source.subimages().size(), layout.light.size()));
  notes.detail(fmt::format("config {}, working space {}", config.file().empty() ? "built in" : config.file(),
                           config.working_space()));
  for (const std::string& note : layout.notes) notes.note(source.file() + ": " + note);
  for (const Attribute& a : source.attributes(light.index))
    if (a.name == "scotopic:model")
      notes.note(source.file() + ": has been through scotopic already; this is the second time");
}

}  // namespace scotopic
