#include "io/atomic/unfinished_files.h"

#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <cstring>
#include <ctime>

namespace scotopic {
namespace {

constexpr std::array<int, 5> ending_signals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ};

/// Slots are claimed and released by the threads that write; a signal handler reads them.
struct Unfinished {
  std::atomic<bool> claimed{false};
  std::atomic<bool> valid{false};
  char name[PATH_MAX] = {};
};
std::array<Unfinished, 256> unfinished;

// A signal comes to any thread; these two let it wait for the one that must not be ended now.
std::atomic<int> holders{0};
std::atomic<bool> ending{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void wait_a_moment() {
  const timespec moment = {0, 200'000};
  nanosleep(&moment, nullptr);
}

// Only what POSIX allows in a handler: lock-free loads, unlink, rmdir, nanosleep, _exit.
extern "C" void end_on_signal(int signal_number) {
  ending = true;
  while (holders.load() > 0) wait_a_moment();
  remove_unfinished_files();
  _exit(128 + signal_number);
}

}  // namespace

SignalsHeld::SignalsHeld() {
  sigset_t held;
  sigemptyset(&held);
  for (const int s : ending_signals) sigaddset(&held, s);
  pthread_sigmask(SIG_BLOCK, &held, &before_);
  ++holders;
  // Of the two, the handler and this thread, at least one sees the other. Too late: the program ends.
  if (ending) {
    --holders;
    while (true) wait_a_moment();
  }
}

SignalsHeld::~SignalsHeld() {
  --holders;
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

UnfinishedName::UnfinishedName(const std::string& name) noexcept {
  if (name.size() >= PATH_MAX) return;
  for (std::size_t i = 0; i < unfinished.size(); ++i) {
    if (unfinished[i].claimed.exchange(true)) continue;
    std::memcpy(unfinished[i].name, name.c_str(), name.size() + 1);
    unfinished[i].valid = true;
    slot_ = static_cast<int>(i);
    return;
  }
}

UnfinishedName::~UnfinishedName() {
  if (slot_ < 0) return;
  unfinished[static_cast<std::size_t>(slot_)].valid = false;
  unfinished[static_cast<std::size_t>(slot_)].claimed = false;
}

void remove_unfinished_files() noexcept {
  // The last first: folders were made before what they hold.
  for (auto file = unfinished.rbegin(); file != unfinished.rend(); ++file)
    if (file->valid.load() && unlink(file->name) != 0) rmdir(file->name);
}

void remove_unfinished_files_on_signals() {
  struct sigaction action = {};
  action.sa_handler = end_on_signal;
  sigfillset(&action.sa_mask);
  for (const int s : ending_signals) {
    struct sigaction before = {};
    // nohup and shells' background jobs ignore some signals: let them.
    if (sigaction(s, nullptr, &before) == 0 && before.sa_handler == SIG_IGN && s != SIGPIPE) continue;
    sigaction(s, &action, nullptr);
  }
}

}  // namespace scotopic
