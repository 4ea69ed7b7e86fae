// A folder with the frames of a shot, and what the tests ask of files.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/run_program.h"

namespace scotopic::test {

class Sequence : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  /// in.0001.exr and on; each `step` times as bright as the one before; the first of values .01 to 1.
  void write_frames(int count, double step = 1, int width = 48, int height = 40) const;
  /// Any arguments of the program; {} stands for the folder.
  Outcome run(std::vector<std::string> arguments) const;
  /// apply in.####.exr -o seen.####.exr --white-luminance 1 and these.
  Outcome apply(std::vector<std::string> more) const;
  /// Its --json, which must succeed.
  nlohmann::json applied(std::vector<std::string> more) const;
  /// status of each frame of such a result: "written", "skipped", "failed".
  static std::map<int, std::string> statuses(const nlohmann::json& result);

  bool exists(const std::string& name) const;
  std::string bytes(const std::string& name) const;
  void write(const std::string& name, const std::string& bytes) const;
  /// Files of the folder, hidden ones too, whose names begin so.
  std::size_t files(const std::string& start) const;

  std::string folder_;
};

/// A half EXR whose values are `scale` times a pattern of .01 to 1.
void write_scaled_picture(const std::string& file, int width, int height, double scale);

/// A float attribute of an EXR file's first part.
double float_attribute(const std::string& file, const char* name);

}  // namespace scotopic::test
