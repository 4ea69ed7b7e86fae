// Preloaded into the program under test: the k-th call of a kind goes wrong.
//
//   FAULT_CALL    write, read, create, open, fsync, close, link, rename, mkdir, malloc (from main on); or
//   event:
//                 any of those that change the disk
//   FAULT_AT      which call, from 1
//   FAULT_DO      an errno; or kill, signalN (raise N), short (half of it is done), truncate, append,
//   rewrite,
//                 replace (of the file being read)
//   FAULT_STICKY  set: that call and all later ones
//   FAULT_FOLDER  files in it count, others do not (open, malloc: all count)
//   FAULT_COUNTS  a file that how many calls there were is written to, when the program ends by itself
//   FAULT_LOG     a file that names asked of the environment, files opened to write and forbidden calls go to
//   FAULT_JAIL    set: the kernel kills the program if it starts another, forks or opens a socket
//
// No allocation, no library call that allocates: malloc is among the calls.
#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <locale.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <initializer_list>

extern "C" {
extern char** environ;
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

enum Call {
  c_write,
  c_read,
  c_create,
  c_open,
  c_fsync,
  c_close,
  c_link,
  c_rename,
  c_mkdir,
  c_malloc,
  c_event,
  c_none
};
const char* const names[] = {"write", "read",   "create", "open",   "fsync", "close",
                             "link",  "rename", "mkdir",  "malloc", "event", "none"};
enum Action { a_errno, a_kill, a_signal, a_short, a_truncate, a_append, a_rewrite, a_replace };

std::atomic<long> counts[c_none + 1];
Call call = c_none;
Action action = a_errno;
long at = 0, number = 0;
bool sticky = false, ready = false, in_main = false;
const char *folder = nullptr, *counts_file = nullptr, *log_file = nullptr;
__attribute__((tls_model("initial-exec"))) thread_local bool inside = false;

// getenv is among what is watched.
const char* variable(const char* name) {
  const size_t length = strlen(name);
  for (char** entry = environ; entry && *entry; ++entry)
    if (strncmp(*entry, name, length) == 0 && (*entry)[length] == '=') return *entry + length + 1;
  return nullptr;
}

void put(const char* file, const char* a, const char* b) {
  const int fd = static_cast<int>(syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND, 0600));
  if (fd < 0) return;
  char line[1200];
  size_t n = 0;
  for (const char* part : {a, " ", b, "\n"})
    for (; *part && n + 1 < sizeof line; ++part) line[n++] = *part;
  (void)!syscall(SYS_write, fd, line, n);
  syscall(SYS_close, fd);
}

void log_line(const char* what, const char* name) {
  if (ready && log_file) put(log_file, what, name);
}

void jail() {
  const auto deny = [](unsigned number_of_call) {
    return sock_filter(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number_of_call, 0, 1));
  };
  const sock_filter kill_it = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)), deny(SYS_execve), kill_it,
      deny(SYS_execveat), kill_it, deny(SYS_socket), kill_it, deny(SYS_connect), kill_it, deny(SYS_fork),
      kill_it, deny(SYS_vfork), kill_it, deny(SYS_ptrace), kill_it,
      // Threads are allowed, processes are not. clone3 hides which it is: glibc does without.
      deny(SYS_clone3), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clone, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args)),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, CLONE_THREAD, 1, 0), kill_it,
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program = {sizeof filter / sizeof *filter, filter};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
    put("/dev/stderr", "shim:", "no seccomp here");
}

__attribute__((constructor)) void start() {
  const char* what = variable("FAULT_CALL");
  for (int i = 0; what && i < c_none; ++i)
    if (strcmp(what, names[i]) == 0) call = static_cast<Call>(i);
  if (const char* k = variable("FAULT_AT")) at = atol(k);
  sticky = variable("FAULT_STICKY") != nullptr;
  folder = variable("FAULT_FOLDER");
  counts_file = variable("FAULT_COUNTS");
  log_file = variable("FAULT_LOG");
  if (const char* d = variable("FAULT_DO")) {
    number = atol(d);
    if (strcmp(d, "kill") == 0) action = a_kill;
    if (strncmp(d, "signal", 6) == 0) action = a_signal, number = atol(d + 6);
    if (strcmp(d, "short") == 0) action = a_short;
    if (strcmp(d, "truncate") == 0) action = a_truncate;
    if (strcmp(d, "append") == 0) action = a_append;
    if (strcmp(d, "rewrite") == 0) action = a_rewrite;
    if (strcmp(d, "replace") == 0) action = a_replace;
  }
  if (variable("FAULT_JAIL")) jail();
  ready = true;
}

__attribute__((destructor)) void end() {
  if (!counts_file) return;
  for (int i = 0; i < c_none; ++i) {
    char text[32];
    snprintf(text, sizeof text, "%ld", counts[i].load());
    put(counts_file, names[i], text);
  }
}

bool counts_path(const char* path) { return folder && path && strncmp(path, folder, strlen(folder)) == 0; }

bool counts_fd(int fd, char* path, size_t size) {
  char link[40];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const long n = syscall(SYS_readlinkat, AT_FDCWD, link, path, size - 1);
  if (n <= 0) return false;
  path[n] = '\0';
  return counts_path(path);
}

void change_file(const char* path) {
  char other[1100];
  snprintf(other, sizeof other, "%s.other", path);
  struct stat info;
  if (stat(path, &info) != 0) return;
  if (action == a_truncate) (void)!syscall(SYS_truncate, path, info.st_size / 2);
  if (action == a_replace) (void)!syscall(SYS_renameat2, AT_FDCWD, other, AT_FDCWD, path, 0);
  if (action == a_append || action == a_rewrite) {
    const int fd = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, O_WRONLY, 0));
    const char junk[64] = {42};
    const long where = action == a_append ? info.st_size : info.st_size - 64;
    (void)!syscall(SYS_pwrite64, fd, junk, sizeof junk, where);
    syscall(SYS_close, fd);
  }
}

/// Whether this call is to fail (errno is set then), or, `is_short`, to do but half.
bool fails(Call kind, bool* is_short = nullptr, const char* path = nullptr) {
  if (!ready || inside || (kind == c_malloc && !in_main)) return false;
  inside = true;
  const bool changes = kind != c_read && kind != c_open && kind != c_malloc && kind != c_close;
  const long n = ++counts[kind], e = changes ? ++counts[c_event] : 0;
  const long k = kind == call ? n : call == c_event && changes ? e : 0;
  bool failed = false;
  if (k > 0 && (k == at || (sticky && k > at))) {
    if (action == a_errno) errno = static_cast<int>(number), failed = true;
    if (action == a_kill) syscall(SYS_kill, syscall(SYS_getpid), SIGKILL);
    if (action == a_signal) raise(static_cast<int>(number));
    if (action == a_short && is_short) *is_short = true;
    if (action >= a_truncate && path) change_file(path);
  }
  inside = false;
  return failed;
}

bool fd_fails(Call kind, int fd, bool* is_short = nullptr) {
  char path[1024];
  if (!ready || !counts_fd(fd, path, sizeof path)) return false;
  return fails(kind, is_short, path);
}

size_t part(size_t n, bool is_short) { return is_short && n > 1 ? n / 2 : n; }

bool writes(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

int open_at(int where, const char* path, int flags, mode_t mode) {
  if (writes(flags)) log_line("open", path);
  if (fails(c_open)) return -1;
  if (writes(flags) && counts_path(path) && (flags & (O_CREAT | O_TMPFILE)) && fails(c_create)) return -1;
  return static_cast<int>(syscall(SYS_openat, where, path, flags, mode));
}

mode_t mode_of(int flags, va_list list) {
  return (flags & O_CREAT) || (flags & O_TMPFILE) == O_TMPFILE ? static_cast<mode_t>(va_arg(list, int)) : 0;
}

}  // namespace

extern "C" {

ssize_t write(int fd, const void* data, size_t n) {
  bool is_short = false;
  if (fd_fails(c_write, fd, &is_short)) return -1;
  return syscall(SYS_write, fd, data, part(n, is_short));
}
ssize_t pwrite64(int fd, const void* data, size_t n, off64_t where) {
  bool is_short = false;
  if (fd_fails(c_write, fd, &is_short)) return -1;
  return syscall(SYS_pwrite64, fd, data, part(n, is_short), where);
}
ssize_t pwrite(int fd, const void* data, size_t n, off_t where) { return pwrite64(fd, data, n, where); }
ssize_t writev(int fd, const struct iovec* parts, int n) {
  if (fd_fails(c_write, fd)) return -1;
  return syscall(SYS_writev, fd, parts, n);
}
ssize_t read(int fd, void* data, size_t n) {
  bool is_short = false;
  if (fd_fails(c_read, fd, &is_short)) return -1;
  return syscall(SYS_read, fd, data, part(n, is_short));
}
ssize_t pread64(int fd, void* data, size_t n, off64_t where) {
  bool is_short = false;
  if (fd_fails(c_read, fd, &is_short)) return -1;
  return syscall(SYS_pread64, fd, data, part(n, is_short), where);
}
ssize_t pread(int fd, void* data, size_t n, off_t where) { return pread64(fd, data, n, where); }

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return open_at(AT_FDCWD, path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return open_at(AT_FDCWD, path, flags, mode);
}
int openat(int where, const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return open_at(where, path, flags, mode);
}
FILE* fopen(const char* path, const char* mode) {
  const bool out = strpbrk(mode, "wa+") != nullptr;
  const int flags = !out ? O_RDONLY
                         : (strchr(mode, '+') || strchr(mode, 'r') ? O_RDWR : O_WRONLY) |
                               (strchr(mode, 'r') ? 0 : O_CREAT | (strchr(mode, 'a') ? O_APPEND : O_TRUNC));
  const int fd = open_at(AT_FDCWD, path, flags, 0666);
  return fd < 0 ? nullptr : fdopen(fd, mode);
}
FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

int fsync(int fd) { return fd_fails(c_fsync, fd) ? -1 : static_cast<int>(syscall(SYS_fsync, fd)); }
int close(int fd) {
  const bool failed = fd_fails(c_close, fd);
  const int result = static_cast<int>(syscall(SYS_close, fd));
  if (failed) errno = static_cast<int>(number);
  return failed ? -1 : result;
}
int linkat(int from_where, const char* from, int to_where, const char* to, int flags) {
  if (counts_path(to) && fails(c_link)) return -1;
  return static_cast<int>(syscall(SYS_linkat, from_where, from, to_where, to, flags));
}
int rename(const char* from, const char* to) {
  if (counts_path(to) && fails(c_rename)) return -1;
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
int mkdir(const char* path, mode_t mode) {
  if (counts_path(path) && fails(c_mkdir)) return -1;
  return static_cast<int>(syscall(SYS_mkdirat, AT_FDCWD, path, mode));
}

void* malloc(size_t n) { return fails(c_malloc) ? nullptr : __libc_malloc(n); }
void* calloc(size_t n, size_t size) { return fails(c_malloc) ? nullptr : __libc_calloc(n, size); }
void* realloc(void* p, size_t n) { return fails(c_malloc) ? nullptr : __libc_realloc(p, n); }
void* memalign(size_t a, size_t n) { return fails(c_malloc) ? nullptr : __libc_memalign(a, n); }
void* aligned_alloc(size_t a, size_t n) { return fails(c_malloc) ? nullptr : __libc_memalign(a, n); }
int posix_memalign(void** p, size_t a, size_t n) {
  if (fails(c_malloc)) return ENOMEM;
  *p = __libc_memalign(a, n);
  return *p ? 0 : ENOMEM;
}

// The first thing that main does, or nearly.
char* setlocale(int, const char*) {
  in_main = true;
  static char name[] = "C";
  return name;
}

char* getenv(const char* name) {
  log_line("getenv", name);
  return const_cast<char*>(variable(name));
}
char* secure_getenv(const char* name) { return getenv(name); }
int system(const char* command) {
  log_line("forbidden system", command ? command : "");
  errno = EPERM;
  return -1;
}
FILE* popen(const char* command, const char*) {
  log_line("forbidden popen", command);
  errno = EPERM;
  return nullptr;
}
FILE* tmpfile() {
  log_line("forbidden tmpfile", "");
  errno = EPERM;
  return nullptr;
}
int mkstemp(char* name) {
  log_line("forbidden mkstemp", name);
  errno = EPERM;
  return -1;
}

}  // extern "C"
