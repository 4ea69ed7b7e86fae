#include "receptors/tables.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace scotopic {
namespace {

namespace fs = std::filesystem;

struct Range {
  const char* name;
  const TabulatedCurve* curve;
  double first_nm, step_nm, last_nm, peak;
};

const Range ranges[] = {
    {"l", &tables::cones_stockman_sharpe_2000_2deg_l, 390, 1, 830, 1.0},
    {"m", &tables::cones_stockman_sharpe_2000_2deg_m, 390, 1, 830, 1.0},
    {"s", &tables::cones_stockman_sharpe_2000_2deg_s, 390, 1, 830, 1.0},
    {"V'", &tables::scotopic_cie_1951_v_prime, 380, 5, 780, 0.998},  // 1.000 lies between samples
    {"x", &tables::xyz_cie_1931_2deg_x, 360, 1, 830, 1.06291},
    {"y", &tables::xyz_cie_1931_2deg_y, 360, 1, 830, 1.0},
    {"z", &tables::xyz_cie_1931_2deg_z, 360, 1, 830, 1.78297},
    {"D65", &tables::illuminant_cie_d65_d65, 380, 5, 780, 117.81},
    {"A", &tables::illuminant_cie_a_a, 380, 5, 780, 241.68},
    {"HPS", &tables::lamps_houser_2013_hps, 380, 5, 780, 1.0},
    {"LED 3000", &tables::lamps_houser_2013_led3000, 380, 5, 780, 1.0},
    {"LED 4000", &tables::lamps_houser_2013_led4000, 380, 5, 780, 1.0},
};

TEST(Tables, every_curve_spans_its_range_with_its_peak) {
  for (const Range& row : ranges) {
    EXPECT_EQ(row.curve->first_nm, row.first_nm) << row.name;
    EXPECT_EQ(row.curve->step_nm, row.step_nm) << row.name;
    EXPECT_EQ(row.curve->last_nm(), row.last_nm) << row.name;
    EXPECT_NEAR(*std::ranges::max_element(row.curve->values), row.peak, 2e-5 * row.peak) << row.name;
    EXPECT_GE(*std::ranges::min_element(row.curve->values), 0.0) << row.name;
  }
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Tables, every_file_begins_with_its_source) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(SCOTOPIC_SOURCE_DIR "/src/receptors/tables")) {
    const std::string text = text_of(entry.path());
    EXPECT_EQ(text.rfind("# ", 0), 0u) << entry.path();
    EXPECT_NE(text.find("licence Expat"), std::string::npos) << entry.path();
    EXPECT_NE(text.find("\n# nm; "), std::string::npos) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 7);
}

TEST(Tables, script_writes_the_files_byte_for_byte) {
  if (!fs::exists(SCOTOPIC_PSYCHTOOLBOX_DATA)) GTEST_SKIP() << "psychtoolbox-3-common is not installed";
  if (std::system("/usr/bin/python3 -c 'import scipy.io' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3-scipy is not installed";
  std::string folder = fs::temp_directory_path() / "scotopic-tables-XXXXXX";
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::string command = "/usr/bin/python3 " SCOTOPIC_SOURCE_DIR
                              "/scripts/convert_receptor_data.py --output " +
                              folder + " --reflectances " + folder;
  EXPECT_EQ(std::system(command.c_str()), 0);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    const bool reflectances = name.rfind("reflectances_", 0) == 0;
    const fs::path kept(reflectances ? SCOTOPIC_TEST_DATA : SCOTOPIC_SOURCE_DIR "/src/receptors/tables");
    EXPECT_TRUE(text_of(entry.path()) == text_of(kept / name)) << name;
    ++files;
  }
  EXPECT_EQ(files, 7 + 4);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace scotopic
