#include "cli/verbs/explain_config.h"

#include <fmt/format.h>

#include "color/lut_files.h"

namespace scotopic {
namespace {

namespace OCIO = OCIO_NAMESPACE;

std::string kind_of(const OCIO::ConstProcessorRcPtr& processor) {
  const OCIO::ConstProcessorRcPtr optimised = processor->getOptimizedProcessor(OCIO::OPTIMIZATION_DEFAULT);
  if (optimised->isNoOp()) return "nothing";
  const OCIO::GroupTransformRcPtr group = optimised->createGroupTransform();
  const int count = group->getNumTransforms();
  int matrices = 0, ranges = 0;
  unsigned long edge = 0;
  for (int i = 0; i < count; ++i) {
    const OCIO::TransformRcPtr step = group->getTransform(i);
    matrices += step->getTransformType() == OCIO::TRANSFORM_TYPE_MATRIX;
    ranges += step->getTransformType() == OCIO::TRANSFORM_TYPE_RANGE;
    if (const auto lut = OCIO::DynamicPtrCast<OCIO::Lut3DTransform>(step)) edge = lut->getGridSize();
  }
  if (ranges == count) return "nothing but the removal of what is no number";
  if (matrices + ranges == count) return "a matrix";
  if (edge == 0) return fmt::format("{} steps without a 3D LUT", count);
  return fmt::format("a 3D LUT of {} nodes a side, {} steps in all", edge, count);
}

}  // namespace

std::vector<ExplainedLook> explain_looks(const ColourConfig& config) {
  const OCIO::ConstConfigRcPtr& ocio = config.ocio();
  const std::string space = config.working_space();
  std::vector<ExplainedLook> looks;
  for (int i = 0; i < ocio->getNumLooks(); ++i) {
    const char* name = ocio->getLookNameByIndex(i);
    const std::string description = ocio->getLook(name)->getDescription();
    ExplainedLook look{name, description.substr(0, description.find('\n')), ""};
    const OCIO::LookTransformRcPtr transform = OCIO::LookTransform::Create();
    transform->setSrc(space.c_str());
    transform->setDst(space.c_str());
    transform->setLooks(name);
    check_lut_files(ocio, transform, config.limits());
    try {
      look.does = kind_of(ocio->getProcessor(transform));
    } catch (const OCIO::Exception& error) {
      look.does = std::string("cannot be run: ") + error.what();
    }
    looks.push_back(look);
  }
  return looks;
}

}  // namespace scotopic
