#include "looks/verify/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "looks/lut/shipped_looks.h"
#include "looks/config/look_config.h"
#include "looks/chain/ocio_chain.h"
#include "base/error.h"
#include "base/input_file.h"
#include "color/lut_files.h"
#include "base/names.h"

namespace OCIO = OCIO_NAMESPACE;
namespace fs = std::filesystem;

namespace scotopic {
namespace {

// What another machine's arithmetic may add to a stated error, which is rounded to two digits.
constexpr double slack = 1.06;

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

void judge(Inspected& it) {
  if (it.stated && it.error && it.error->max > *it.stated * slack + 1e-3)
    it.problems.push_back(
        fmt::format("largest error {:.3g} exceeds the {:.3g} it states", it.error->max, *it.stated));
  if (!it.stated) it.problems.push_back("states no error");
  if (it.spec && !it.spec->night && is_identity(*it.spec))
    return;  // passes everything on, NaN too: so does the operator
  if (it.odd.not_finite > 0)
    it.problems.push_back(fmt::format("{} components come out not finite", it.odd.not_finite));
  if (it.odd.alpha_changed > 0) it.problems.push_back("changes alpha");
  if (!it.odd.black_stays_black && !it.spec->encoded) it.problems.push_back("black does not stay black");
}

void measure(Inspected& it, const OCIO::ConstCPUProcessorRcPtr& processor, const ColourConfig& config) {
  it.odd = odd_pixels(processor);
  if (it.spec->encoded)
    it.cube = measure_cube(
        *it.spec, config,
        {lut_processor(it.file, OCIO::INTERP_TETRAHEDRAL), lut_processor(it.file, OCIO::INTERP_LINEAR)});
  it.error = it.cube ? it.cube->rec709.by_reading[0] : measure_look(*it.spec, processor);
  judge(it);
}

bool same_primaries(const Matrix3<double>& a, const Matrix3<double>& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (std::abs(a[i][j] - b[i][j]) > 1e-3) return false;
  return true;
}

/// The file behind a look, "" if it has none; where it cannot be found, the reason becomes a problem.
std::string file_of(const OCIO::ConstConfigRcPtr& config, const OCIO::ConstLookRcPtr& look, Inspected& it) {
  const auto transform = OCIO::DynamicPtrCast<const OCIO::FileTransform>(look->getTransform());
  if (!transform) return "";
  try {
    return config->getCurrentContext()->resolveFileLocation(transform->getSrc());
  } catch (const OCIO::Exception& e) {
    it.problems.push_back(one_line(e.what()));
    return transform->getSrc();
  }
}

/// Every value of the ladder must have its file behind a look with $SCOTOPIC_LA.
void inspect_context(const OCIO::ConstConfigRcPtr& config, const OCIO::ConstLookRcPtr& look, Inspected& it) {
  const auto transform = OCIO::DynamicPtrCast<const OCIO::FileTransform>(look->getTransform());
  if (!transform || std::string(transform->getSrc()).find(context_variable) == std::string::npos) return;
  const OCIO::ContextRcPtr context = config->getCurrentContext()->createEditableCopy();
  for (const NamedAdaptation& step : named_adaptations) {
    context->setStringVar(context_variable, adaptation_text(step.adaptation).c_str());
    try {
      (void)context->resolveFileLocation(transform->getSrc());
    } catch (const OCIO::Exception&) {
      it.problems.push_back(std::string(context_variable) + "=" + adaptation_text(step.adaptation) +
                            " has no file");
    }
  }
}

Inspected inspect_look(const ColourConfig& config, const std::string& name) {
  Inspected it;
  it.name = name;
  const OCIO::ConstLookRcPtr look = config.ocio()->getLook(name.c_str());
  it.file = file_of(config.ocio(), look, it);
  if (it.file.empty() || !it.problems.empty()) return it;
  const std::string text = text_of(it.file, config.limits());
  it.spec = read_spec(text);
  it.stated = stated_max(text);
  if (!it.spec) return it;
  inspect_context(config.ocio(), look, it);
  if (!same_primaries(it.spec->parameters.xyz_from_rgb, config.xyz_from_working()))
    it.problems.push_back("is made for other primaries than those of " + config.working_space());
  measure(it, look_processor(config, name), config);
  return it;
}

/// The LUT in the middle of a view's transform; nullopt: it has none of ours.
std::optional<Inspected> inspect_view(const ColourConfig& config, const std::string& name) {
  const auto group = OCIO::DynamicPtrCast<const OCIO::GroupTransform>(
      config.ocio()->getViewTransform(name.c_str())->getTransform(OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE));
  for (int i = 0; group && i < group->getNumTransforms(); ++i) {
    const auto file = OCIO::DynamicPtrCast<const OCIO::FileTransform>(group->getTransform(i));
    if (!file) continue;
    Inspected it;
    it.name = "view " + name;
    try {
      it.file = config.ocio()->getCurrentContext()->resolveFileLocation(file->getSrc());
    } catch (const OCIO::Exception& e) {
      it.problems.push_back(one_line(e.what()));
      return it;
    }
    const std::string text = text_of(it.file, config.limits());
    it.spec = read_spec(text);
    it.stated = stated_max(text);
    if (!it.spec) return std::nullopt;
    measure(it, lut_processor(it.file), config);
    return it;
  }
  return std::nullopt;
}

}  // namespace

std::string text_of(const std::string& file, const Limits& limits) {
  return read_input_file(file, ExitCode::input, limits.lut, "--max-lut-size");
}

Inspected inspect_lut(const std::string& file, const ColourConfig& config) {
  Inspected it;
  it.name = it.file = file;
  const std::string text = text_of(file, config.limits());
  it.spec = read_spec(text);
  it.stated = stated_max(text);
  if (!it.spec) throw Error(ExitCode::config, file, "is no LUT that says which operator it was baked from");
  measure(it, lut_processor(file), config);
  return it;
}

OCIO::ConstCPUProcessorRcPtr lut_processor(const std::string& file, OCIO::Interpolation reading) {
  OCIO::FileTransformRcPtr transform = OCIO::FileTransform::Create();
  transform->setSrc(fs::absolute(file).c_str());
  transform->setInterpolation(reading);
  try {
    return cpu_processor(transform, OCIO::Config::CreateRaw());
  } catch (const OCIO::Exception& e) {
    throw Error(ExitCode::config, file, one_line(e.what()));
  }
}

std::vector<Inspected> inspect_config(const ColourConfig& config, const std::string& only) {
  std::vector<Inspected> all;
  for (int i = 0; i < config.ocio()->getNumLooks(); ++i) {
    const std::string name = config.ocio()->getLookNameByIndex(i);
    if (!only.empty() && name != only) continue;
    Inspected it = inspect_look(config, name);
    if (!only.empty() || it.spec || !it.problems.empty()) all.push_back(std::move(it));
  }
  for (int i = 0; only.empty() && i < config.ocio()->getNumViewTransforms(); ++i)
    if (auto it = inspect_view(config, config.ocio()->getViewTransformNameByIndex(i)))
      all.push_back(std::move(*it));
  if (!only.empty() && all.empty()) (void)look_processor(config, only);
  return all;
}

OCIO::ConstCPUProcessorRcPtr look_processor(const ColourConfig& config, const std::string& look) {
  std::vector<std::string> names;
  for (int i = 0; i < config.ocio()->getNumLooks(); ++i)
    names.emplace_back(config.ocio()->getLookNameByIndex(i));
  if (std::find(names.begin(), names.end(), look) == names.end())
    throw Error(ExitCode::config, config.file(), "unknown look '" + look + "'" + did_you_mean(look, names));
  OCIO::LookTransformRcPtr transform = OCIO::LookTransform::Create();
  transform->setSrc(config.working_space().c_str());
  transform->setDst(config.working_space().c_str());
  transform->setLooks(look.c_str());
  check_lut_files(config.ocio(), transform, config.limits());
  try {
    return cpu_processor(transform, config.ocio());
  } catch (const OCIO::Exception& e) {
    throw Error(ExitCode::config, config.file(), one_line(e.what()));
  }
}

}  // namespace scotopic
