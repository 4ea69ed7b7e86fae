#include "color/icc/embedded_profile.h"

#include <lcms2.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "color/icc/icc_check.h"
#include "color/primaries.h"

namespace scotopic {
namespace {

constexpr std::size_t piece = 256;
constexpr cmsUInt32Number flags = cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE;

const Matrix3<double>& d65_from_d50() {
  static const Matrix3<double> m = bradford(icc_d50, white_d65);
  return m;
}

}  // namespace

struct EmbeddedProfile::Handles {
  ~Handles() {
    for (const cmsHTRANSFORM t : {to, from})
      if (t) cmsDeleteTransform(t);
    for (const cmsHPROFILE p : {device, connection})
      if (p) cmsCloseProfile(p);
    if (context) cmsDeleteContext(context);
  }
  // A context of its own: LittleCMS then says nothing anywhere but in return values.
  cmsContext context = cmsCreateContext(nullptr, nullptr);
  cmsHPROFILE device = nullptr, connection = nullptr;
  cmsHTRANSFORM to = nullptr, from = nullptr;
};

EmbeddedProfile::EmbeddedProfile(std::vector<std::byte> bytes, const std::string& file)
    : bytes_(std::move(bytes)), handles_(std::make_unique<Handles>()) {
  const auto fail = [&](const std::string& what) { throw Error(ExitCode::input, file, what); };
  if (const std::string fault = fault_of_icc(bytes_); !fault.empty())
    fail("its ICC profile is damaged: " + fault);
  Handles& h = *handles_;
  h.device = cmsOpenProfileFromMemTHR(h.context, bytes_.data(), static_cast<cmsUInt32Number>(bytes_.size()));
  if (!h.device) fail("its ICC profile is damaged");
  const cmsColorSpaceSignature space = cmsGetColorSpace(h.device);
  grey_ = space == cmsSigGrayData;
  if (!grey_ && space != cmsSigRgbData) fail("its ICC profile is not of RGB or grey values");
  std::array<char, 256> name{};
  cmsGetProfileInfoASCII(h.device, cmsInfoDescription, "en", "US", name.data(), name.size());
  description_ = name[0] ? name.data() : "without a name";
  h.connection = cmsCreateXYZProfileTHR(h.context);
  const cmsUInt32Number values = grey_ ? TYPE_GRAY_FLT : TYPE_RGB_FLT;
  constexpr cmsUInt32Number intent = INTENT_RELATIVE_COLORIMETRIC;
  h.to = cmsCreateTransformTHR(h.context, h.device, values, h.connection, TYPE_XYZ_DBL, intent, flags);
  if (!h.to) fail("its ICC profile has no way from its values to colour, or is damaged");
  h.from = cmsCreateTransformTHR(h.context, h.connection, TYPE_XYZ_DBL, h.device, values, intent, flags);
}

EmbeddedProfile::~EmbeddedProfile() = default;

bool EmbeddedProfile::can_be_written() const noexcept { return handles_->from != nullptr && !grey_; }

void EmbeddedProfile::to_xyz(float* r, float* g, float* b, std::size_t count) const {
  std::array<float, 3 * piece> device;
  std::array<Vec3<double>, piece> xyz;
  const std::size_t channels = grey_ ? 1 : 3;
  for (std::size_t at = 0; at < count; at += piece) {
    const std::size_t n = std::min(piece, count - at);
    for (std::size_t i = 0; i < n; ++i) {
      const float rgb[3] = {tame(r[at + i]), tame(g[at + i]), tame(b[at + i])};
      std::copy_n(rgb, channels, &device[channels * i]);
    }
    cmsDoTransform(handles_->to, device.data(), xyz.data(), static_cast<cmsUInt32Number>(n));
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3<double> d65 = d65_from_d50() * xyz[i];
      r[at + i] = static_cast<float>(d65[0]);
      g[at + i] = static_cast<float>(d65[1]);
      b[at + i] = static_cast<float>(d65[2]);
    }
  }
}

void EmbeddedProfile::from_xyz(float* r, float* g, float* b, std::size_t count) const {
  static const Matrix3<double> d50_from_d65 = bradford(white_d65, icc_d50);
  std::array<Vec3<double>, piece> xyz;
  std::array<Vec3<float>, piece> device;
  for (std::size_t at = 0; at < count; at += piece) {
    const std::size_t n = std::min(piece, count - at);
    for (std::size_t i = 0; i < n; ++i)
      xyz[i] = d50_from_d65 * Vec3<double>{tame(r[at + i]), tame(g[at + i]), tame(b[at + i])};
    cmsDoTransform(handles_->from, xyz.data(), device.data(), static_cast<cmsUInt32Number>(n));
    for (std::size_t i = 0; i < n; ++i) {
      r[at + i] = device[i][0];
      g[at + i] = device[i][1];
      b[at + i] = device[i][2];
    }
  }
}

}  // namespace scotopic
