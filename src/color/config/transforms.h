// Transforms of OpenColorIO from our own numbers.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include "kernel/matrix3.h"

namespace scotopic {

/// RGB times a matrix; alpha stays.
OCIO_NAMESPACE::MatrixTransformRcPtr matrix_transform(const Matrix3<double>& m);

/// A camera's log curve: code = log_slope log_base(lin_slope light + lin_offset) + log_offset above
/// `lin_break`, a straight line below it.
struct LogCurve {
  double base, log_slope, log_offset, lin_slope, lin_offset, lin_break;
  double linear_slope = 0;  ///< of the line; 0: that of the curve where they meet
};

/// Light from code.
OCIO_NAMESPACE::LogCameraTransformRcPtr log_curve(const LogCurve& curve);

/// One quadratic from (x0, y0), where its slope is 0, to (x1, y1); lines go on from its ends. Forward.
struct Quadratic {
  double x0, y0, x1, y1;
};
OCIO_NAMESPACE::GradingRGBCurveTransformRcPtr quadratic_toe(const Quadratic& toe);

/// One after the other.
template <typename... Transforms>
OCIO_NAMESPACE::GroupTransformRcPtr group_of(Transforms... transforms) {
  OCIO_NAMESPACE::GroupTransformRcPtr out = OCIO_NAMESPACE::GroupTransform::Create();
  (out->appendTransform(transforms), ...);
  return out;
}

}  // namespace scotopic
