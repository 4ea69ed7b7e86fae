// What the tests of the plug-in share: panels and the options that they stand for, pictures, clips.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ofx/host.h"
#include "ofx/host_suites.h"
#include "support/exr_files.h"

namespace scotopic::test {

constexpr int width = 389, height = 241;

/// The program and the plug-in take five times as long then.
#ifdef __SANITIZE_ADDRESS__
constexpr bool slowed_by_sanitizer = true;
#else
constexpr bool slowed_by_sanitizer = false;
#endif

/// Values of the panel, and what they are as the program's options.
struct Setting {
  const char* name;
  std::function<void(ofx::ImageEffectStruct&)> set;
  std::vector<std::string> options;
  enum class Needs { pixel, halo, frame };
  Needs needs = Needs::pixel;  ///< what of the source a pixel depends on
};

/// All stages.
const std::vector<Setting>& settings();

/// Sets a number, a menu by its word, a tick.
void number(ofx::ImageEffectStruct& effect, const std::string& name, double value);
void word(ofx::ImageEffectStruct& effect, const std::string& name, const std::string& value);
void tick(ofx::ImageEffectStruct& effect, const std::string& name, bool value);

/// A picture as the program reads and writes it.
class Picture {
 public:
  Picture(int channels, Depth depth);
  static std::string file() { return temporary("ofx_in.exr"); }

  /// Its pixels, or those of another file, into a host's image whose frame begins at (x, y).
  void put(const std::string& from, HostImage& image, int x0, int y0) const;

 private:
  int channels_;
  std::size_t size_;
};

ofx::Status render(const TestHost& host, ofx::ImageEffectStruct& effect, const ofx::RectI& window,
                   double time = 0, double scale = 1);

/// Source and output of an effect.
struct Clips {
  Clips(ofx::ImageEffectStruct& effect, const ofx::RectI& bounds, const ofx::RectI& frame, int channels,
        Depth depth);
  HostImage source, target;
};

/// Byte for byte.
bool same_pixels(HostImage& a, HostImage& b, const ofx::RectI& window);

class Plugin : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(host_.open(), ofx::ok); }
  void TearDown() override {
    EXPECT_TRUE(host_.take_messages().empty());
    EXPECT_EQ(memory_in_use(), 0);
  }
  std::unique_ptr<ofx::ImageEffectStruct> instance(const Setting& setting) {
    auto out = host_.instance();
    setting.set(*out);
    return out;
  }
  TestHost host_{SCOTOPIC_OFX};
};

}  // namespace scotopic::test
