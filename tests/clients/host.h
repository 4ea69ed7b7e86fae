// Other people's programs, run on the shipped config.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <string>
#include <vector>

namespace scotopic::test {

struct Finished {
  int exit_code = -1;
  std::string said;  ///< stdout and stderr
};

/// Through a shell, with a minute's limit; $OCIO and $SCOTOPIC_LA are unset unless the command sets them.
Finished run(const std::string& command);

/// Whether a program is on the path.
bool have(const std::string& program);

/// For shells.
std::string quoted(const std::string& text);

/// A folder of this process's own; removed when it ends well.
const std::string& work_folder();
/// A file in it.
inline std::string output(const std::string& name) { return work_folder() + "/" + name; }

/// RGBA float, four values a pixel.
using Pixels = std::vector<float>;

/// 64 x 64 colours over 20 stops, some outside Rec.709, alpha from 0 to 1. Uncompressed OpenEXR, the same
/// file for all.
const Pixels& test_pixels();
const std::string& test_image();

Pixels read_pixels(const std::string& file);
/// Uncompressed float OpenEXR; throws where it cannot be written.
void write_pixels(const std::string& file, const Pixels& pixels, int width);

/// The shipped config, and test_pixels() as OCIO itself takes them through a transform of it.
std::string config_file();
OCIO_NAMESPACE::ConstConfigRcPtr config();
Pixels expected(const OCIO_NAMESPACE::ConstTransformRcPtr& transform);

OCIO_NAMESPACE::TransformRcPtr look_transform(const std::string& look);
OCIO_NAMESPACE::TransformRcPtr view_transform(const std::string& display, const std::string& view);

/// Whether the programs run the release of OpenColorIO that this test is linked with.
bool programs_have_this_ocio();

/// Largest difference of RGB, relative to the pixel's largest component; infinite where alpha differs at all
/// or sizes do. Between two releases of OpenColorIO, whose logarithms and powers differ: to 0.05 at least,
/// and where alpha differs by more than 2e-5 (2.6 takes it to the power 1). Prints it.
double worst_difference(const std::string& what, const Pixels& got, const Pixels& wanted);

inline const std::string linear = "Linear Rec.709 (sRGB)";
inline const std::string street = "Mesopic 0.1 nit (street lighting)";
inline const std::string night = "Night 0.1 nit (street lighting)";
inline const std::string moon = "Mesopic 0.01 nit (full moon)";
inline const std::string srgb = "sRGB - Display";

}  // namespace scotopic::test

/// Says which program is missing and leaves the test.
#define NEEDS(program)                \
  if (!scotopic::test::have(program)) \
  GTEST_SKIP() << "NOTICE: " << program << " is not installed, not tested with it"
