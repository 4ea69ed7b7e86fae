#include "color/colour_config.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <new>

#include "color/base_config.h"
#include "color/icc/embedded_profile.h"
#include "color/config/config_glance.h"
#include "base/error.h"
#include "color/config/lost_displays.h"
#include "color/lut_files.h"
#include "base/names.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

// Lossless optimisations only: the others trade exactness of log, exp and LUTs for speed.
constexpr OCIO::OptimizationFlags optimisation = OCIO::OPTIMIZATION_LOSSLESS;

// While it makes a processor OpenColorIO 2.1 reads its environment into one string, whichever thread it is.
std::mutex making_processors;

// OCIO computes in float: what it does to a vector differs from a matrix by no more than this.
constexpr double linear_tolerance = 1e-5;

/// OCIO's messages hold line breaks; ours are one line.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  const std::size_t end = text.find_last_not_of(" .");
  return end == std::string::npos ? "" : text.substr(0, end + 1);
}

/// Configs that OpenColorIO brings itself, and archives of one, are of 2.2 and later.
void require_readable_kind(const std::string& file) {
  const bool built_in = file.rfind("ocio://", 0) == 0;
  const bool archive = file.size() > 6 && file.compare(file.size() - 6, 6, ".ocioz") == 0;
  if ((!built_in && !archive) || OCIO::GetVersionHex() >= 0x02020000) return;
  throw Error(ExitCode::config, file,
              std::string(built_in ? "a config that OpenColorIO brings itself" : "an archived config") +
                  " needs OpenColorIO 2.2; this is " + OCIO::GetVersion());
}

/// Warnings would come on stderr between our own lines.
void silence_ocio() { OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE); }

/// Of light that every space has; matrices and LUTs of NaN or infinities show there.
bool keeps_finite(const OCIO::CPUProcessor& processor) {
  for (const std::array<float, 3>& colour :
       {std::array{.18f, .18f, .18f}, {1.f, .5f, .25f}, {.25f, 1.f, .5f}}) {
    std::array<float, 3> rgb = colour;
    processor.applyRGB(rgb.data());
    if (!std::isfinite(rgb[0] + rgb[1] + rgb[2])) return false;
  }
  return true;
}

bool near(const Vec3<double>& a, const Vec3<double>& b, double scale) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(a[i] - b[i]) <= linear_tolerance * scale)) return false;
  return true;
}

}  // namespace

ColourConfig::ColourConfig(OCIO::ConstConfigRcPtr config, std::string file, const Limits& limits,
                           const std::optional<Matrix3<double>>& working)
    : config_(std::move(config)), file_(std::move(file)), limits_(limits) {
  try {
    config_->validate();
  } catch (const OCIO::Exception& e) {
    fail(one_line(e.what()));
  }
  const OCIO::ConstColorSpaceRcPtr scene_linear = config_->getColorSpace(OCIO::ROLE_SCENE_LINEAR);
  if (!scene_linear) fail("the config has no role scene_linear, so there is no space to work in");
  working_space_ = scene_linear->getName();
  find_xyz(working);
}

ColourConfig ColourConfig::own() {
  silence_ocio();
  return ColourConfig(make_base_config(), "", {}, std::nullopt);
}

ColourConfig ColourConfig::from_file(const std::string& file, const Limits& limits,
                                     const std::optional<Matrix3<double>>& working) {
  silence_ocio();
  require_readable_kind(file);
  // Younger OpenColorIO takes names of configs that it brings itself.
  if (file.rfind("ocio://", 0) != 0) require_modest_config(file, limits);
  OCIO::ConstConfigRcPtr config;
  try {
    const OCIO::ConfigRcPtr read = OCIO::Config::CreateFromFile(file.c_str())->createEditableCopy();
    forget_lost_displays(*read);
    config = read;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    const std::string newer = too_new(file);
    throw Error(ExitCode::config, file,
                newer.empty() ? "not a colour config that can be read: " + one_line(e.what()) : newer);
  }
  return ColourConfig(std::move(config), file, limits, working);
}

ColourConfig ColourConfig::in_force(const std::string& file, const Limits& limits,
                                    const std::optional<Matrix3<double>>& working) {
  const char* environment = std::getenv("OCIO");
  const std::string source = file.empty() && environment ? environment : file;
  ColourConfig config = source.empty() ? own() : from_file(source, limits, working);
  if (source.empty() && working) config.find_xyz(working);
  return config;
}

void ColourConfig::fail(const std::string& what) const { throw Error(ExitCode::config, file_, what); }

OCIO::ConstCPUProcessorRcPtr ColourConfig::processor(const std::string& from, const std::string& to) const {
  const OCIO::ColorSpaceTransformRcPtr both = OCIO::ColorSpaceTransform::Create();
  both->setSrc(from.c_str());
  both->setDst(to.c_str());
  check_lut_files(config_, both, limits_);
  try {
    const std::lock_guard lock(making_processors);
    const OCIO::ConstProcessorRcPtr way = config_->getProcessor(from.c_str(), to.c_str());
    require_usable_luts(way, file_);
    const OCIO::ConstCPUProcessorRcPtr out =
        way->getOptimizedCPUProcessor(OCIO::BIT_DEPTH_F32, OCIO::BIT_DEPTH_F32, optimisation);
    if (!keeps_finite(*out))
      fail("from colour space '" + from + "' to '" + to + "' colours are no numbers any more");
    return out;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    fail("no way from colour space '" + from + "' to '" + to + "': " + one_line(e.what()));
  }
}

/// The matrix a processor is, found with unit vectors; nullopt where it is not linear (a tone map, say).
std::optional<Matrix3<double>> ColourConfig::linear_matrix(const std::string& from,
                                                           const std::string& to) const {
  const OCIO::ConstCPUProcessorRcPtr convert = processor(from, to);
  const auto image_of = [&](Vec3<double> v) {
    float rgb[3] = {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
    convert->applyRGB(rgb);
    return Vec3<double>{rgb[0], rgb[1], rgb[2]};
  };
  const Matrix3<double> m =
      transpose(Matrix3<double>{{image_of({1, 0, 0}), image_of({0, 1, 0}), image_of({0, 0, 1})}});
  const double size = std::max({std::abs(m[0][0]), std::abs(m[1][1]), std::abs(m[2][2])});
  for (const Vec3<double>& probe : {Vec3<double>{0, 0, 0}, {.18, .18, .18}, {16, 2, .25}, {-.5, 4, 64}}) {
    const double scale = size * std::max({1e-3, std::abs(probe[0]), std::abs(probe[1]), std::abs(probe[2])});
    if (!near(image_of(probe), m * probe, scale)) return std::nullopt;
  }
  return m;
}

/// Scene-referred ways first: the way to a display space goes through a view, which may be a tone map.
std::optional<Matrix3<double>> ColourConfig::interchange_matrix() const {
  std::optional<Matrix3<double>> xyz;
  if (config_->hasRole("aces_interchange")) {
    const std::optional<Matrix3<double>> ap0 = linear_matrix(working_space_, "aces_interchange");
    if (ap0) xyz = gamut_xyz_matrix("ap0").value() * *ap0;
  }
  for (const char* name : {"cie_xyz_d65_interchange", "CIE XYZ-D65", "XYZ"})
    if (!xyz && has_space(name)) xyz = linear_matrix(working_space_, name);
  return xyz;
}

void ColourConfig::find_xyz(const std::optional<Matrix3<double>>& stated) {
  const std::optional<Matrix3<double>> found = interchange_matrix();
  if (stated && found && !same_matrix(*stated, *found))
    fail("its own roles give '" + working_space_ + "' other primaries than --working-primaries");
  const std::optional<Matrix3<double>> xyz = stated ? stated : found;
  if (!xyz)
    fail("no linear way from '" + working_space_ +
         "' to CIE XYZ: the config needs the role aces_interchange or cie_xyz_d65_interchange, or "
         "--working-primaries says what it is (rec709, ap1, ...)");
  if (!(std::abs(determinant(*xyz)) > 1e-6)) fail("'" + working_space_ + "' to CIE XYZ cannot be inverted");
  const NamedPrimaries* known = match_matrix(*xyz);
  working_gamut_ = known ? std::string(known->name) : "";
  xyz_from_working_ = known ? xyz_d65_from_rgb(known->primaries) : *xyz;
}

bool ColourConfig::has_space(const std::string& name) const {
  return config_->getColorSpace(name.c_str()) != nullptr;
}

std::vector<std::string> ColourConfig::names() const {
  std::vector<std::string> out;
  for (int i = 0; i < config_->getNumColorSpaces(OCIO::SEARCH_REFERENCE_SPACE_ALL, OCIO::COLORSPACE_ALL);
       ++i) {
    const char* name =
        config_->getColorSpaceNameByIndex(OCIO::SEARCH_REFERENCE_SPACE_ALL, OCIO::COLORSPACE_ALL, i);
    out.emplace_back(name);
    const OCIO::ConstColorSpaceRcPtr space = config_->getColorSpace(name);
    for (std::size_t a = 0; space && a < space->getNumAliases(); ++a) out.emplace_back(space->getAlias(a));
  }
  for (int i = 0; i < config_->getNumRoles(); ++i) out.emplace_back(config_->getRoleName(i));
  return out;
}

std::string ColourConfig::resolve(const std::string& name) const {
  const OCIO::ConstColorSpaceRcPtr space = config_->getColorSpace(name.c_str());
  if (!space) fail("unknown colour space '" + name + "'" + did_you_mean(name, names()));
  return space->getName();
}

RuledSpace ColourConfig::space_by_rules(const std::string& file, bool integer) const {
  const std::string role = integer ? "default_byte" : "default_float";
  if (config_->filepathOnlyMatchesDefaultRule(file.c_str()) && config_->hasRole(role.c_str()) &&
      has_space(role))
    return {space(role), "the config's role " + role};
  const std::string rule_space = config_->getColorSpaceFromFilepath(file.c_str());
  if (has_space(rule_space)) return {space(rule_space), "the config's file rules"};
  return {space(OCIO::ROLE_SCENE_LINEAR), "the config's role scene_linear"};
}

OCIO::ConstCPUProcessorRcPtr ColourConfig::processor(const DisplayView& to) const {
  const OCIO::DisplayViewTransformRcPtr both = OCIO::DisplayViewTransform::Create();
  both->setSrc(working_space_.c_str());
  both->setDisplay(to.display.c_str());
  both->setView(to.view.c_str());
  check_lut_files(config_, both, limits_);
  try {
    const std::lock_guard lock(making_processors);
    return config_
        ->getProcessor(working_space_.c_str(), to.display.c_str(), to.view.c_str(),
                       OCIO::TRANSFORM_DIR_FORWARD)
        ->getOptimizedCPUProcessor(OCIO::BIT_DEPTH_F32, OCIO::BIT_DEPTH_F32, optimisation);
  } catch (const std::exception& e) {
    fail("no way to view '" + to.view + "' of display '" + to.display + "': " + one_line(e.what()));
  }
}

bool ColourConfig::same(const ColourSpace& a, const ColourSpace& b) const {
  if (a.for_a_device() || b.for_a_device()) return false;
  if (a.embedded || b.embedded) return a.embedded == b.embedded;
  if (!a.curve.linear() || !b.curve.linear())
    return a.curve == b.curve && a.xyz_from_rgb && b.xyz_from_rgb &&
           a.xyz_from_rgb->rows == b.xyz_from_rgb->rows;
  if (a.name == b.name && !a.xyz_from_rgb && !b.xyz_from_rgb) return true;
  if (a.xyz_from_rgb && b.xyz_from_rgb && a.xyz_from_rgb->rows == b.xyz_from_rgb->rows) return true;
  if (!a.xyz_from_rgb && !b.xyz_from_rgb) return processor(a.name, b.name)->isNoOp();
  return to_working(a).identity() && to_working(b).identity();
}

bool ColourConfig::is_srgb(const ColourSpace& space) const {
  if (space.xyz_from_rgb || space.profile || space.embedded) return false;
  const RowConverter convert = from_working(space);
  // Mid-grey and a saturated colour: sRGB's curve and primaries, to 1e-4 of full scale.
  constexpr Vec3<double> encoded = {.5, .25, .75};
  const auto linear = [](double v) { return std::pow((v + .055) / 1.055, 2.4); };
  const Vec3<double> working =
      inverse(xyz_from_working_) *
      (gamut_xyz_matrix("rec709").value() * Vec3<double>{linear(.5), linear(.25), linear(.75)});
  float p[3] = {static_cast<float>(working[0]), static_cast<float>(working[1]),
                static_cast<float>(working[2])};
  convert.apply(&p[0], &p[1], &p[2], 1);
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(static_cast<double>(p[i]) - encoded[i]) <= 1e-4)) return false;
  return true;
}

std::optional<ColourConfig::Encoding> ColourConfig::encoding(const ColourSpace& space) const {
  if (space.for_a_device()) return std::nullopt;
  const RowConverter convert = to_working(space);
  Matrix3<double> working;
  for (std::size_t i = 0; i < 3; ++i) {
    float p[3] = {};
    p[i] = 1;
    convert.apply(&p[0], &p[1], &p[2], 1);
    for (std::size_t k = 0; k < 3; ++k) working[k][i] = static_cast<double>(p[k]);
  }
  Encoding out;
  const Matrix3<double> xyz = xyz_from_working_ * working;
  out.white = xyz[1][0] + xyz[1][1] + xyz[1][2];
  if (!(out.white > 1e-6) || !std::isfinite(out.white) || !(std::abs(determinant(xyz)) > 0))
    return std::nullopt;
  out.xyz_from_rgb = (1 / out.white) * xyz;
  // In float, the last digits of such a matrix are OpenColorIO's: those of a known space are exact.
  if (const NamedPrimaries* known = match_matrix(out.xyz_from_rgb))
    out.xyz_from_rgb = xyz_d65_from_rgb(known->primaries);
  return out;
}

std::optional<Matrix3<double>> ColourConfig::linear_xyz(const ColourSpace& space) const {
  if (space.for_a_device() || space.embedded || !space.curve.linear()) return std::nullopt;
  if (space.xyz_from_rgb) return space.xyz_from_rgb;
  const std::optional<Matrix3<double>> working = linear_matrix(space.name, working_space_);
  return working ? std::optional(xyz_from_working_ * *working) : std::nullopt;
}

RowConverter ColourConfig::to_working(const ColourSpace& from) const {
  if (from.embedded) return RowConverter(from.embedded, inverse(xyz_from_working_), true);
  if (!from.xyz_from_rgb) return RowConverter(processor(from.name, working_space_));
  if (!from.curve.linear())
    return RowConverter(from.curve, inverse(xyz_from_working_) * *from.xyz_from_rgb, true);
  const NamedPrimaries* known = match_matrix(*from.xyz_from_rgb);
  if (known && known->name == working_gamut_) return RowConverter();
  return RowConverter(inverse(xyz_from_working_) * *from.xyz_from_rgb);
}

RowConverter ColourConfig::from_working(const ColourSpace& to) const {
  if (to.profile) return RowConverter(to.profile, xyz_from_working_);
  if (to.view) return RowConverter(processor(*to.view));
  if (to.embedded) return RowConverter(to.embedded, xyz_from_working_, false);
  if (to.xyz_from_rgb && !to.curve.linear())
    return RowConverter(to.curve, inverse(*to.xyz_from_rgb) * xyz_from_working_, false);
  if (!to.xyz_from_rgb) return RowConverter(processor(working_space_, to.name));
  const NamedPrimaries* known = match_matrix(*to.xyz_from_rgb);
  if (known && known->name == working_gamut_) return RowConverter();
  return RowConverter(inverse(*to.xyz_from_rgb) * xyz_from_working_);
}

}  // namespace scotopic
