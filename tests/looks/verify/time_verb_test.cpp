// `scotopic time` and the demands of `scotopic apply`, from the command line.
#include <gtest/gtest.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code;
  std::string out;
};

Outcome run(const std::string& arguments) {
  const std::string command = std::string(SCOTOPIC_PROGRAM) + " " + arguments;
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::string out;
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
  return {WEXITSTATUS(pclose(pipe)), out};
}

TEST(TimeVerb, every_evaluator_has_its_row_with_time_and_error) {
  const Outcome outcome = run("time --pixels 65536 --rounds 1 --json");
  ASSERT_EQ(outcome.code, 0);
  const auto result = nlohmann::json::parse(outcome.out);
  std::set<std::string> names;
  for (const auto& kind : result["evaluators"]) {
    names.insert(kind["evaluator"]);
    EXPECT_GT(kind["nanosecondsPerPixel"], 0) << kind["evaluator"];
    if (kind["evaluator"] != "memcpy") {
      EXPECT_TRUE(kind["error"]["deltaE00"].contains("p99")) << kind["evaluator"];
    }
    if (kind["evaluator"] == "float" && kind["group"] == "operator") {
      EXPECT_LE(kind["error"]["relativePixel"]["max"], 5e-7);
      EXPECT_FALSE(kind["error"]["worst"].empty());
    }
    if (kind["evaluator"] == "lut65") {
      EXPECT_GT(kind["bytes"], 3 * 65 * 65 * 65 * 4);
      EXPECT_GT(kind["bakeSeconds"], 0);
    }
  }
  for (const char* name : {"memcpy", "double, scalar", "double", "float", "lut129", "lut65", "lut33", "lut17",
                           "float, RGBA float", "1 nm bins", "5 nm points", "10 nm bins", "window",
                           "cells, fine", "cells, draft"})
    EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_GE(result["pixels"], 65536);
}

TEST(TimeVerb, colours_that_luts_clamp_are_told) {
  // A grey, and the blue of AP0, which AP1 does not hold.
  const fs::path file = fs::temp_directory_path() / fmt::format("scotopic-time-{}.hdr", getpid());
  {
    std::ofstream out(file, std::ios::binary);
    out << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"
           "PRIMARIES= 0.7347 0.2653 0 1 0.0001 -0.077 0.32168 0.33767\n\n-Y 1 +X 2\n";
    const unsigned char pixels[] = {64, 64, 64, 128, 1, 1, 120, 128};
    out.write(reinterpret_cast<const char*>(pixels), sizeof pixels);
  }
  const Outcome outcome =
      run("time " + file.string() + " --adaptation 0.1 --pixels 65536 --rounds 1 --json 2>/dev/null");
  fs::remove(file);
  ASSERT_EQ(outcome.code, 0);
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["outsideAp1"], 1);
}

TEST(TimeVerb, csv_has_as_many_fields_in_every_row) {
  const Outcome outcome = run("time --pixels 65536 --rounds 1 --csv");
  ASSERT_EQ(outcome.code, 0);
  std::istringstream lines(outcome.out);
  int rows = 0;
  for (std::string line; std::getline(lines, line); ++rows) {
    bool quoted = false;
    int fields = 1;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) ++fields;
    }
    EXPECT_EQ(fields, 19) << line;
  }
  EXPECT_GT(rows, 20);
}

TEST(TimeVerb, values_that_are_no_demand_are_refused_before_any_file_is_opened) {
  for (const char* arguments :
       {"apply none.exr -o out.exr --max-error x", "apply none.exr -o out.exr --max-error -1",
        "apply none.exr -o out.exr --budget nan", "apply none.exr -o out.exr --precision lut34",
        "apply none.exr -o out.exr --precision float --budget 5", "time --rounds 0", "time --pixels 10"})
    EXPECT_EQ(run(std::string(arguments) + " 2>/dev/null").code, 2) << arguments;
  EXPECT_FALSE(fs::exists("out.exr"));
}

}  // namespace
