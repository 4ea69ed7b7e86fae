// A host of OpenFX plug-ins, as small as a test needs: loads a module, has its suites, and hands out images
// of any bounds and strides. What it is asked for wrongly it counts.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "ofx/api.h"

namespace scotopic::ofx {

struct PropertySetStruct {
  using Value = std::variant<void*, std::string, double, int>;
  std::map<std::string, std::vector<Value>> values;

  void set(const std::string& name, std::vector<Value> to) { values[name] = std::move(to); }
  std::string text(const std::string& name, std::size_t index = 0) const;
  double number(const std::string& name, std::size_t index = 0) const;
  int integer(const std::string& name, std::size_t index = 0) const;
  std::size_t count(const std::string& name) const;
};

struct ParamStruct {
  PropertySetStruct properties;
  std::string type;
  double number = 0;
  int integer = 0;
  std::string text;
  std::function<double(Time)> animation;  ///< in place of `number`
};

struct ParamSetStruct {
  PropertySetStruct properties;
  std::map<std::string, ParamStruct> params;
};

struct ClipStruct {
  PropertySetStruct properties;
  PropertySetStruct image;
  bool has_image = true;
  RectD definition{};
};

struct ImageEffectStruct {
  PropertySetStruct properties;
  ParamSetStruct params;
  std::map<std::string, ClipStruct> clips;
};

}  // namespace scotopic::ofx

namespace scotopic::test {

/// Number type and components of a host's images.
enum class Depth { half, float32 };

/// Pixels from the bottom row up, with room around that nobody may touch.
class HostImage {
 public:
  HostImage(const ofx::RectI& bounds, int channels, Depth depth, int padding = 7);
  /// First byte of pixel (x, y), in the host's coordinates.
  std::byte* at(int x, int y);
  const ofx::RectI& bounds() const { return bounds_; }
  void describe(ofx::PropertySetStruct& image, const ofx::RectI& frame);
  std::size_t pixel_bytes() const { return pixel_bytes_; }
  /// Whether the room around is as it was.
  bool padding_is_whole() const;

 private:
  ofx::RectI bounds_;
  int channels_;
  Depth depth_;
  std::size_t pixel_bytes_, row_bytes_, padding_;
  std::vector<std::byte> bytes_;
};

/// The module, loaded and described.
class TestHost {
 public:
  /// `lacking`: a suite that it does not have.
  explicit TestHost(const std::string& module, const std::string& lacking = "");
  ~TestHost();
  TestHost(const TestHost&) = delete;
  TestHost& operator=(const TestHost&) = delete;

  ofx::Status call(const char* action, ofx::ImageEffect effect, ofx::PropertySet in = nullptr,
                   ofx::PropertySet out = nullptr) const;
  /// From now on a host of OpenFX 1.5 that offers colour management up to `style`; empty: one of 1.4.
  void offer_colour(const std::string& style);
  /// Load, describe, describe in context: the effect's panel; the status of what failed first.
  ofx::Status open(const char* context = ofx::context::filter);
  /// A copy of the description with default values, created.
  std::unique_ptr<ofx::ImageEffectStruct> instance();
  void destroy(ofx::ImageEffectStruct& effect) const { (void)call(ofx::action::destroy_instance, &effect); }

  const ofx::ImageEffectStruct& description() const { return description_; }
  /// Messages since the last call.
  std::vector<std::string> take_messages();

 private:
  void agree_on_colour(ofx::ImageEffectStruct& effect) const;

  void* module_;
  ofx::Plugin* plugin_ = nullptr;
  ofx::Host host_{};
  ofx::PropertySetStruct host_properties_;
  ofx::ImageEffectStruct description_;
};

}  // namespace scotopic::test
