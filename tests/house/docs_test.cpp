// The documentation holds together: no link leads nowhere, no page is left out of the index.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/file_bytes.h"

namespace {

namespace fs = std::filesystem;
using scotopic::test::bytes_of;

const fs::path root = SCOTOPIC_SOURCE_DIR;

std::vector<fs::path> pages() {
  std::vector<fs::path> out = {root / "README.md", root / "CHANGELOG.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") out.push_back(entry.path());
  return out;
}

// What [text](target) and ![text](target) lead to, but for the web.
std::vector<std::string> links(const fs::path& page) {
  static const std::regex link(R"(\]\(([^)\s#]+)(#[^)\s]*)?\))");
  const std::string text = bytes_of(page);
  std::vector<std::string> out;
  for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i)
    if (const std::string target = (*i)[1]; target.find("://") == std::string::npos) out.push_back(target);
  return out;
}

TEST(Docs, links_lead_to_files_that_exist) {
  std::size_t count = 0;
  for (const fs::path& page : pages())
    for (const std::string& target : links(page)) {
      EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << " links " << target;
      ++count;
    }
  EXPECT_GT(count, 30u);
}

TEST(Docs, the_index_names_every_page) {
  std::set<std::string> named;
  for (const std::string& target : links(root / "docs/README.md")) named.insert(target);
  for (const fs::path& page : pages()) {
    if (page.parent_path() != root / "docs" || page.filename() == "README.md") continue;
    EXPECT_TRUE(named.count(page.filename())) << page << " is not in docs/README.md";
  }
}

TEST(Docs, every_picture_is_shown_on_a_page) {
  std::set<fs::path> shown;
  for (const fs::path& page : pages())
    for (const std::string& target : links(page))
      shown.insert(fs::weakly_canonical(page.parent_path() / target));
  for (const char* folder : {"docs/images", "docs/figures", "docs/gallery"})
    for (const auto& entry : fs::directory_iterator(root / folder)) {
      if (entry.path().extension() == ".csv") continue;
      EXPECT_TRUE(shown.count(fs::weakly_canonical(entry.path()))) << entry.path() << " is on no page";
    }
}

TEST(Docs, the_changelog_begins_with_the_version_of_the_project) {
  static const std::regex project(R"(project\(Scotopic VERSION ([0-9.]+))");
  static const std::regex newest(R"(\n## ([0-9.]+))");
  const std::string cmake = bytes_of(root / "CMakeLists.txt"), changelog = bytes_of(root / "CHANGELOG.md");
  std::smatch version, change;
  ASSERT_TRUE(std::regex_search(cmake, version, project));
  ASSERT_TRUE(std::regex_search(changelog, change, newest));
  EXPECT_EQ(version[1], change[1]);
}

}  // namespace
