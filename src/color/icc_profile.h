// A device by its ICC profile: the light of an image as that device's own values, through LittleCMS.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "kernel/matrix3.h"

namespace scotopic {

/// ICC.1's rendering intents. Relative: white is the device's white; absolute: the paper of a printing
/// profile shows; perceptual and saturation: as the profile's own tables have it (a profile of matrix and
/// curves has but one way).
enum class RenderingIntent { perceptual, relative, saturation, absolute };

/// Immutable: share it between threads.
class IccProfile {
 public:
  /// Error(config) for a file that cannot be read, is no ICC profile, or not one of an RGB device that can be
  /// written to.
  IccProfile(const std::string& file, RenderingIntent intent);
  ~IccProfile();
  IccProfile(const IccProfile&) = delete;
  IccProfile& operator=(const IccProfile&) = delete;

  /// As it was named.
  const std::string& file() const noexcept { return file_; }
  /// The profile itself, to be embedded.
  const std::vector<std::byte>& bytes() const noexcept { return bytes_; }
  /// What the profile calls itself; the file's name where it does not.
  const std::string& description() const noexcept { return description_; }

  /// Device values 0..1 from linear RGB rows whose white is D65 (xyz_from_rgb takes it to the XYZ of D65, Y =
  /// 1), adapted to the profile's D50 by Bradford. A component that is not finite counts as 0, one beyond 1e4
  /// as that.
  void apply(const Matrix3<double>& xyz_from_rgb, float* r, float* g, float* b, std::size_t count) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void read();
  void open();

  struct Handles;
  std::string file_;
  RenderingIntent intent_;
  std::vector<std::byte> bytes_;
  std::string description_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace scotopic
