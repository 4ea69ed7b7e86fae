#include "cli/process.h"

#include <fcntl.h>
#include <unistd.h>

#include <clocale>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "io/atomic/output_file.h"

namespace scotopic {
namespace {

bool ends_in_json = false, started = false;

void write_all(const char* text) { (void)!write(STDERR_FILENO, text, std::strlen(text)); }

/// Here there may be no memory left: no strings.
void say_end(ExitCode code, const char* number, const char* what) {
  write_all(ends_in_json ? "{\"error\":{\"code\":" : "scotopic: ");
  if (ends_in_json) write_all(number);
  if (ends_in_json) write_all(",\"file\":\"\",\"message\":\"");
  write_all(what);
  write_all(ends_in_json            ? "\"}}\n"
            : files_in_place() == 0 ? " (nothing written)\n"
                                    : " (files had been written)\n");
  _exit(static_cast<int>(code));
}

void end_without_unwinding() {
  remove_unfinished_files();
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    say_end(ExitCode::limit, "4", "out of memory");
  } catch (...) {
  }
  say_end(ExitCode::internal, "70", "internal error: an exception that nobody caught");
}

// abort() and exit() of C libraries, and GLib's trap: mostly for want of memory while they are loaded.
void end_by_library() {
  remove_unfinished_files();
  say_end(ExitCode::internal, "70", "internal error: a library ended the program");
}
extern "C" void end_on_abort(int) { end_by_library(); }
extern "C" void end_on_exit() {
  if (started) end_by_library();
}

/// A standard stream that is closed would give its number to the next file opened. Reading in place of
/// writing, so that what is written there still fails.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) (void)!open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// Whether a library would load code, change results or print between our lines for this variable. Whole
/// families: what is in them changes from one release of a library to the next.
bool steers_a_library(std::string_view name) {
  for (const std::string_view family :
       {"CUE_", "EXPAT_", "GOMP_", "OIIO_", "OMP_", "OPENCV_", "OPENIMAGEIO_"})
    if (name.starts_with(family)) return true;
  return name == "OCIO_LOGGING_LEVEL" || name == "OCIO_OPTIMIZATION_FLAGS";
}

void ignore_environment() {
  std::vector<std::string> names;
  for (char** entry = environ; entry && *entry; ++entry) {
    const std::string_view name = std::string_view(*entry).substr(0, std::string_view(*entry).find('='));
    if (steers_a_library(name)) names.emplace_back(name);
  }
  for (const std::string& name : names) unsetenv(name.c_str());
}

}  // namespace

Process::Process(bool json) {
  ends_in_json = json;
  started = true;
  static const int registered = std::atexit(end_on_exit);
  (void)registered;
  open_standard_streams();
  std::setlocale(LC_ALL, "C");
  ignore_environment();
  std::set_terminate(end_without_unwinding);
  for (const int s : {SIGABRT, SIGTRAP}) std::signal(s, end_on_abort);
  remove_unfinished_files_on_signals();
}

Process::~Process() { started = false; }

}  // namespace scotopic
