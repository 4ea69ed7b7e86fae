#include "color/file/written_tags.h"

#include <lcms2.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "color/icc/embedded_profile.h"

namespace scotopic {
namespace {

using Bytes = std::vector<std::byte>;

/// Of LittleCMS, each closed at its end.
struct Made {
  ~Made() {
    if (profile) cmsCloseProfile(profile);
    for (cmsToneCurve* const curve : curves)
      if (curve) cmsFreeToneCurve(curve);
    if (context) cmsDeleteContext(context);
  }
  cmsContext context = cmsCreateContext(nullptr, nullptr);
  std::array<cmsToneCurve*, 3> curves{};
  cmsHPROFILE profile = nullptr;
};

cmsToneCurve* tone_curve(cmsContext context, const TransferCurve& curve) {
  if (curve.scale != 1 || curve.offset != 0) return nullptr;
  // ICC.1, parametric type 3: IEC 61966-2-1.
  const cmsFloat64Number srgb[5] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  switch (curve.kind) {
    case Transfer::linear:
      return cmsBuildGamma(context, 1.0);
    case Transfer::power:
      return cmsBuildGamma(context, curve.exponent);
    case Transfer::srgb:
      return cmsBuildParametricToneCurve(context, 4, srgb);
    case Transfer::pq:
    case Transfer::hlg:
    case Transfer::dcdm:
      break;
  }
  return nullptr;
}

bool write_text(const Made& made, cmsTagSignature tag, const std::string& text) {
  cmsMLU* const words = cmsMLUalloc(made.context, 1);
  const bool done =
      words && cmsMLUsetASCII(words, "en", "US", text.c_str()) && cmsWriteTag(made.profile, tag, words);
  if (words) cmsMLUfree(words);
  return done;
}

/// Light of each code; a table as long as that of 16 bits is more than a profile holds (ICC.1: LittleCMS
/// takes 65530), and is met at 4096 places.
cmsToneCurve* tone_curve(cmsContext context, std::span<const std::uint16_t> table) {
  constexpr std::size_t most = 4096;
  if (!std::is_sorted(table.begin(), table.end()) || table.front() == table.back()) return nullptr;
  std::vector<std::uint16_t> places(std::min(most, table.size()));
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = table[(i * (table.size() - 1) + (places.size() - 1) / 2) / (places.size() - 1)];
  return cmsBuildTabulatedToneCurve16(context, static_cast<cmsUInt32Number>(places.size()), places.data());
}

/// A display profile of matrix and curves (ICC.1:2001-04, 6.3.2.2): written by hand, as CIE XYZ has primaries
/// of y = 0.
bool fill_profile(const Made& made, const Matrix3<double>& d50_from_rgb, const std::string& name) {
  cmsSetProfileVersion(made.profile, 2.4);
  cmsSetDeviceClass(made.profile, cmsSigDisplayClass);
  cmsSetColorSpace(made.profile, cmsSigRgbData);
  cmsSetPCS(made.profile, cmsSigXYZData);
  const cmsTagSignature colorants[] = {cmsSigRedColorantTag, cmsSigGreenColorantTag, cmsSigBlueColorantTag};
  const cmsTagSignature curves[] = {cmsSigRedTRCTag, cmsSigGreenTRCTag, cmsSigBlueTRCTag};
  bool done = write_text(made, cmsSigProfileDescriptionTag, "scotopic: RGB, " + name) &&
              write_text(made, cmsSigCopyrightTag, "No copyright") &&
              cmsWriteTag(made.profile, cmsSigMediaWhitePointTag, cmsD50_XYZ());
  for (std::size_t c = 0; c < 3; ++c) {
    const cmsCIEXYZ xyz = {d50_from_rgb[0][c], d50_from_rgb[1][c], d50_from_rgb[2][c]};
    done = done && cmsWriteTag(made.profile, colorants[c], &xyz) &&
           cmsWriteTag(made.profile, curves[c], made.curves[c]);
  }
  return done;
}

/// Its bytes; empty where a curve is missing.
Bytes saved(Made& made, const Matrix3<double>& xyz_from_rgb, const std::string& name) {
  if (!made.curves[0] || !made.curves[1] || !made.curves[2]) return {};
  made.profile = cmsCreateProfilePlaceholder(made.context);
  if (!made.profile || !fill_profile(made, bradford(white_d65, icc_d50) * xyz_from_rgb, name)) return {};
  cmsUInt32Number size = 0;
  if (!cmsSaveProfileToMem(made.profile, nullptr, &size)) return {};
  Bytes out(size);
  if (!cmsSaveProfileToMem(made.profile, out.data(), &size)) return {};
  // Its date is of no use, and would make the same picture different bytes: 1 January 2000 (ICC.1, 7.2.8).
  const std::array<unsigned char, 12> date = {0x07, 0xd0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0};
  for (std::size_t i = 0; i < date.size(); ++i) out[24 + i] = std::byte{date[i]};
  return out;
}

std::shared_ptr<const Bytes> shared(Bytes bytes) {
  return bytes.empty() ? nullptr : std::make_shared<const Bytes>(std::move(bytes));
}

std::shared_ptr<const Bytes> profile_of(const ColourSpace& space,
                                        const std::optional<Matrix3<double>>& linear) {
  if (space.profile) return shared(space.profile->bytes());
  if (space.embedded) return shared(space.embedded->bytes());
  if (linear) return shared(make_profile({}, *linear));
  return space.xyz_from_rgb ? shared(make_profile(space.curve, *space.xyz_from_rgb)) : nullptr;
}

}  // namespace

Primaries primaries_of(const Matrix3<double>& m) {
  const auto xy = [&](std::size_t c) {
    const double sum = m[0][c] + m[1][c] + m[2][c];
    return Xy{m[0][c] / sum, m[1][c] / sum};
  };
  return {xy(0), xy(1), xy(2), white_d65};
}

Bytes make_profile(const TransferCurve& curve, const Matrix3<double>& xyz_from_rgb) {
  Made made;
  for (cmsToneCurve*& channel : made.curves) channel = tone_curve(made.context, curve);
  return saved(made, xyz_from_rgb, describe(curve));
}

Bytes make_table_profile(const std::vector<std::uint16_t>& tables, const Matrix3<double>& xyz_from_rgb) {
  Made made;
  // One table has a power of two of entries, no multiple of three.
  const std::size_t size = tables.size() % 3 == 0 ? tables.size() / 3 : tables.size();
  for (std::size_t c = 0; size > 1 && c < 3; ++c)
    made.curves[c] =
        tone_curve(made.context, std::span(tables).subspan(size == tables.size() ? 0 : c * size, size));
  return saved(made, xyz_from_rgb, "TransferFunction");
}

WrittenTags written_tags(const ColourSpace& space, const ColourConfig& config) {
  WrittenTags tags;
  tags.srgb = config.is_srgb(space);
  const std::optional<Matrix3<double>> xyz = config.linear_xyz(space);
  tags.linear = xyz.has_value();
  if (xyz) {
    const NamedPrimaries* known = match_matrix(*xyz);
    tags.primaries = known ? known->primaries : primaries_of(*xyz);
    if (is_cie_xyz(*xyz)) {
      tags.primaries = cie_xyz_primaries();
      tags.adopted_neutral = white_d65;
    }
  }
  if (!tags.srgb) tags.icc = profile_of(space, xyz);
  return tags;
}

bool can_be_stated(const ColourSpace& space, bool exr, bool named) {
  if (space.embedded) return !exr && space.embedded->can_be_written();
  if (!space.xyz_from_rgb || space.curve.linear()) return true;
  return exr ? named : !make_profile(space.curve, *space.xyz_from_rgb).empty();
}

}  // namespace scotopic
