#include "cli/console.h"

#include <fmt/format.h>

#include <cstdio>

namespace scotopic {
namespace {

std::string one_line_json(const nlohmann::ordered_json& object) {
  // File names need not be UTF-8; JSON must be.
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void say(std::FILE* stream, const std::string& line) { std::fputs((line + "\n").c_str(), stream); }

}  // namespace

void add_common_options(CLI::App& verb, CommonOptions& options) {
  verb.add_flag("-v,--verbose", options.verbose, "Say what was found and chosen");
  verb.add_flag("-q,--quiet", options.quiet, "Say nothing but errors")->excludes("--verbose");
  verb.add_flag("--json", options.json, "Result on stdout, errors on stderr, as one JSON object");
  verb.add_option("--threads", options.threads, "Threads; 0: one for each processor (default)")
      ->check(CLI::Range(0, 1024));
}

std::string printable(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f)
      out += c == '\n' ? "\\n" : fmt::format("\\x{:02x}", byte);
    else
      out += c;
  }
  return out;
}

void Console::note(const std::string& line) const {
  if (!options_.quiet) say(stderr, "scotopic: " + printable(line));
}

void Console::detail(const std::string& line) const {
  if (options_.verbose) say(stderr, "scotopic: " + printable(line));
}

void Console::result(const nlohmann::ordered_json& object) const {
  if (options_.json) say(stdout, one_line_json(object));
}

int report(const Error& error, bool json) {
  const int code = static_cast<int>(error.code());
  if (json) {
    nlohmann::ordered_json object;
    object["error"] = {{"code", code}, {"file", error.file()}, {"message", error.what()}};
    say(stderr, one_line_json(object));
  } else {
    const std::string file = error.file().empty() ? "" : printable(error.file()) + ": ";
    say(stderr, "scotopic: " + file + printable(error.what()) + " (nothing written)");
  }
  return code;
}

}  // namespace scotopic
