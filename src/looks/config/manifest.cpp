#include "looks/config/manifest.h"

#include <filesystem>
#include <set>
#include <sstream>

#include "base/digest.h"
#include "looks/verify/inspect.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t hash_digits = 64;

/// The name on a line of hash and name; empty on others.
std::string name_on(const std::string& line) {
  return line.find("  ") == hash_digits && line[0] != '#' ? line.substr(hash_digits + 2) : "";
}

std::set<std::string> names_in(const std::string& manifest) {
  std::set<std::string> names;
  std::istringstream lines(manifest);
  for (std::string line; std::getline(lines, line);) names.insert(name_on(line));
  return names;
}

}  // namespace

bool is_manifest(const std::string& text) { return text.rfind("# Made by scotopic ", 0) == 0; }

std::string merged_manifest(const std::string& older, const std::string& fresh) {
  const std::set<std::string> replaced = names_in(fresh);
  std::string out, comments;
  std::istringstream lines(older);
  for (std::string line; std::getline(lines, line);) {
    // The comments before a file are about it.
    if (!line.empty() && line[0] == '#') {
      const bool of_all = is_manifest(line) || line.rfind("# Check with", 0) == 0;
      (of_all ? out : comments) += line + "\n";
      continue;
    }
    if (!replaced.count(name_on(line))) out += comments + line + "\n";
    comments.clear();
  }
  return out + fresh;
}

std::vector<std::string> manifest_problems(const std::string& folder) {
  std::vector<std::string> problems;
  std::set<std::string> listed = {"MANIFEST"};
  std::istringstream lines(text_of(folder + "/MANIFEST"));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::string name = name_on(line);
    if (name.empty()) {
      problems.push_back("MANIFEST has a line that names no hash and file");
      continue;
    }
    listed.insert(name);
    if (!fs::exists(fs::path(folder) / name))
      problems.push_back(name + " is missing");
    else if (sha256(text_of(folder + "/" + name)) != line.substr(0, hash_digits))
      problems.push_back(name + " is not the file that MANIFEST lists");
  }
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && !listed.count(entry.path().filename().string()))
      problems.push_back(entry.path().filename().string() + " is not in MANIFEST");
  return problems;
}

}  // namespace scotopic
