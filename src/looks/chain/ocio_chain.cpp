#include "looks/chain/ocio_chain.h"

#include <cmath>

#include "color/lut_files.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

struct ToOcio {
  OCIO::Interpolation reading;

  OCIO::TransformRcPtr operator()(const RangeStep& step) const {
    OCIO::RangeTransformRcPtr range = OCIO::RangeTransform::Create();
    if (std::isfinite(step.low)) range->setMinInValue(step.low), range->setMinOutValue(step.low);
    if (std::isfinite(step.high)) range->setMaxInValue(step.high), range->setMaxOutValue(step.high);
    return range;
  }
  OCIO::TransformRcPtr operator()(const MatrixStep& step) const {
    OCIO::MatrixTransformRcPtr matrix = OCIO::MatrixTransform::Create();
    double m44[16] = {}, offset[4] = {};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) m44[4 * i + j] = step.matrix[i][j];
      offset[i] = step.offset[i];
    }
    m44[15] = 1;
    matrix->setMatrix(m44);
    matrix->setOffset(offset);
    return matrix;
  }
  OCIO::TransformRcPtr operator()(const LogStep& step) const {
    OCIO::LogTransformRcPtr log = OCIO::LogTransform::Create();
    log->setBase(2);
    log->setDirection(step.style == LogStyle::log2 ? OCIO::TRANSFORM_DIR_FORWARD
                                                   : OCIO::TRANSFORM_DIR_INVERSE);
    return log;
  }
  OCIO::TransformRcPtr operator()(const Lut1DStep& step) const {
    OCIO::Lut1DTransformRcPtr lut = OCIO::Lut1DTransform::Create(step.length, false);
    lut->setFileOutputBitDepth(OCIO::BIT_DEPTH_F32);
    lut->setInterpolation(OCIO::INTERP_LINEAR);
    for (std::size_t i = 0; i < step.length; ++i)
      lut->setValue(i, static_cast<float>(step.values[3 * i]), static_cast<float>(step.values[3 * i + 1]),
                    static_cast<float>(step.values[3 * i + 2]));
    return lut;
  }
  OCIO::TransformRcPtr operator()(const Lut3DStep& step) const {
    OCIO::Lut3DTransformRcPtr lut = OCIO::Lut3DTransform::Create(step.edge);
    lut->setFileOutputBitDepth(OCIO::BIT_DEPTH_F32);
    lut->setInterpolation(reading);
    std::size_t n = 0;
    for (std::size_t i = 0; i < step.edge; ++i)
      for (std::size_t j = 0; j < step.edge; ++j)
        for (std::size_t k = 0; k < step.edge; ++k, n += 3)
          lut->setValue(i, j, k, static_cast<float>(step.values[n]), static_cast<float>(step.values[n + 1]),
                        static_cast<float>(step.values[n + 2]));
    return lut;
  }
};

}  // namespace

OCIO::GroupTransformRcPtr ocio_transform(const Chain& chain, OCIO::Interpolation reading) {
  OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
  for (const Step& step : chain.steps) group->appendTransform(std::visit(ToOcio{reading}, step));
  return group;
}

OCIO::ConstCPUProcessorRcPtr cpu_processor(const OCIO::ConstTransformRcPtr& transform,
                                           const OCIO::ConstConfigRcPtr& config) {
  const OCIO::ConstProcessorRcPtr processor = config->getProcessor(transform);
  require_usable_luts(processor, "");
  return processor->getOptimizedCPUProcessor(OCIO::BIT_DEPTH_F32, OCIO::BIT_DEPTH_F32,
                                             OCIO::OPTIMIZATION_LOSSLESS);
}

}  // namespace scotopic
