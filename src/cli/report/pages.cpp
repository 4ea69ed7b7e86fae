// scotopic_pages DIR: man pages and shell completions, written at build time from the program's own options.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "cli/report/option_table.h"
#include "cli/verbs/verbs.h"

namespace {

bool write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) std::fprintf(stderr, "scotopic_pages: %s cannot be written\n", file.c_str());
  return static_cast<bool>(out);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace scotopic;
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const std::vector<VerbRow> table = option_table(verbs());
  bool good = write(folder / "scotopic.1", man_page(table));
  for (const VerbRow& verb : table) good = write(folder / ("scotopic-" + verb.name + ".1"), man_page(verb)) && good;
  good = write(folder / "scotopic.bash", bash_completion(table)) && good;
  good = write(folder / "_scotopic", zsh_completion(table)) && good;
  good = write(folder / "scotopic.fish", fish_completion(table)) && good;
  return good ? 0 : 5;
}
