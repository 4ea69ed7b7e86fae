#include "io/light_channels.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace scotopic {
namespace {

using Kind = ColourChannels::Kind;

Subimage picture_of(const std::vector<std::string>& names) {
  Subimage out;
  out.data = {0, 0, 100, 100};
  for (const std::string& name : names) out.channels.push_back({name, PixelType::half});
  return out;
}

TEST(FindColour, light_is_found_where_files_keep_it) {
  struct Row {
    std::vector<std::string> channels;
    std::string layer;
    Kind kind;
    std::array<std::size_t, 4> index;
  };
  const std::vector<Row> rows = {
      {{"A", "B", "G", "R"}, "", Kind::rgb, {3, 2, 1, 0}},
      {{"B", "G", "R", "diffuse.B", "diffuse.G", "diffuse.R"}, "", Kind::rgb, {2, 1, 0, 0}},
      {{"B", "G", "R", "diffuse.B", "diffuse.G", "diffuse.R"}, "diffuse", Kind::rgb, {5, 4, 3, 0}},
      {{"Z", "beauty.B", "beauty.G", "beauty.R"}, "", Kind::rgb, {3, 2, 1, 0}},
      {{"L", "M", "R", "S"}, "", Kind::lmsr, {0, 1, 3, 2}},
      {{"lmsr.L", "lmsr.M", "lmsr.R", "lmsr.S"}, "", Kind::lmsr, {0, 1, 3, 2}},
      {{"Y"}, "", Kind::grey, {0, 0, 0, 0}},
      {{"BY", "RY", "Y"}, "", Kind::none, {}},
      {{"Z"}, "", Kind::none, {}},
      {{"R", "G"}, "", Kind::none, {}},
      {{"B", "G", "R"}, "nothing", Kind::none, {}},
  };
  for (const Row& row : rows) {
    const ColourChannels found = find_colour(picture_of(row.channels), row.layer, "file");
    EXPECT_EQ(found.kind, row.kind) << row.channels[0] << " " << row.layer;
    for (std::size_t i = 0; i < found.count(); ++i)
      EXPECT_EQ(found.index[i], row.index[i]) << row.channels[0];
  }
}

TEST(FindColour, several_layers_must_be_chosen_from) {
  const Subimage two = picture_of({"key.B", "key.G", "key.R", "rim.B", "rim.G", "rim.R"});
  try {
    find_colour(two, "", "file.exr");
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_NE(std::string(e.what()).find("key, rim"), std::string::npos) << e.what();
  }
}

TEST(Bands, rows_of_a_band_are_whole_chunks_and_do_not_depend_on_the_height) {
  for (const int chunk : {1, 16, 32, 256, 61}) {
    Subimage low = picture_of({"R", "G", "B"});
    low.chunk_rows = chunk;
    low.data = {0, 0, 4096, 100000};
    Subimage high = low;
    high.data.y1 = 1000000;
    EXPECT_EQ(band_rows(low), band_rows(high));
    EXPECT_EQ(band_rows(low) % chunk, 0);
    EXPECT_LE(static_cast<std::size_t>(band_rows(low) - chunk) * row_bytes(low), std::size_t{8} << 20);
  }
}

}  // namespace
}  // namespace scotopic
