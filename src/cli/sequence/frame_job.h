// What a verb does to one image, apart from what it works out once for all of them.
#pragma once

#include <string>

#include "report/console.h"
#include "base/limits.h"
#include "pipeline/run.h"

namespace scotopic {

/// Where one image comes from and goes to.
struct FramePaths {
  std::string input;
  std::string output;
};

/// Options understood and the colour config read, for any number of images. A usage error is thrown when it
/// is made.
class FrameJob {
 public:
  FrameJob() = default;
  virtual ~FrameJob() = default;
  FrameJob(const FrameJob&) = delete;
  FrameJob& operator=(const FrameJob&) = delete;

  /// Writes one image, whole or not at all; returns what --json says of it. Several threads may do so at
  /// once.
  virtual nlohmann::ordered_json run(const ImageJob& job, const Console& console) = 0;
  /// What an output depends on besides the options as typed and its input: the colour config, a shot's
  /// adaptation.
  virtual std::string settings() const = 0;
  virtual const Limits& limits() const = 0;
};

}  // namespace scotopic
