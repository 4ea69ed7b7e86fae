#include <utility>

#include "color/colour_config.h"
#include "color/icc/embedded_profile.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {

RowConverter::RowConverter(const Matrix3<double>& matrix) : matrix_(matrix) {}

RowConverter::RowConverter(OCIO::ConstCPUProcessorRcPtr processor)
    : processor_(processor && !processor->isNoOp() ? std::move(processor) : nullptr) {}

RowConverter::RowConverter(const TransferCurve& curve, const Matrix3<double>& matrix, bool decode)
    : matrix_(matrix), curve_(curve), decode_(decode) {}

RowConverter::RowConverter(std::shared_ptr<const EmbeddedProfile> embedded, const Matrix3<double>& matrix,
                           bool decode)
    : matrix_(matrix), decode_(decode), embedded_(std::move(embedded)) {}

RowConverter::RowConverter(std::shared_ptr<const IccProfile> profile, const Matrix3<double>& xyz_from_rgb)
    : matrix_(xyz_from_rgb), profile_(std::move(profile)) {}

void RowConverter::apply(float* r, float* g, float* b, std::size_t count) const {
  if (profile_) {
    profile_->apply(*matrix_, r, g, b, count);
  } else if (embedded_) {
    apply_embedded(r, g, b, count);
  } else if (matrix_) {
    apply_matrix(r, g, b, count);
  } else if (processor_ && count > 0) {
    OCIO::PlanarImageDesc row(r, g, b, nullptr, static_cast<long>(count), 1);
    processor_->apply(row);
  }
}

void RowConverter::apply_matrix(float* r, float* g, float* b, std::size_t count) const {
  const bool curved = !curve_.linear();
  for (std::size_t i = 0; i < count; ++i) {
    Vec3<double> p{r[i], g[i], b[i]};
    if (curved && decode_) p = curve_.decode(p);
    p = *matrix_ * p;
    if (curved && !decode_) p = curve_.encode(p);
    r[i] = static_cast<float>(p[0]);
    g[i] = static_cast<float>(p[1]);
    b[i] = static_cast<float>(p[2]);
  }
}

void RowConverter::apply_embedded(float* r, float* g, float* b, std::size_t count) const {
  if (decode_) embedded_->to_xyz(r, g, b, count);
  apply_matrix(r, g, b, count);
  if (!decode_) embedded_->from_xyz(r, g, b, count);
}

}  // namespace scotopic
