// The order of the rooms: which folder of src/ may include which. Read from the #include lines themselves.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

const fs::path source = fs::path(SCOTOPIC_SOURCE_DIR) / "src";

// kernel <- receptors, adaptation <- appearance <- acuity, scene <- display <- image <- bake <- cli
const std::map<std::string, std::set<std::string>> allowed = {
    {"kernel", {}},
    {"receptors", {"kernel"}},
    {"adaptation", {"kernel", "receptors"}},
    {"appearance", {"kernel", "receptors", "adaptation"}},
    {"acuity", {"kernel", "receptors", "adaptation", "appearance"}},
    {"scene", {"kernel", "receptors", "adaptation", "appearance", "acuity"}},
    {"display", {"kernel", "receptors", "adaptation", "appearance", "acuity", "scene"}},
    {"image", {"kernel", "receptors", "adaptation", "appearance", "acuity", "scene", "display"}},
    {"bake", {"kernel", "receptors", "adaptation", "appearance", "acuity", "scene", "display", "image"}},
    {"cli", {"kernel", "receptors", "adaptation", "appearance", "acuity", "scene", "display", "image", "bake"}},
};

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

TEST(House, includes_run_one_way_between_rooms) {
  int crossings = 0;
  const int files = for_each_source(source, [&](const fs::path& file) {
    const std::string room = fs::relative(file, source).begin()->string();
    ASSERT_TRUE(allowed.count(room)) << file << " stands in no known room";
    for (const std::string& name : includes(file)) {
      ASSERT_TRUE(fs::exists(source / name)) << file << " includes \"" << name << "\", which is not in src/";
      const std::string other = fs::path(name).begin()->string();
      if (other == room) continue;
      EXPECT_TRUE(allowed.at(room).count(other)) << file << ": " << room << " may not include " << name;
      ++crossings;
    }
  });
  EXPECT_GT(files, 20);
  EXPECT_GT(crossings, 20);
}

TEST(House, the_core_knows_neither_files_nor_ocio) {
  const std::set<std::string> core = {"kernel", "receptors", "adaptation", "appearance", "acuity", "scene",
                                      "display"};
  for_each_source(source, [&](const fs::path& file) {
    if (!core.count(fs::relative(file, source).begin()->string())) return;
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);)
      for (const char* library : {"<OpenColorIO", "<OpenImageIO", "<OpenEXR", "<Imath", "<fstream>", "<filesystem>"})
        EXPECT_TRUE(line.rfind("#include", 0) != 0 || line.find(library) == std::string::npos) << file << ": " << line;
  });
}

TEST(House, tests_include_no_cpp_file) {
  for_each_source(fs::path(SCOTOPIC_SOURCE_DIR) / "tests", [&](const fs::path& file) {
    for (const std::string& name : includes(file)) EXPECT_NE(fs::path(name).extension(), ".cpp") << file;
  });
}

}  // namespace
