// Man pages and completions against the program's own help.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "cli/run_program.h"

namespace scotopic {
namespace {

std::string file(const std::string& path) {
  std::ostringstream out;
  out << std::ifstream(path).rdbuf();
  return out.str();
}
std::string page(const std::string& name) { return std::string(SCOTOPIC_MAN_PAGES) + "/" + name + ".1"; }

/// What a command of a shell prints; empty and `code` 127 where there is no such shell.
std::string shell(const std::string& command, int* code = nullptr) {
  std::string text;
  std::FILE* const pipe = popen(command.c_str(), "r");
  char block[4096];
  while (const std::size_t n = std::fread(block, 1, sizeof block, pipe)) text.append(block, n);
  const int status = pclose(pipe);
  if (code) *code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return text;
}

std::set<std::string> long_options(const std::string& text) {
  std::set<std::string> names;
  const std::regex option("--[a-z][-a-z]+");
  for (std::sregex_iterator it(text.begin(), text.end(), option), end; it != end; ++it)
    names.insert(it->str());
  return names;
}

/// Options that the help of a verb lists: the first word of a line, after a short name.
std::set<std::string> listed_options(const std::string& help) {
  std::set<std::string> names;
  const std::regex option("\n  (?:-[a-zA-Z],)?(--[a-z][-a-z]+)");
  for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it)
    names.insert((*it)[1]);
  return names;
}

std::vector<std::string> verbs() {
  const std::string help = test::run_program({"--help"}).out;
  std::vector<std::string> names;
  const std::regex verb("\n  ([a-z]+) {2,}");
  const std::string list = help.substr(help.find("Subcommands:"));
  for (std::sregex_iterator it(list.begin(), list.end(), verb), end; it != end; ++it)
    names.push_back((*it)[1]);
  return names;
}

/// Words that bash would offer after "scotopic WORDS...", the last of which is being typed.
std::set<std::string> offered(const std::string& words) {
  const std::string script =
      "source " SCOTOPIC_SOURCE_DIR
      "/scripts/completion/scotopic.bash; compopt() { :; }; COMP_WORDS=(" SCOTOPIC_PROGRAM " " +
      words + "); COMP_CWORD=$((${#COMP_WORDS[@]}-1)); _scotopic_words; printf \"%s\\n\" \"${COMPREPLY[@]}\"";
  std::istringstream lines(shell("bash --norc -c '" + script + "'"));
  std::set<std::string> out;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) out.insert(line);
  return out;
}

TEST(Pages, every_verb_has_a_man_page_with_every_option_of_its_help) {
  const std::vector<std::string> all = verbs();
  ASSERT_GE(all.size(), 6u);
  for (const std::string& verb : all) {
    std::string page_text = file(page("scotopic-" + verb));
    ASSERT_FALSE(page_text.empty()) << verb;
    page_text = std::regex_replace(page_text, std::regex("\\\\-"), "-");
    const std::set<std::string> in_page = long_options(page_text);
    const std::set<std::string> listed = listed_options(test::run_program({verb, "--help"}).out);
    EXPECT_GE(listed.size(), 5u) << verb;
    for (const std::string& option : listed) EXPECT_TRUE(in_page.count(option)) << verb << " " << option;
    EXPECT_NE(file(page("scotopic")).find("\n" + verb + "\n"), std::string::npos) << verb;
    EXPECT_NE(page_text.find(".SH NAME\nscotopic-" + verb + " "), std::string::npos) << verb;
  }
}

TEST(Pages, are_in_good_roff) {
  int code = 0;
  shell("command -v man groff >/dev/null", &code);
  if (code != 0) GTEST_SKIP() << "man and groff are not installed";
  for (const std::string& verb : verbs()) {
    const std::string warnings =
        shell("LC_ALL=C MANWIDTH=100 man --warnings -l " + page("scotopic-" + verb) + " 2>&1 >/dev/null");
    EXPECT_EQ(warnings, "") << verb;
    const std::string text =
        shell("LC_ALL=C MANWIDTH=100 man -l " + page("scotopic-" + verb) + " 2>/dev/null | cat");
    EXPECT_NE(text.find("EXIT STATUS"), std::string::npos) << verb;
  }
}

TEST(Completion, bash_offers_the_verbs_and_every_option_of_a_verbs_help) {
  std::set<std::string> first = offered("\"\"");
  for (const std::string& verb : verbs()) {
    EXPECT_TRUE(first.count(verb)) << verb;
    const std::set<std::string> options = offered(verb + " --");
    for (const std::string& option : listed_options(test::run_program({verb, "--help"}).out))
      EXPECT_TRUE(options.count(option)) << verb << " " << option;
  }
  EXPECT_EQ(offered("ap"), std::set<std::string>{"apply"});
  EXPECT_EQ(offered("apply --skip"), std::set<std::string>{"--skip-existing"});
}

TEST(Completion, bash_offers_the_values_that_the_program_takes) {
  EXPECT_EQ(offered("apply --model \"\""),
            (std::set<std::string>{"cao2008", "filament2021", "kirk2011", "safko2019"}));
  EXPECT_EQ(offered("apply --weight gl"), std::set<std::string>{"global"});
  EXPECT_EQ(offered("lmsr --rods \"\""), (std::set<std::string>{"linear", "quadratic"}));
  EXPECT_TRUE(offered("apply -d \"\"").count("uint16"));
  // Each is taken: the program goes on to the input, which is not there.
  for (const char* option : {"--model", "--weight", "--luminance", "--gamut", "--rods", "--precision",
                             "--nonfinite", "-d", "--acuity-space"}) {
    const std::set<std::string> values = offered(std::string("apply ") + option + " \"\"");
    EXPECT_GE(values.size(), 2u) << option;
    for (const std::string& value : values) {
      const test::Outcome outcome = test::run_program(
          {"apply", "no/such/file", "-o", "/tmp/scotopic-none.tif", "--adaptation", "1", option, value});
      EXPECT_EQ(outcome.exit_code, 3) << option << " " << value << " " << outcome.err;
    }
  }
}

TEST(Completion, files_and_numbers_are_not_guessed) {
  EXPECT_TRUE(offered("apply --config \"\"").empty());  // left to the shell's own completion of names
  EXPECT_TRUE(offered("apply --exposure \"\"").empty());
  EXPECT_TRUE(offered("apply \"\"").empty());
}

TEST(Completion, other_shells_can_read_theirs) {
  int tried = 0;
  for (const auto& [name, script] :
       {std::pair<std::string, std::string>{"zsh", "_scotopic"}, {"fish", "scotopic.fish"}}) {
    int code = 0;
    shell("command -v " + name + " >/dev/null", &code);
    if (code != 0) continue;
    ++tried;
    EXPECT_EQ(shell(name + " -n " SCOTOPIC_SOURCE_DIR "/scripts/completion/" + script + " 2>&1", &code), "");
    EXPECT_EQ(code, 0) << name;
  }
  if (tried == 0) GTEST_SKIP() << "neither zsh nor fish is installed: their scripts were not run";
}

}  // namespace
}  // namespace scotopic
