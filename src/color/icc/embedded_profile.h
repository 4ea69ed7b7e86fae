// The ICC profile that an image embeds: its values as light, through LittleCMS, and back.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace scotopic {

/// Immutable: share it between threads.
class EmbeddedProfile {
 public:
  /// Error(input), about `file`, for a profile that is damaged, or not of RGB (or of grey) values.
  EmbeddedProfile(std::vector<std::byte> bytes, const std::string& file);
  ~EmbeddedProfile();
  EmbeddedProfile(const EmbeddedProfile&) = delete;
  EmbeddedProfile& operator=(const EmbeddedProfile&) = delete;

  const std::vector<std::byte>& bytes() const noexcept { return bytes_; }
  /// What the profile calls itself.
  const std::string& description() const noexcept { return description_; }
  /// Whether values are of one channel.
  bool grey() const noexcept { return grey_; }
  /// Whether light can be turned into its values: some profiles only lead from the device.
  bool can_be_written() const noexcept;

  /// Rows of device values become CIE XYZ, relative colorimetric, adapted from D50 to D65 by Bradford: white
  /// is the XYZ of D65 with Y = 1. Of a grey profile r counts. Unbounded where the profile is matrix and
  /// curves.
  void to_xyz(float* r, float* g, float* b, std::size_t count) const;
  /// And back.
  void from_xyz(float* r, float* g, float* b, std::size_t count) const;

 private:
  struct Handles;
  std::vector<std::byte> bytes_;
  std::string description_;
  bool grey_ = false;
  std::unique_ptr<Handles> handles_;
};

}  // namespace scotopic
