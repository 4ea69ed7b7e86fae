#include "color/config/transforms.h"

#include <cstddef>

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

/// The same for R, G and B.
struct Three {
  explicit Three(double x) : values{x, x, x} {}
  double values[3];
};

}  // namespace

OCIO::MatrixTransformRcPtr matrix_transform(const Matrix3<double>& m) {
  double m44[16] = {};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m44[4 * i + j] = m[i][j];
  m44[15] = 1;
  OCIO::MatrixTransformRcPtr transform = OCIO::MatrixTransform::Create();
  transform->setMatrix(m44);
  return transform;
}

OCIO::LogCameraTransformRcPtr log_curve(const LogCurve& c) {
  OCIO::LogCameraTransformRcPtr curve = OCIO::LogCameraTransform::Create(Three(c.lin_break).values);
  curve->setBase(c.base);
  curve->setLogSideSlopeValue(Three(c.log_slope).values);
  curve->setLogSideOffsetValue(Three(c.log_offset).values);
  curve->setLinSideSlopeValue(Three(c.lin_slope).values);
  curve->setLinSideOffsetValue(Three(c.lin_offset).values);
  if (c.linear_slope != 0) curve->setLinearSlopeValue(Three(c.linear_slope).values);
  curve->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
  return curve;
}

OCIO::GradingRGBCurveTransformRcPtr quadratic_toe(const Quadratic& toe) {
  const auto point = [](double x, double y) {
    return OCIO::GradingControlPoint(static_cast<float>(x), static_cast<float>(y));
  };
  const OCIO::GradingBSplineCurveRcPtr spline =
      OCIO::GradingBSplineCurve::Create({point(toe.x0, toe.y0), point(toe.x1, toe.y1)});
  spline->setSlope(0, 0.f);
  spline->setSlope(1, static_cast<float>(2 * (toe.y1 - toe.y0) / (toe.x1 - toe.x0)));
  const OCIO::GradingBSplineCurveRcPtr none = OCIO::GradingBSplineCurve::Create({point(0, 0), point(1, 1)});
  OCIO::GradingRGBCurveTransformRcPtr out = OCIO::GradingRGBCurveTransform::Create(OCIO::GRADING_LOG);
  out->setValue(OCIO::GradingRGBCurve::Create(spline, spline, spline, none));
  return out;
}

}  // namespace scotopic
