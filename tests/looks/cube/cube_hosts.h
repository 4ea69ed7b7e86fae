// Programs that take a cube, on codes of footage: each one's picture beside the operator itself, and beside
// the cube as we read it. A program that is not installed is skipped with a notice.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "looks/cube/reading.h"

namespace scotopic::test {

/// Whether the shell finds it.
bool have(const std::string& program);

#define NEEDS(program) \
  if (!test::have(program)) GTEST_SKIP() << "NOTICE: " << program << " is not installed, not tested with it"

/// What a host's picture is held to.
struct HostBounds {
  Reading reading;   ///< that the host's is compared with
  double own;        ///< largest difference of a code to our reading of the cube
  double mean, p99;  ///< CIEDE2000 to the operator
};

/// For ACEScct and for DaVinci Intermediate, whose nodes go below 0, a folder with a cube at 0.1 cd/m2 of 33
/// nodes a side (street.cube) and a picture of codes that it was not fitted to (in.png): Rec.709 colours of
/// -8 to 5 stops, 16 bits.
class CubeHosts : public testing::Test {
 public:
  enum Space { acescct, davinci };

 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();

  /// Runs a command in the space's folder, which must write a picture.
  static void expect(const std::string& host, const std::string& command, const HostBounds& bounds,
                     Space space = acescct, const std::string& output = "out.png");

  static std::string folder(Space space);

  /// Writes hald.png, a Hald image of 64 nodes a side, of the cube: what programs without .cube take. From an
  /// identity of ours: the one that ffmpeg makes (haldclutsrc) is off by 0.02 at its end (5.1: its codes go
  /// through YUV). Gives the command that does it.
  static std::string hald();
};

}  // namespace scotopic::test
