#include "cli/options/spectral_options.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "cli/options/values.h"
#include "io/spectral/spectrum_file.h"
#include "receptors/illuminant.h"

namespace scotopic {
namespace {

// More of the light than this outside the bands changes what is seen: worth a line without being asked.
constexpr double noticeable_share = 0.01;

constexpr std::array<const char*, signal_count> signal_names = {"L", "M", "S", "rods", "X", "Y", "Z"};

bool exists(const std::string& file) {
  struct stat info = {};
  return stat(file.c_str(), &info) == 0;
}

bool has_bands(const PixelSource& source) {
  for (const Picture& picture : source.pictures())
    for (const Channel& channel : picture.channels)
      if (is_spectral_channel(channel.name)) return true;
  for (std::size_t i = 0; i < source.pictures().size(); ++i)
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

void describe(const SpectralSource& source, const SpectralOptions& options, const Console& console) {
  const SpectralReport& report = source.report();
  const std::string& file = source.file();
  for (const std::string& note : report.notes) console.detail(fmt::format("{}: {}", file, note));
  if (report.kind == SpectralKind::receptors) return;
  console.detail(fmt::format("{}: {} bands of {}, {:.6g} to {:.6g} nm, taken as {}", file, report.bands,
                             report.kind == SpectralKind::emissive ? "radiance" : "reflectance",
                             report.first_nm, report.last_nm,
                             options.sampling == BandSampling::bin ? "bins" : "points"));
  const double worst = *std::max_element(report.outside.begin(), report.outside.end());
  const std::string line =
      fmt::format("{}: outside the bands lies {} of {}", file, shares_outside(report),
                  report.kind == SpectralKind::emissive ? "equal-energy light" : "the light");
  worst > noticeable_share ? console.note(line) : console.detail(line);
}

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    names.push_back(list.substr(at, comma - at));
    at = comma + 1;
  }
  return names;
}

}  // namespace

void add_band_options(CLI::App& verb, BandOptions& o) {
  const auto add = [&](const char* name, std::string& value, const char* text, const char* kind) {
    verb.add_option(name, value, text)->type_name(kind)->group("Spectral input");
  };
  add("--bands", o.bands, "Values are means over their bins (bin, default) or samples (point)", "NAME");
  add("--band-radiance", o.radiance,
      "per nm (nm) or of the whole band (band); else what the file says, else nm", "NAME");
  add("--receptor-channels", o.receptors, "Four channels weighed with l, m, s, V' of peak 1, in W/(m2 sr)",
      "L,M,S,R");
}

// Of light of one wavelength it runs from 6e-4 (700 nm) to 59 (400 nm); of anything that has a luminance it lies within.
constexpr double least_sp_ratio = 1e-3, greatest_sp_ratio = 1e3;

IlluminantChoice understand_illuminant(const std::string& text) {
  IlluminantChoice choice;
  choice.name = text;
  if (const std::optional<double> ratio = parse_sp_ratio(text)) {
    if (!(*ratio >= least_sp_ratio && *ratio <= greatest_sp_ratio))
      fail_value("--illuminant", text, "an S/P ratio from 0.001 to 1000");
    choice.sp_ratio = *ratio;
    choice.spectrum = illuminant_spectrum(text);
    return choice;
  }
  if (exists(text)) {
    choice.spectrum = read_spectrum_file(text);
    choice.sp_ratio = sp_ratio(choice.spectrum->curve());
    return choice;
  }
  std::vector<std::string> names;
  for (const NamedIlluminant& illuminant : named_illuminants()) names.emplace_back(illuminant.name);
  fail_value("--illuminant", text,
             "an S/P ratio from 0.001 to 1000, a file with a spectrum, or one of " + illuminant_names() +
                 did_you_mean(text, names));
}

SpectralOptions understand(const BandOptions& o, const IlluminantChoice& illuminant,
                           const std::string& layer) {
  SpectralOptions out;
  out.layer = layer;
  out.sampling =
      choice<BandSampling>("--bands", o.bands, {{"bin", BandSampling::bin}, {"point", BandSampling::point}});
  if (!o.radiance.empty())
    out.band_unit = choice<BandUnit>("--band-radiance", o.radiance,
                                     {{"nm", BandUnit::per_nm}, {"band", BandUnit::per_band}});
  if (!o.receptors.empty()) {
    out.receptor_channels = names_in(o.receptors);
    if (out.receptor_channels.size() != 4)
      fail_value("--receptor-channels", o.receptors, "four names, apart by commas");
  }
  out.illuminant = illuminant.spectrum;
  out.illuminant_name = illuminant.name;
  return out;
}

std::unique_ptr<PixelSource> open_input(const std::string& input, const SpectralOptions& options,
                                        const Limits& limits, const Console& console) {
  const bool pattern = is_wavelength_pattern(input) && !exists(input);
  if (!pattern) {
    std::unique_ptr<PixelSource> source = open_source(input, limits);
    const bool spectral = has_bands(*source) || !options.receptor_channels.empty();
    if (source->format() != "openexr" || !spectral) return source;
  }
  std::unique_ptr<SpectralSource> source = open_spectral_source(input, options, limits);
  if (!source) return open_source(input, limits);
  describe(*source, options, console);
  return source;
}

nlohmann::ordered_json spectral_report(const PixelSource& source) {
  const auto* spectral = dynamic_cast<const SpectralSource*>(&source);
  if (spectral == nullptr) return nullptr;
  const SpectralReport& report = spectral->report();
  nlohmann::ordered_json out;
  out["kind"] = report.kind == SpectralKind::emissive     ? "radiance"
                : report.kind == SpectralKind::reflective ? "reflectance"
                                                          : "receptors";
  out["notes"] = report.notes;
  if (report.kind == SpectralKind::receptors) return out;
  out["bands"] = report.bands;
  out["firstNm"] = report.first_nm;
  out["lastNm"] = report.last_nm;
  for (const Signal signal : all_signals)
    out["outside"][signal_names[index(signal)]] = report.outside[index(signal)];
  return out;
}

}  // namespace scotopic
