// The colour config in force, and the ways between its spaces and the one the operator works in.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "color/icc_profile.h"
#include "base/limits.h"
#include "color/primaries.h"
#include "color/transfer.h"
#include "kernel/matrix3.h"

namespace scotopic {

/// A way to look at light on a display, as a config names it.
struct DisplayView {
  std::string display;
  std::string view;
};

class EmbeddedProfile;

/// An RGB space: one of the config's; light with the primaries and the curve that a file states, or as the
/// profile that it embeds has it; what a display is sent under one of the config's views; or the values of a
/// device that an ICC profile describes. Where `name` is not the config's it is only for the reader.
struct ColourSpace {
  std::string name;
  std::optional<Matrix3<double>> xyz_from_rgb =
      std::nullopt;                                     ///< of light with stated primaries, after `curve`
  std::optional<DisplayView> view = std::nullopt;       ///< results only
  std::shared_ptr<const IccProfile> profile = nullptr;  ///< results only
  TransferCurve curve = {};                             ///< with xyz_from_rgb only
  std::shared_ptr<const EmbeddedProfile> embedded = nullptr;  ///< of the file

  /// Values are for a device, no longer light.
  bool for_a_device() const noexcept { return view || profile; }
};

/// A conversion of planar RGB float rows, in place. Cheap to copy; share it between threads.
/// Pixels are independent of each other: the result does not depend on how rows are cut.
class RowConverter {
 public:
  RowConverter() = default;  ///< the identity
  /// RGB times a matrix, in double, rounded once.
  explicit RowConverter(const Matrix3<double>& matrix);
  /// Whatever a processor of OCIO does.
  explicit RowConverter(OCIO_NAMESPACE::ConstCPUProcessorRcPtr processor);
  /// Encoded values to light (`decode`), or back: the curve, then the matrix; the matrix, then the curve.
  RowConverter(const TransferCurve& curve, const Matrix3<double>& matrix, bool decode);
  /// A file's values to light (the matrix comes after), or back (before).
  RowConverter(std::shared_ptr<const EmbeddedProfile> embedded, const Matrix3<double>& matrix, bool decode);
  /// Device values of linear light.
  RowConverter(std::shared_ptr<const IccProfile> profile, const Matrix3<double>& xyz_from_rgb);

  /// Whether apply() changes nothing.
  bool identity() const noexcept { return !matrix_ && !processor_; }
  /// `count` pixels in place; any thread.
  void apply(float* r, float* g, float* b, std::size_t count) const;

 private:
  void apply_matrix(float* r, float* g, float* b, std::size_t count) const;
  void apply_embedded(float* r, float* g, float* b, std::size_t count) const;

  std::optional<Matrix3<double>> matrix_;
  TransferCurve curve_;
  bool decode_ = true;
  std::shared_ptr<const EmbeddedProfile> embedded_;
  OCIO_NAMESPACE::ConstCPUProcessorRcPtr processor_;
  std::shared_ptr<const IccProfile> profile_;
};

/// A space by the config's rules, and which of them.
struct RuledSpace {
  ColourSpace space;
  std::string reason;
};

/// Throws Error(ExitCode::config) whenever the config or one of its spaces is at fault.
class ColourConfig {
 public:
  /// `file` if not empty, else the file $OCIO names, else the project's own config.
  /// Configs and LUTs larger than `limits` are Error(limit). `working`: CIE XYZ (D65) from RGB of role
  /// scene_linear, for configs whose roles do not say it; where they say another thing, Error(config).
  static ColourConfig in_force(const std::string& file, const Limits& limits = {},
                               const std::optional<Matrix3<double>>& working = std::nullopt);
  /// The project's own config.
  static ColourConfig own();
  /// This config; or, where it is the project's own and `view` is none of it, the one that is shipped with
  /// all looks and views - the same spaces -, where that is found beside the program or where it was
  /// installed.
  ColourConfig holding(const std::string& view) const;
  /// Read from a file.
  static ColourConfig from_file(const std::string& file, const Limits& limits = {},
                                const std::optional<Matrix3<double>>& working = std::nullopt);

  /// As OCIO has it.
  const OCIO_NAMESPACE::ConstConfigRcPtr& ocio() const noexcept { return config_; }
  /// The config's file; empty for the project's own.
  const std::string& file() const noexcept { return file_; }
  /// That hold for its LUT files.
  const Limits& limits() const noexcept { return limits_; }
  /// The name of the space in role scene_linear: the one the operator works in.
  const std::string& working_space() const noexcept { return working_space_; }
  /// CIE XYZ (D65-adapted) from working RGB. Where OCIO's matrix is that of a known RGB space to 1e-4, the
  /// exact one in double, so that RGB (1,1,1) has Y = 1 to 1 ulp.
  const Matrix3<double>& xyz_from_working() const noexcept { return xyz_from_working_; }
  /// rec709, ap1, ... if xyz_from_working() is that of a known space, else empty.
  const std::string& working_gamut() const noexcept { return working_gamut_; }

  /// The canonical name of a space, role or alias; for an unknown one, an error that lists close names.
  std::string resolve(const std::string& name) const;
  /// The space by name, role or alias; else an error as of resolve().
  ColourSpace space(const std::string& name) const { return {resolve(name)}; }
  /// What a display is sent under a view: VIEW of the config's default display, or DISPLAY/VIEW. For a name
  /// that does not exist, an error that lists close ones.
  ColourSpace view(const std::string& name) const;
  /// The looks that a view applies by itself; empty where it has none.
  std::string looks_of(const DisplayView& view) const;
  /// Whether there is a space, role or alias of that name.
  bool has_space(const std::string& name) const;
  /// What the config's rules say of a file. Of pixels that only the default rule matches its roles say more,
  /// where there are such: default_byte of `integer` ones, default_float of others.
  RuledSpace space_by_rules(const std::string& file, bool integer) const;
  ColourSpace space_of_file(const std::string& file, bool integer) const {
    return space_by_rules(file, integer).space;
  }
  /// Every space, role and alias.
  std::vector<std::string> names() const;
  /// Whether pixels of both spaces mean the same.
  bool same(const ColourSpace& a, const ColourSpace& b) const;
  /// Whether values of the space are the encoded ones of IEC 61966-2-1, BT.709 primaries.
  bool is_srgb(const ColourSpace& space) const;

  /// The space of what a display is sent: a display's name, where a space is called like it, or a space.
  ColourSpace display_space(const std::string& name) const;
  /// What an encoded space's code 1 of R, G, B stands for.
  struct Encoding {
    Matrix3<double> xyz_from_rgb;  ///< of its linear light; white has Y = 1
    double white = 1;              ///< luminance of (1, 1, 1), where 1 is the working space's white
  };
  /// nullopt where such codes are no colours of finite light, or where white is none.
  std::optional<Encoding> encoding(const ColourSpace& space) const;

  /// CIE XYZ (D65-adapted) from the space's RGB; nullopt if it is not linear light.
  std::optional<Matrix3<double>> linear_xyz(const ColourSpace& space) const;

  /// From a space's values to linear working RGB.
  RowConverter to_working(const ColourSpace& from) const;
  /// And back.
  RowConverter from_working(const ColourSpace& to) const;

 private:
  ColourConfig(OCIO_NAMESPACE::ConstConfigRcPtr config, std::string file, const Limits& limits,
               const std::optional<Matrix3<double>>& working);
  void find_xyz(const std::optional<Matrix3<double>>& stated);
  std::optional<Matrix3<double>> interchange_matrix() const;
  std::optional<Matrix3<double>> linear_matrix(const std::string& from, const std::string& to) const;
  OCIO_NAMESPACE::ConstCPUProcessorRcPtr processor(const std::string& from, const std::string& to) const;
  OCIO_NAMESPACE::ConstCPUProcessorRcPtr processor(const DisplayView& to) const;
  std::vector<std::string> displays() const;
  std::vector<std::string> views(const std::string& display) const;
  [[noreturn]] void fail(const std::string& what) const;

  OCIO_NAMESPACE::ConstConfigRcPtr config_;
  std::string file_;
  Limits limits_;
  std::string working_space_;
  Matrix3<double> xyz_from_working_ = identity3<double>();
  std::string working_gamut_;
};

}  // namespace scotopic
