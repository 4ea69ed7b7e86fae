#include "color/lut_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/input_file.h"
#include "color/icc/icc_check.h"
#include "color/lut_trial.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

OCIO::TransformDirection turned(OCIO::TransformDirection direction, OCIO::TransformDirection by) {
  return OCIO::CombineTransformDirections(direction, by);
}

constexpr auto forward = OCIO::TRANSFORM_DIR_FORWARD;

class Walk {
 public:
  Walk(const OCIO::ConstConfigRcPtr& config, const Limits& limits) : config_(config), limits_(limits) {}

  void transform(const OCIO::ConstTransformRcPtr& step, OCIO::TransformDirection wanted) {
    if (!step) return;
    const OCIO::TransformDirection direction = turned(step->getDirection(), wanted);
    if (const auto group = OCIO::DynamicPtrCast<const OCIO::GroupTransform>(step)) {
      for (int i = 0; i < group->getNumTransforms(); ++i) transform(group->getTransform(i), direction);
    } else if (const auto file = OCIO::DynamicPtrCast<const OCIO::FileTransform>(step)) {
      lut(file->getSrc());
    } else if (const auto spaces = OCIO::DynamicPtrCast<const OCIO::ColorSpaceTransform>(step)) {
      way(spaces->getSrc(), spaces->getDst(), direction);
    } else if (const auto looks = OCIO::DynamicPtrCast<const OCIO::LookTransform>(step)) {
      way(looks->getSrc(), looks->getDst(), direction);
      looks_in(looks->getLooks());
    } else if (const auto view = OCIO::DynamicPtrCast<const OCIO::DisplayViewTransform>(step)) {
      shown(*view, direction);
      looks_in(config_->getDisplayViewLooks(view->getDisplay(), view->getView()));
    }
  }

 private:
  void way(const char* from, const char* to, OCIO::TransformDirection direction) {
    ends(from, to, direction);
    const auto a = config_->getColorSpace(from), b = config_->getColorSpace(to);
    if (!a || !b || a->getReferenceSpaceType() == b->getReferenceSpaceType()) return;
    // Between scene and display the config's default view transform stands.
    view_transform(config_->getDefaultSceneToDisplayViewTransform());
  }

  void ends(const char* from, const char* to, OCIO::TransformDirection direction) {
    space(direction == forward ? from : to, OCIO::COLORSPACE_DIR_TO_REFERENCE);
    space(direction == forward ? to : from, OCIO::COLORSPACE_DIR_FROM_REFERENCE);
  }

  /// A view has a view transform of its own, or is a colour space.
  void shown(const OCIO::DisplayViewTransform& view, OCIO::TransformDirection direction) {
    const char* space = config_->getDisplayViewColorSpaceName(view.getDisplay(), view.getView());
    if (space == std::string_view(OCIO::OCIO_VIEW_USE_DISPLAY_NAME)) space = view.getDisplay();
    const char* const name = config_->getDisplayViewTransformName(view.getDisplay(), view.getView());
    if (!name || !*name) return way(view.getSrc(), space, direction);
    ends(view.getSrc(), space, direction);
    view_transform(config_->getViewTransform(name));
  }

  /// A way that leads through itself would never end: OpenColorIO 2.1 runs out of stack on it.
  template <typename Follow>
  void once(const std::string& name, const std::string& key, Follow follow) {
    const auto [known, added] = done_.emplace(key, false);
    if (!added && !known->second)
      throw Error(ExitCode::config, "", "the config's transform of '" + name + "' leads to itself");
    if (!added) return;
    follow();
    done_[key] = true;
  }

  void space(const std::string& name, OCIO::ColorSpaceDirection direction) {
    const OCIO::ConstColorSpaceRcPtr found = config_->getColorSpace(name.c_str());
    if (!found) return;
    const bool to = direction == OCIO::COLORSPACE_DIR_TO_REFERENCE;
    once(found->getName(), std::string(to ? "to " : "from ") + found->getName(), [&] {
      const auto other = to ? OCIO::COLORSPACE_DIR_FROM_REFERENCE : OCIO::COLORSPACE_DIR_TO_REFERENCE;
      // Of the two transforms a space may have, the other one's inverse stands in for the one that is
      // missing.
      if (const auto own = found->getTransform(direction))
        transform(own, forward);
      else
        transform(found->getTransform(other), OCIO::TRANSFORM_DIR_INVERSE);
    });
  }

  void view_transform(const OCIO::ConstViewTransformRcPtr& view) {
    if (!view) return;
    const std::string name = view->getName();
    once(name, "view transform " + name, [&] {
      transform(view->getTransform(OCIO::VIEWTRANSFORM_DIR_TO_REFERENCE), forward);
      transform(view->getTransform(OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE), forward);
    });
  }

  /// `list` is a formula of names; a look whose name merely occurs in it is looked at in vain.
  void looks_in(const std::string& list) {
    for (int i = 0; i < config_->getNumLooks(); ++i) {
      const std::string name = config_->getLookNameByIndex(i);
      if (list.find(name) == std::string::npos) continue;
      once(name, "look " + name, [&] {
        const OCIO::ConstLookRcPtr look = config_->getLook(name.c_str());
        space(look->getProcessSpace(), OCIO::COLORSPACE_DIR_TO_REFERENCE);
        space(look->getProcessSpace(), OCIO::COLORSPACE_DIR_FROM_REFERENCE);
        transform(look->getTransform(), forward);
        transform(look->getInverseTransform(), forward);
      });
    }
  }

  void lut(const std::string& source) {
    std::string file;
    try {
      file = config_->getCurrentContext()->resolveFileLocation(source.c_str());
    } catch (const OCIO::Exception&) {
      return;
    }
    struct stat info = {};
    if (stat(file.c_str(), &info) != 0) return;
    (void)check_input_file(file, ExitCode::config, limits_.lut, "--max-lut-size");
    check_icc_file(file);
    check_csp_file(file);
    try_lut_file(file);
  }

  /// OpenColorIO 2.1 looks for the end of a csp's metadata beyond that of the file, for ever.
  static void check_csp_file(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    bool open = false;
    std::string line;
    if (!std::getline(in, line) || line.rfind("CSPLUTV100", 0) != 0) return;
    while (std::getline(in, line)) {
      if (line.find("BEGIN METADATA") != std::string::npos) open = true;
      if (line.find("END METADATA") != std::string::npos) open = false;
    }
    if (open) throw Error(ExitCode::config, file, "is damaged: its metadata has no end");
  }

  /// OpenColorIO reads profiles, too.
  static void check_icc_file(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::vector<char> bytes(132);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!in || !is_icc(std::as_bytes(std::span(bytes)))) return;
    bytes.insert(bytes.end(), std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    const std::string fault = fault_of_icc(std::as_bytes(std::span(bytes)));
    if (!fault.empty()) throw Error(ExitCode::config, file, "is damaged: " + fault);
  }

  const OCIO::ConstConfigRcPtr& config_;
  const Limits& limits_;
  std::map<std::string, bool> done_;  // false: under way
};

}  // namespace

void check_lut_files(const OCIO::ConstConfigRcPtr& config, const OCIO::ConstTransformRcPtr& transform,
                     const Limits& limits) {
  Walk(config, limits).transform(transform, forward);
}

void require_usable_luts(const OCIO::ConstProcessorRcPtr& processor, const std::string& file) {
  const OCIO::GroupTransformRcPtr steps = processor->createGroupTransform();
  for (int i = 0; i < steps->getNumTransforms(); ++i) {
    const OCIO::TransformRcPtr step = steps->getTransform(i);
    const auto cube = OCIO::DynamicPtrCast<OCIO::Lut3DTransform>(step);
    const auto table = OCIO::DynamicPtrCast<OCIO::Lut1DTransform>(step);
    if ((cube && cube->getGridSize() < 2) || (table && table->getLength() < 2))
      throw Error(ExitCode::config, file, "a LUT of less than two nodes has no way between them");
  }
}

}  // namespace scotopic
