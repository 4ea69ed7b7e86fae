#include "color/icc_profile.h"

#include <lcms2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "color/icc/icc_check.h"
#include "color/primaries.h"

namespace scotopic {
namespace {

cmsUInt32Number lcms_intent(RenderingIntent intent) {
  switch (intent) {
    case RenderingIntent::perceptual:
      return INTENT_PERCEPTUAL;
    case RenderingIntent::saturation:
      return INTENT_SATURATION;
    case RenderingIntent::absolute:
      return INTENT_ABSOLUTE_COLORIMETRIC;
    case RenderingIntent::relative:
      break;
  }
  return INTENT_RELATIVE_COLORIMETRIC;
}

/// Four letters of ICC.1, without their trailing spaces.
std::string signature(std::uint32_t s) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8)
    if (const char c = static_cast<char>(s >> shift & 0xffu); c > ' ' && c < '\x7f') out += c;
  return out;
}

}  // namespace

struct IccProfile::Handles {
  ~Handles() {
    if (transform) cmsDeleteTransform(transform);
    if (device) cmsCloseProfile(device);
    if (connection) cmsCloseProfile(connection);
    if (context) cmsDeleteContext(context);
  }
  // A context of its own: LittleCMS then says nothing anywhere but in return values.
  cmsContext context = cmsCreateContext(nullptr, nullptr);
  cmsHPROFILE device = nullptr;
  cmsHPROFILE connection = nullptr;
  cmsHTRANSFORM transform = nullptr;
};

IccProfile::IccProfile(const std::string& file, RenderingIntent intent)
    : file_(file), intent_(intent), handles_(std::make_unique<Handles>()) {
  read();
  open();
}

IccProfile::~IccProfile() = default;

void IccProfile::fail(const std::string& what) const { throw Error(ExitCode::config, file_, what); }

void IccProfile::read() {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file_, error);
  if (error) fail("cannot be read: " + error.message());
  if (size > most_icc_bytes) fail("is no ICC profile: larger than any");
  bytes_.resize(static_cast<std::size_t>(size));
  std::ifstream in(file_, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size())))
    fail(std::string("cannot be read: ") + std::strerror(errno));
}

void IccProfile::open() {
  if (!is_icc(bytes_)) fail("is no ICC profile, or damaged");
  if (const std::string fault = fault_of_icc(bytes_); !fault.empty()) fail("is damaged: " + fault);
  Handles& h = *handles_;
  h.device = cmsOpenProfileFromMemTHR(h.context, bytes_.data(), static_cast<cmsUInt32Number>(bytes_.size()));
  if (!h.device) fail("is no ICC profile, or damaged");
  const cmsColorSpaceSignature space = cmsGetColorSpace(h.device);
  if (space != cmsSigRgbData) fail("is a profile of " + signature(space) + " values; output here is RGB");
  const cmsProfileClassSignature kind = cmsGetDeviceClass(h.device);
  if (kind == cmsSigLinkClass || kind == cmsSigAbstractClass || kind == cmsSigNamedColorClass)
    fail("is a profile of class " + signature(kind) + ", not of a device");
  std::array<char, 256> name{};
  cmsGetProfileInfoASCII(h.device, cmsInfoDescription, "en", "US", name.data(), name.size());
  description_ = name[0] ? name.data() : std::filesystem::path(file_).filename().string();
  h.connection = cmsCreateXYZProfileTHR(h.context);
  h.transform = cmsCreateTransformTHR(h.context, h.connection, TYPE_XYZ_DBL, h.device, TYPE_RGB_FLT,
                                      lcms_intent(intent_), cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE);
  if (!h.transform) fail("cannot be written to: no way from colour to the device, or it is damaged");
}

void IccProfile::apply(const Matrix3<double>& xyz_from_rgb, float* r, float* g, float* b,
                       std::size_t count) const {
  const Matrix3<double> connect = bradford(white_d65, icc_d50) * xyz_from_rgb;
  constexpr std::size_t most = 256;
  std::array<Vec3<double>, most> xyz;
  std::array<Vec3<float>, most> device;
  for (std::size_t at = 0; at < count; at += most) {
    const std::size_t n = std::min(most, count - at);
    for (std::size_t i = 0; i < n; ++i)
      xyz[i] = connect * Vec3<double>{tame(r[at + i]), tame(g[at + i]), tame(b[at + i])};
    cmsDoTransform(handles_->transform, xyz.data(), device.data(), static_cast<cmsUInt32Number>(n));
    for (std::size_t i = 0; i < n; ++i) {
      r[at + i] = device[i][0];
      g[at + i] = device[i][1];
      b[at + i] = device[i][2];
    }
  }
}

}  // namespace scotopic
