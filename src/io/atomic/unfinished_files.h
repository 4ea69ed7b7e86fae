// What a program that is told to end must not leave behind, and when it must not be ended.
#pragma once

#include <csignal>
#include <string>

namespace scotopic {

/// While it lives, no ending signal takes effect, whichever thread it comes to: between giving a file its
/// name and putting it in place. Not to be nested.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_;
};

/// A file, or an empty folder, that ending signals remove while this lives. Where more than a few hundred are
/// registered, or the name is too long for the system, the rest is not.
class UnfinishedName {
 public:
  /// From now on.
  explicit UnfinishedName(const std::string& name) noexcept;
  ~UnfinishedName();
  UnfinishedName(const UnfinishedName&) = delete;
  UnfinishedName& operator=(const UnfinishedName&) = delete;

 private:
  int slot_ = -1;
};

/// From now on SIGINT, SIGTERM, SIGHUP, SIGPIPE and SIGXFSZ remove unfinished files and end the program with
/// 128 + their number.
void remove_unfinished_files_on_signals();

/// The same removal, for a program that ends in another way than by returning from main.
void remove_unfinished_files() noexcept;

}  // namespace scotopic
