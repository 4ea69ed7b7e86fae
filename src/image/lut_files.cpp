#include "image/lut_files.h"

#include <sys/stat.h>

#include <set>

#include "image/error.h"
#include "image/input_file.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

class Walk {
 public:
  Walk(const OCIO::ConstConfigRcPtr& config, const Limits& limits) : config_(config), limits_(limits) {}

  void transform(const OCIO::ConstTransformRcPtr& step) {
    if (!step) return;
    if (const auto group = OCIO::DynamicPtrCast<const OCIO::GroupTransform>(step)) {
      for (int i = 0; i < group->getNumTransforms(); ++i) transform(group->getTransform(i));
    } else if (const auto file = OCIO::DynamicPtrCast<const OCIO::FileTransform>(step)) {
      lut(file->getSrc());
    } else if (const auto spaces = OCIO::DynamicPtrCast<const OCIO::ColorSpaceTransform>(step)) {
      space(spaces->getSrc());
      space(spaces->getDst());
    } else if (const auto looks = OCIO::DynamicPtrCast<const OCIO::LookTransform>(step)) {
      space(looks->getSrc());
      space(looks->getDst());
      looks_in(looks->getLooks());
    } else if (const auto view = OCIO::DynamicPtrCast<const OCIO::DisplayViewTransform>(step)) {
      space(view->getSrc());
      space(config_->getDisplayViewColorSpaceName(view->getDisplay(), view->getView()));
      looks_in(config_->getDisplayViewLooks(view->getDisplay(), view->getView()));
    }
  }

 private:
  void space(const std::string& name) {
    const OCIO::ConstColorSpaceRcPtr found = config_->getColorSpace(name.c_str());
    if (!found || !seen_.insert(found->getName()).second) return;
    transform(found->getTransform(OCIO::COLORSPACE_DIR_TO_REFERENCE));
    transform(found->getTransform(OCIO::COLORSPACE_DIR_FROM_REFERENCE));
    if (found->getReferenceSpaceType() != OCIO::REFERENCE_SPACE_DISPLAY) return;
    for (int i = 0; i < config_->getNumViewTransforms(); ++i) {
      const auto view = config_->getViewTransform(config_->getViewTransformNameByIndex(i));
      transform(view->getTransform(OCIO::VIEWTRANSFORM_DIR_TO_REFERENCE));
      transform(view->getTransform(OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE));
    }
  }

  /// `list` is a formula of names; a look whose name merely occurs in it is looked at in vain.
  void looks_in(const std::string& list) {
    for (int i = 0; i < config_->getNumLooks(); ++i) {
      const std::string name = config_->getLookNameByIndex(i);
      if (list.find(name) == std::string::npos || !seen_.insert("look " + name).second) continue;
      const OCIO::ConstLookRcPtr look = config_->getLook(name.c_str());
      space(look->getProcessSpace());
      transform(look->getTransform());
      transform(look->getInverseTransform());
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
    if (stat(file.c_str(), &info) == 0) (void)check_input_file(file, ExitCode::config, limits_.lut, "--max-lut-size");
  }

  const OCIO::ConstConfigRcPtr& config_;
  const Limits& limits_;
  std::set<std::string> seen_;
};

}  // namespace

void check_lut_files(const OCIO::ConstConfigRcPtr& config, const OCIO::ConstTransformRcPtr& transform,
                     const Limits& limits) {
  Walk(config, limits).transform(transform);
}

}  // namespace scotopic
