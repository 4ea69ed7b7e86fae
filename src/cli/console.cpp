#include "cli/console.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "image/output_file.h"

namespace scotopic {
namespace {

std::string one_line_json(const nlohmann::ordered_json& object) {
  // File names need not be UTF-8; JSON must be.
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Bytes of the character that the text begins with; 0 where it is a control character or no UTF-8.
std::size_t printable_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  // U+0080 to U+009F are controls, too; longer forms than needed and surrogates are no UTF-8.
  const unsigned second = byte(1);
  const bool no = (byte(0) == 0xc2 && second < 0xa0) || (byte(0) == 0xe0 && second < 0xa0) ||
                  (byte(0) == 0xed && second > 0x9f) || (byte(0) == 0xf0 && second < 0x90) ||
                  (byte(0) == 0xf4 && second > 0x8f);
  return no ? 0 : length;
}

/// What stands on the disk that was not there before.
std::string written_text(int files) {
  if (files == 0) return "nothing written";
  return files == 1 ? "1 file had been written" : fmt::format("{} files had been written", files);
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
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = printable_length(std::string_view(text).substr(i));
    if (length > 0)
      out += text.substr(i, length);
    else
      out += text[i] == '\n' ? "\\n" : fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
    i += std::max<std::size_t>(length, 1);
  }
  return out;
}

void Console::line(const std::string& text) const {
  if (options_.json)
    say(stderr, one_line_json({{"note", text}}));
  else
    say(stderr, "scotopic: " + printable(text));
}

void Console::note(const std::string& text) const {
  if (!options_.quiet) line(text);
}

void Console::detail(const std::string& text) const {
  if (options_.verbose) line(text);
}

void Console::result(const nlohmann::ordered_json& object) const {
  if (options_.json) say(stdout, one_line_json(object));
}

int report(const Error& error, bool json) {
  const int code = static_cast<int>(error.code());
  if (json) {
    nlohmann::ordered_json object;
    object["error"] = {{"code", code},
                       {"file", error.file()},
                       {"message", error.what()},
                       {"filesWritten", files_in_place()}};
    say(stderr, one_line_json(object));
  } else {
    const std::string file = error.file().empty() ? "" : printable(error.file()) + ": ";
    say(stderr,
        "scotopic: " + file + printable(error.what()) + " (" + written_text(files_in_place()) + ")");
  }
  return code;
}

}  // namespace scotopic
