#include "faults/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace scotopic::test {
namespace {

Attempt run_of(const Subject& subject) {
  Attempt run;
  run.arguments = arguments_of(*subject.verb, subject.folder);
  run.folder = subject.folder;
  return run;
}

/// What only the next run can remove.
long take_temporaries(Files& files) {
  return static_cast<long>(std::erase_if(files, [](const auto& file) {
    const std::size_t slash = file.first.rfind('/');
    const std::string name = slash == std::string::npos ? file.first : file.first.substr(slash + 1);
    return name.rfind(".scotopic-", 0) == 0;
  }));
}

long take_empty_folders(Files& files, const Files& before) {
  std::vector<std::string> empty;
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    const auto holds = [&](const auto& other) { return other.first.rfind(file->first + "/", 0) == 0; };
    const auto here = std::count_if(files.begin(), files.end(), holds);
    const auto gone = std::count_if(empty.begin(), empty.end(),
                                    [&](const std::string& e) { return e.rfind(file->first + "/", 0) == 0; });
    if (file->second == "/" && !before.count(file->first) && here == gone) empty.push_back(file->first);
  }
  for (const std::string& name : empty) files.erase(name);
  return static_cast<long>(empty.size());
}

}  // namespace

Subject subject_of(const WritingVerb& verb) {
  Subject out;
  out.verb = &verb;
  std::string name = verb.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  out.folder = work_folder(name);
  out.reset();
  out.before = files_in(out.folder);
  Attempt clean = run_of(out);
  clean.call = "event", clean.action = "5", clean.at = 0;
  const Ended ended = run(clean);
  out.calls = ended.calls;
  out.after = files_in(out.folder);
  EXPECT_EQ(ended.exit_code, 0) << verb.name << ": " << ended.err;
  EXPECT_NE(out.before, out.after) << verb.name;
  EXPECT_FALSE(out.calls.empty()) << verb.name << ": the shim did not count";
  return out;
}

void sweep(const Subject& subject, const Fault& fault, long most, Seen& seen) {
  const auto found = subject.calls.find(fault.call);
  const long calls = found == subject.calls.end() ? 0 : found->second;
  const long tries = std::min(calls, most);
  for (long i = 0; i < tries; ++i) {
    Attempt run_with = run_of(subject);
    run_with.call = fault.call, run_with.action = fault.action, run_with.sticky = fault.sticky;
    run_with.at = tries == calls ? i + 1 : 1 + i * (calls - 1) / std::max(1l, tries - 1);
    const std::string where = fault.name + ", " + subject.verb->name + ", " + fault.call + " " +
                              std::to_string(run_with.at) + " of " + std::to_string(calls);
    subject.reset();
    const Ended ended = run(run_with);
    ++seen.tries;
    ++seen.codes[ended.exit_code];
    Files now = files_in(subject.folder);
    if (fault.uncatchable) {
      seen.temporaries += take_temporaries(now);
      take_empty_folders(now, subject.before);
    }
    std::string wrong = broken_promise(now, subject.before, subject.after, ended);
    const bool forgiven = (fault.uncatchable && ended.exit_code == 137) ||
                          (fault.loads_libraries && (ended.exit_code == 127 || ended.exit_code == 139));
    if (wrong.empty() && !forgiven) wrong = broken_report(ended, fault.codes);
    if (wrong.empty() && fault.uncatchable) {
      // What lies there now must not stand in the way, and must go. (A config's looks cannot be added twice,
      // and what was applied in place would be applied again.)
      const bool done = now == subject.after;
      const bool repeatable = subject.verb->name != "bake into" && subject.verb->name != "apply in place";
      if (repeatable || !done) {
        const Ended again = run(run_of(subject));
        if (again.exit_code != 0)
          wrong = "cannot be run again: " + again.err;
        else if (files_in(subject.folder) != subject.after)
          wrong = "the next run leaves something else";
      }
    }
    seen.wrong += !wrong.empty();
    EXPECT_EQ(wrong, "") << where;
  }
}

std::string text_of(const Seen& seen) {
  std::string out;
  for (const auto& [code, count] : seen.codes)
    out += (out.empty() ? "exit " : ", ") + std::to_string(code) + " (" + std::to_string(count) + ")";
  if (seen.temporaries > 0)
    out += "; " + std::to_string(seen.temporaries) + " hidden temporaries, gone after the next run";
  return out + (seen.wrong == 0 ? "" : "; WRONG " + std::to_string(seen.wrong));
}

}  // namespace scotopic::test
