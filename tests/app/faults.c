/* Preloaded into the program: makes a system call fail, or a signal arrive with it.
 * LAMELLA_FAULT = "CALL COUNT ACTION NUMBER": at the COUNT-th CALL (0: at all of them) the call
 * fails with errno NUMBER (ACTION "fail"), or the program receives the signal NUMBER before it
 * (ACTION "signal"). CALL is the name of one of those below, such a name with a path as in
 * "open:/dev/null", or "change" for any that changes a folder or a file. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static atomic_int calls;

/* Whether the call is to fail; errno is set then. */
static int fails(const char* call, int changes, const char* path) {
  char wanted[256], with_path[256], action[16];
  int count = 0, number = 0;
  const char* fault = getenv("LAMELLA_FAULT");
  if (!fault || sscanf(fault, "%255s %d %15s %d", wanted, &count, action, &number) != 4) return 0;
  snprintf(with_path, sizeof with_path, "%s:%s", call, path ? path : "");
  if (strcmp(wanted, call) != 0 && !(changes && strcmp(wanted, "change") == 0) &&
      strcmp(wanted, with_path) != 0)
    return 0;
  if (atomic_fetch_add(&calls, 1) + 1 != count && count != 0) return 0;
  if (strcmp(action, "signal") == 0) {
    kill(getpid(), number);
    return 0;
  }
  errno = number;
  return 1;
}

static int takes_mode(int flags) { return (flags & O_CREAT) || (flags & O_TMPFILE) == O_TMPFILE; }

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = takes_mode(flags) ? va_arg(more, mode_t) : 0;
  va_end(more);
  return fails("open", flags & O_CREAT, path) ? -1 : REAL(open)(path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = takes_mode(flags) ? va_arg(more, mode_t) : 0;
  va_end(more);
  return fails("openat", flags & O_CREAT, path) ? -1 : REAL(openat)(folder, path, flags, mode);
}

ssize_t write(int file, const void* bytes, size_t count) {
  return fails("write", 1, NULL) ? -1 : REAL(write)(file, bytes, count);
}

int fsync(int file) { return fails("fsync", 1, NULL) ? -1 : REAL(fsync)(file); }

int flock(int file, int operation) {
  return fails("flock", 0, NULL) ? -1 : REAL(flock)(file, operation);
}

int mkdir(const char* path, mode_t mode) {
  return fails("mkdir", 1, path) ? -1 : REAL(mkdir)(path, mode);
}

int mkdirat(int folder, const char* path, mode_t mode) {
  return fails("mkdirat", 1, path) ? -1 : REAL(mkdirat)(folder, path, mode);
}

int unlinkat(int folder, const char* path, int flags) {
  return fails("unlinkat", 1, path) ? -1 : REAL(unlinkat)(folder, path, flags);
}

int renameat(int from, const char* old, int to, const char* new) {
  return fails("renameat", 1, new) ? -1 : REAL(renameat)(from, old, to, new);
}
