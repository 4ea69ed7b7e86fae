// The order of the rooms: which folder of src/ may include which. Read from the #include lines themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/file_bytes.h"

namespace {

namespace fs = std::filesystem;
using scotopic::test::bytes_of;

const fs::path source = fs::path(SCOTOPIC_SOURCE_DIR) / "src";

// From the ground up; a room may include itself and those before it.
const std::vector<std::string> rooms = {
    "kernel",   "receptors", "adaptation", "stages",  "batch",  "scene", "base", "scotopic", "color", "io",
    "pipeline", "shaders",   "looks",      "options", "report", "bake",  "host", "python",   "ofx",   "cli"};

std::ptrdiff_t floor_of(const fs::path& file_in_source) {
  return std::find(rooms.begin(), rooms.end(), file_in_source.begin()->string()) - rooms.begin();
}

// The files named in `#include "..."` lines.
std::vector<std::string> includes(const fs::path& file) {
  std::vector<std::string> names;
  std::ifstream text(file);
  for (std::string line; std::getline(text, line);) {
    const std::string directive = "#include \"";
    if (line.rfind(directive, 0) != 0) continue;
    names.push_back(line.substr(directive.size(), line.find('"', directive.size()) - directive.size()));
  }
  return names;
}

template <typename Visit>
int for_each_source(const fs::path& root, Visit visit) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    visit(entry.path());
    ++files;
  }
  return files;
}

TEST(House, includes_run_upwards_only) {
  int crossings = 0;
  const int files = for_each_source(source, [&](const fs::path& file) {
    const std::ptrdiff_t room = floor_of(fs::relative(file, source));
    ASSERT_LT(room, std::ssize(rooms)) << file << " stands in no known room";
    for (const std::string& name : includes(file)) {
      ASSERT_TRUE(fs::exists(source / name)) << file << " includes \"" << name << "\", which is not in src/";
      EXPECT_LE(floor_of(name), room) << file << " may not include " << name;
      crossings += floor_of(name) < room;
    }
  });
  EXPECT_GT(files, 20);
  EXPECT_GT(crossings, 20);
}

TEST(House, no_folder_of_src_has_more_than_15_files) {
  std::map<fs::path, int> count;
  for_each_source(source, [&](const fs::path& file) { ++count[file.parent_path()]; });
  for (const auto& [folder, files] : count) EXPECT_LE(files, 15) << folder;
}

TEST(House, lines_of_src_have_110_columns_at_most) {
  for_each_source(source, [](const fs::path& file) {
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);) {
      const auto columns = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
      EXPECT_LE(columns, 110) << file << ": " << line;
    }
  });
}

TEST(House, the_core_knows_neither_files_nor_ocio) {
  const std::set<std::string> core(rooms.begin(), rooms.begin() + floor_of("base"));
  for_each_source(source, [&](const fs::path& file) {
    if (!core.count(fs::relative(file, source).begin()->string())) return;
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);)
      for (const char* library :
           {"<OpenColorIO", "<OpenImageIO", "<OpenEXR", "<Imath", "<fstream>", "<filesystem>"})
        EXPECT_TRUE(line.rfind("#include", 0) != 0 || line.find(library) == std::string::npos)
            << file << ": " << line;
  });
}

TEST(House, a_file_that_calls_an_algorithm_includes_it) {
  // Other headers bring <algorithm> in some standard libraries, not in the next: GCC 14's leave it out.
  const std::regex call(
      R"(\bstd::(all_of|any_of|clamp|copy|count|count_if|equal|fill|find|find_if|lower_bound|max|)"
      R"(max_element|min|min_element|minmax|none_of|nth_element|replace|reverse|sort|stable_sort|)"
      R"(transform|unique|upper_bound)\()");
  int callers = 0;
  for (const fs::path& root : {source, fs::path(SCOTOPIC_SOURCE_DIR) / "tests"})
    for_each_source(root, [&](const fs::path& file) {
      const std::string text = bytes_of(file);
      if (!std::regex_search(text, call)) return;
      ++callers;
      EXPECT_NE(text.find("#include <algorithm>"), std::string::npos) << file;
    });
  EXPECT_GT(callers, 50);
}

TEST(House, the_program_asks_for_the_variables_that_are_listed) {
  const std::string promises = bytes_of(fs::path(SCOTOPIC_SOURCE_DIR) / "SECURITY.md");
  const std::regex call(R"(\bgetenv\(([^)]*)\))");
  int asked = 0;
  for_each_source(source, [&](const fs::path& file) {
    const std::string text = bytes_of(file);
    for (std::sregex_iterator found(text.begin(), text.end(), call), end; found != end; ++found, ++asked) {
      const std::string name = (*found)[1];
      ASSERT_EQ(name.front(), '"') << file << " asks for a variable whose name is not written there";
      EXPECT_NE(promises.find("`" + name.substr(1, name.size() - 2) + "`"), std::string::npos)
          << file << ": " << name;
    }
  });
  EXPECT_GT(asked, 0);
}

TEST(House, tests_include_no_cpp_file) {
  for_each_source(fs::path(SCOTOPIC_SOURCE_DIR) / "tests", [&](const fs::path& file) {
    for (const std::string& name : includes(file)) EXPECT_NE(fs::path(name).extension(), ".cpp") << file;
  });
}

}  // namespace
