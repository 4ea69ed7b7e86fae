#include "looks/lut/look_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "looks/chain/number_text.h"

namespace scotopic {
namespace {

constexpr std::string_view marker = "parameters: ";

template <typename Enum>
struct Word {
  Enum value;
  std::string_view name;
};
constexpr std::array<Word<Model>, 4> models = {{{Model::filament2021, "filament2021"},
                                                {Model::kirk2011, "kirk2011"},
                                                {Model::safko2019, "safko2019"},
                                                {Model::cao2008, "cao2008"}}};
constexpr std::array<Word<Weight>, 2> weights = {{{Weight::local, "local"}, {Weight::global, "global"}}};
constexpr std::array<Word<LuminancePolicy>, 3> policies = {{{LuminancePolicy::mesopic, "mesopic"},
                                                            {LuminancePolicy::photopic, "photopic"},
                                                            {LuminancePolicy::none, "none"}}};
constexpr std::array<Word<RodEstimate>, 2> estimates = {
    {{RodEstimate::linear, "linear"}, {RodEstimate::quadratic, "quadratic"}}};

constexpr std::array<Word<VisibilityRule>, 2> rules = {
    {{VisibilityRule::hdrvdp2, "hdrvdp2"}, {VisibilityRule::ward1997, "ward1997"}}};

template <typename Words, typename Enum>
std::string_view word(const Words& words, Enum value) {
  for (const auto& w : words)
    if (w.value == value) return w.name;
  return words[0].name;
}

std::string vector_text(const Vec3<double>& v) {
  return number_text(v[0]) + " " + number_text(v[1]) + " " + number_text(v[2]);
}

std::string matrix_text(const Matrix3<double>& m) {
  return vector_text(m[0]) + " " + vector_text(m[1]) + " " + vector_text(m[2]);
}

/// key=value pairs of one line; any failure to read a value is remembered.
class LineValues {
 public:
  explicit LineValues(std::string_view line) {
    while (!line.empty()) {
      const std::size_t end = std::min(line.find("; "), line.size());
      const std::string_view pair = line.substr(0, end);
      const std::size_t equals = pair.find('=');
      if (equals != std::string_view::npos)
        values_[std::string(pair.substr(0, equals))] = pair.substr(equals + 1);
      line.remove_prefix(std::min(end + 2, line.size()));
    }
  }

  bool whole() const { return whole_; }
  std::string text(const std::string& key) {
    const auto found = values_.find(key);
    whole_ &= found != values_.end();
    return found != values_.end() ? std::string(found->second) : "";
  }
  void read(const std::string& key, double low, double high, double& out) {
    const std::string value = text(key);
    read_number(value.data(), value.data() + value.size(), out);
    whole_ &= out >= low && out <= high;
  }
  template <typename Words, typename Enum>
  void read(const std::string& key, const Words& words, Enum& out) {
    const std::string value = text(key);
    bool known = false;
    for (const auto& w : words)
      if (w.name == value) out = w.value, known = true;
    whole_ &= known;
  }
  void read(const std::string& key, Matrix3<double>& out) {
    std::array<double, 9> numbers{};
    read(key, numbers);
    for (std::size_t i = 0; i < numbers.size(); ++i) out[i / 3][i % 3] = numbers[i];
    whole_ &= std::abs(determinant(out)) > 1e-9;
  }
  void read(const std::string& key, double low, double high, Vec3<double>& out) {
    read(key, out);
    for (const double x : out) whole_ &= x >= low && x <= high;
  }

 private:
  template <std::size_t count>
  void read(const std::string& key, std::array<double, count>& out) {
    const std::string value = text(key);
    const char* at = value.data();
    const char* end = at + value.size();
    for (double& x : out) {
      while (at < end && *at == ' ') ++at;
      at = read_number(at, end, x);
    }
    whole_ &= at == end;
  }
  const char* read_number(const char* at, const char* end, double& out) {
    const auto result = std::from_chars(at, end, out);
    whole_ &= result.ec == std::errc() && std::isfinite(out);
    return result.ptr;
  }

  std::map<std::string, std::string_view> values_;
  bool whole_ = true;
};

}  // namespace

std::string_view name_of(Model model) { return word(models, model); }

std::string spec_text(const LookSpec& spec) {
  const AppearanceParameters& p = spec.parameters;
  std::string text = fmt::format(
      "{}model={}; adaptation={}; white_luminance={}; weight={}; luminance={}; strength={}; "
      "strength_shift={}; "
      "strength_luminance={}; strength_chroma={}; rods={}; sp_ratio={}; safko_scale={}; edge={}; encoded={}; "
      "space={}; gamut={}; xyz_from_rgb={}",
      marker, name_of(p.model), number_text(p.adaptation), number_text(p.white_luminance),
      word(weights, p.weight), word(policies, p.luminance), number_text(p.strength.all),
      number_text(p.strength.shift), number_text(p.strength.luminance), number_text(p.strength.chroma),
      word(estimates, p.rods), number_text(p.sp_ratio), number_text(p.safko_scale), spec.edge,
      spec.encoded ? 1 : 0, spec.space, spec.gamut, matrix_text(p.xyz_from_rgb));
  if (p.xyz_from_gamut) text += "; xyz_from_gamut=" + matrix_text(*p.xyz_from_gamut);
  if (spec.lamp)
    text += fmt::format("; lamp={}; surround={}", vector_text(spec.lamp->white),
                        number_text(spec.lamp->surround));
  if (const auto& d = spec.night)
    text += fmt::format(
        "; display={}; peak={}; viewing={}; visibility={}; strength_display={}; xyz_from_display={}",
        spec.display, number_text(d->peak), number_text(d->viewing), word(rules, d->rule),
        number_text(d->strength), matrix_text(d->xyz_from_display));
  return text;
}

std::optional<LookSpec> read_spec(std::string_view file) {
  const std::size_t start = file.find(marker);
  if (start == std::string_view::npos) return std::nullopt;
  std::string_view line = file.substr(start + marker.size());
  line = line.substr(0, std::min(line.find_first_of("<\r\n"), line.size()));
  LineValues values(line);
  LookSpec spec;
  AppearanceParameters& p = spec.parameters;
  constexpr double tiny = 1e-30, huge = 1e30;
  values.read("model", models, p.model);
  values.read("adaptation", tiny, huge, p.adaptation);
  values.read("white_luminance", tiny, huge, p.white_luminance);
  values.read("weight", weights, p.weight);
  values.read("luminance", policies, p.luminance);
  values.read("strength", 0, 1, p.strength.all);
  values.read("strength_shift", 0, 1, p.strength.shift);
  values.read("strength_luminance", 0, 1, p.strength.luminance);
  values.read("strength_chroma", 0, 1, p.strength.chroma);
  values.read("rods", estimates, p.rods);
  values.read("sp_ratio", tiny, huge, p.sp_ratio);
  values.read("safko_scale", tiny, huge, p.safko_scale);
  double edge = 0, encoded = 0;
  values.read("edge", 2, 129, edge);
  values.read("encoded", 0, 1, encoded);
  spec.edge = static_cast<std::size_t>(edge);
  spec.encoded = encoded != 0;
  spec.space = values.text("space");
  spec.gamut = values.text("gamut");
  values.read("xyz_from_rgb", p.xyz_from_rgb);
  if (line.find("; xyz_from_gamut=") != std::string_view::npos)
    values.read("xyz_from_gamut", p.xyz_from_gamut.emplace());
  if (line.find("; lamp=") != std::string_view::npos) {
    Lamp& lamp = spec.lamp.emplace();
    values.read("lamp", 1e-12, 1e12, lamp.white);
    values.read("surround", 0, 1, lamp.surround);
  }
  if (line.find("; display=") != std::string_view::npos) {
    NightDisplayParameters& d = spec.night.emplace();
    spec.display = values.text("display");
    values.read("peak", tiny, huge, d.peak);
    values.read("viewing", tiny, huge, d.viewing);
    values.read("visibility", rules, d.rule);
    values.read("strength_display", 0, 1, d.strength);
    values.read("xyz_from_display", d.xyz_from_display);
  }
  if (!values.whole()) return std::nullopt;
  return spec;
}

}  // namespace scotopic
