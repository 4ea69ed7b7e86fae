#include "options/spectral_options.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "io/spectral/spectrum_file.h"
#include "options/values.h"
#include "receptors/illuminant.h"

namespace scotopic {
namespace {

bool exists(const std::string& file) {
  struct stat info = {};
  return stat(file.c_str(), &info) == 0;
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
  const TextOptions add{verb, "Spectral input"};
  add("--bands", o.bands, "Values are means over their bins (bin, default) or samples (point)", "NAME");
  add("--band-radiance", o.radiance,
      "per nm (nm) or of the whole band (band); else what the file says, else nm", "NAME");
  add("--receptor-channels", o.receptors, "Four channels weighed with l, m, s, V' of peak 1, in W/(m2 sr)",
      "L,M,S,R");
}

// Of light of one wavelength it runs from 6e-4 (700 nm) to 59 (400 nm); of anything that has a luminance it
// lies within.
constexpr double least_sp_ratio = 1e-3, greatest_sp_ratio = 1e3;

IlluminantChoice parse_illuminant(const std::string& text) {
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

SpectralOptions parse(const BandOptions& o, const IlluminantChoice& illuminant, const std::string& layer) {
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

}  // namespace scotopic
