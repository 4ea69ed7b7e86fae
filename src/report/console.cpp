#include "report/console.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <new>
#include <string_view>
#include <system_error>

#include "io/atomic/output_file.h"
#include "options/values.h"

namespace scotopic {
namespace {

std::string one_line_json(const nlohmann::ordered_json& object) {
  // File names need not be UTF-8; JSON must be.
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Bytes of the character that the text begins with; 0 where it is a control character or no UTF-8.
/// U+061C, U+200B to U+200F, U+2028 to U+202E, U+2060 to U+206F, U+FEFF: breaks of lines, marks that turn the
/// direction of writing, and what has no width. In a name they make it look like another.
bool steers_text(std::string_view c) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(c[i]); };
  if (c == "\u061c" || c == "\ufeff") return true;
  if (c.size() != 3 || byte(0) != 0xe2) return false;
  const unsigned low = byte(2);
  return (byte(1) == 0x80 && ((low >= 0x8b && low <= 0x8f) || (low >= 0xa8 && low <= 0xae))) ||
         (byte(1) == 0x81 && low >= 0xa0 && low <= 0xaf);
}

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
  return no || steers_text(text.substr(0, length)) ? 0 : length;
}

/// What stands on the disk that was not there before.
std::string written_text(int files) {
  if (files == 0) return "nothing written";
  return files == 1 ? "1 file had been written" : fmt::format("{} files had been written", files);
}

/// stderr by a descriptor of its own: while libpng is kept quiet, descriptor 2 leads nowhere.
class ErrorLines {
 public:
  ErrorLines() {
    const int own = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    if (own >= 0) stream_ = fdopen(own, "w");
    if (!stream_) stream_ = stderr;
    terminal = isatty(fileno(stream_)) == 1;
  }

  void say(const std::string& line) {
    const std::lock_guard guard(lock_);
    erase();
    put(line + "\n");
    draw();
  }
  void set_status(const std::string& line) {
    const std::lock_guard guard(lock_);
    erase();
    status_ = line;
    draw();
  }
  int columns() const {
    winsize size = {};
    return ioctl(fileno(stream_), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
  }

  bool terminal = false;

 private:
  void erase() {
    if (!status_.empty()) put("\r" + std::string(status_.size(), ' ') + "\r");
  }
  void draw() {
    if (!status_.empty()) put(status_);
  }
  void put(const std::string& text) {
    std::fputs(text.c_str(), stream_);
    std::fflush(stream_);
  }

  std::mutex lock_;
  std::FILE* stream_ = nullptr;
  std::string status_;
};

ErrorLines& errors() {
  // Never destroyed: threads may speak to the very end.
  static auto* const lines = new ErrorLines;
  return *lines;
}

}  // namespace

void add_common_options(CLI::App& verb, CommonOptions& options) {
  verb.add_flag("-v,--verbose", options.verbose, "Say what was found and chosen");
  verb.add_flag("-q,--quiet", options.quiet, "Say nothing but errors")->excludes("--verbose");
  verb.add_flag("--json", options.json, "Result on stdout, errors on stderr, as one JSON object");
  verb.add_option("--threads", options.threads, "Threads; 0: one for each processor (default)")
      ->check(whole_number(0, 1024));
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
  if (sink_)
    sink_(text);
  else if (options_.json)
    errors().say(one_line_json({{"note", text}}));
  else
    errors().say("scotopic: " + printable(text));
}

void Console::note(const std::string& text) const {
  if (!options_.quiet) line(text);
}

void Console::detail(const std::string& text) const {
  if (options_.verbose) line(text);
}

Notes Console::notes() const {
  return {[this](const std::string& text) { note(text); }, [this](const std::string& text) { detail(text); }};
}

void Console::result(const nlohmann::ordered_json& object) const {
  if (options_.json) std::fputs((one_line_json(object) + "\n").c_str(), stdout);
}

bool on_terminal() { return errors().terminal; }
int terminal_columns() { return errors().columns(); }
void show_status(const std::string& line) { errors().set_status(line); }

int report(const Error& error, bool json) {
  const int code = static_cast<int>(error.code());
  if (json) {
    nlohmann::ordered_json object;
    object["error"] = {{"code", code},
                       {"file", error.file()},
                       {"message", error.what()},
                       {"filesWritten", files_in_place()}};
    errors().say(one_line_json(object));
  } else {
    const std::string file = error.file().empty() ? "" : printable(error.file()) + ": ";
    errors().say("scotopic: " + file + printable(error.what()) + " (" + written_text(files_in_place()) + ")");
  }
  return code;
}

Error error_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return Error(ExitCode::limit, "", "out of memory");
  } catch (const std::system_error& error) {
    // What a thread needs and does not get.
    if (error.code() == std::errc::resource_unavailable_try_again ||
        error.code() == std::errc::not_enough_memory)
      return Error(ExitCode::limit, "", "out of memory or threads");
    return Error(ExitCode::internal, "", std::string("internal error: ") + error.what());
  } catch (const std::exception& error) {
    return Error(ExitCode::internal, "", std::string("internal error: ") + error.what());
  }
}

}  // namespace scotopic
