// The operator on images in memory: all stages of `scotopic apply`, with its parameters, and its bytes.
//
//   const scotopic::Parameters parameters = {{"adaptation", "moon"}, {"white_luminance", "5"}};
//   const scotopic::Operator moon(parameters);
//   scotopic::Frame frame;
//   frame.in = frame.out = pixels;          // linear light in the working space, or in parameter colorspace
//   const scotopic::Plan plan = moon.apply(frame);
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "scotopic/error.h"
#include "scotopic/image.h"
#include "scotopic/parameters.h"
#include "scotopic/plan.h"

namespace scotopic {

class HostOperator;

/// An image, and where its result goes.
struct Frame {
  MemoryPixels in;
  /// As many pixels, channels, and of the same type. May be `in`, but may not overlap it in any other way.
  MemoryPixels out;
  bool straight = false;     ///< colour is not multiplied by alpha
  double pixel_aspect = 1;   ///< width over height of a pixel
  std::optional<int> frame;  ///< its number in a sequence; nullopt: a still
};

/// Takes what the program would print as notes: assumptions, stages that are skipped.
using NoteSink = std::function<void(const std::string& line)>;

/// Immutable, cheap to copy; any number of threads at once.
class Operator {
 public:
  /// Reads the colour config. Error(usage) for a name or value that is not understood, in the program's own
  /// words; Error(config) for a config or space.
  explicit Operator(const Parameters& parameters);

  /// Writes frame.out; what was done. After an Error its pixels are undefined. Samples of float64 go through
  /// the stages as float; parameter "precision" = "double" computes in double.
  Plan apply(const Frame& frame, const NoteSink& note = nullptr) const;
  /// What apply() would do; `out` is not looked at.
  Plan plan(const Frame& frame) const;
  /// What `scotopic explain --json` says of the image.
  std::string explain(const Frame& frame) const;
  /// The pixel stages as a LUT file: .clf, .ctf, .spi3d, .cube; 17, 33, 65 or 129 nodes a side.
  void bake(const std::string& path, int nodes = 33) const;
  /// The pixel stages as the text of a shader: dctl, glsl, blink, hlsl or osl; see docs/hosts.md.
  std::string shader(const std::string& language) const;

 private:
  std::shared_ptr<const HostOperator> host_;
};

/// Threads that all operators of the process use; 0: as many as the machine has.
void use_threads(int count);

}  // namespace scotopic
