/* Preloaded into the program, it kills it at one of its operations on the files below a folder: at all of them in turn,
   this is every moment at which a run can end.

   FAULT_FOLDER  whose files count
   FAULT_RANK    the rank that counts them, of several
   FAULT_AT      number of the operation, from 1; 0: none
   FAULT_KIND    "before" it, "torn" in the middle of a write, or "after" it
   FAULT_COUNT   a file that is given the number of operations at the end */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

enum when { before, torn, after };

static const char* folder = NULL; /* NULL: nothing is counted */
static long n_operations = 0, fatal = 0;
static enum when kind = before;

__attribute__((constructor)) static void read_environment(void) {
  const char *rank = getenv("FAULT_RANK"), *own_rank = getenv("OMPI_COMM_WORLD_RANK");
  if (rank && own_rank && strcmp(rank, own_rank) != 0) return;
  folder = getenv("FAULT_FOLDER");
  if (getenv("FAULT_AT")) fatal = atol(getenv("FAULT_AT"));
  if (!getenv("FAULT_KIND")) return;
  if (!strcmp(getenv("FAULT_KIND"), "torn")) kind = torn;
  if (!strcmp(getenv("FAULT_KIND"), "after")) kind = after;
}

__attribute__((destructor)) static void tell_number(void) {
  const char* name = getenv("FAULT_COUNT");
  FILE* file = n_operations > 0 && name ? fopen(name, "w") : NULL; /* MPI's daemon, a child of the program, has none */
  if (!file) return;
  fprintf(file, "%ld\n", n_operations);
  fclose(file);
}

static void* original(const char* name) { return dlsym(RTLD_NEXT, name); }

static int is_below_folder(const char* path) { return folder && path && !strncmp(path, folder, strlen(folder)); }

static int is_open_below_folder(int descriptor) {
  char link[64], path[4096];
  ssize_t length;
  if (!folder) return 0;
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  length = readlink(link, path, sizeof path - 1);
  if (length < 0) return 0;
  path[length] = 0;
  return is_below_folder(path);
}

static void die(void) {
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

/* Whether this operation is the fatal one, which has not died yet. */
static int is_fatal(int counts) {
  if (!counts || ++n_operations != fatal) return 0;
  if (kind == before) die();
  return 1;
}

/* All of these have the same shape: look, do, die. */
#define OPERATION(type, name, parameters, arguments, counts) \
  type name parameters {                                     \
    type(*real) parameters = original(#name);                \
    const int last = is_fatal(counts);                       \
    type result = real arguments;                            \
    if (last) die();                                         \
    return result;                                           \
  }

/* With one that does half of it before. */
#define WRITE(name, parameters, arguments, half)        \
  ssize_t name parameters {                             \
    ssize_t(*real) parameters = original(#name);        \
    ssize_t result;                                     \
    if (!is_fatal(is_open_below_folder(file))) {        \
      return real arguments;                            \
    }                                                   \
    result = kind == torn ? real half : real arguments; \
    die();                                              \
    return result;                                      \
  }

WRITE(write, (int file, const void* data, size_t size), (file, data, size), (file, data, size / 2))
WRITE(pwrite, (int file, const void* data, size_t size, off_t at), (file, data, size, at), (file, data, size / 2, at))
WRITE(pwrite64, (int file, const void* data, size_t size, off64_t at), (file, data, size, at),
      (file, data, size / 2, at))
WRITE(writev, (int file, const struct iovec* parts, int n), (file, parts, n), (file, parts, n / 2))

OPERATION(int, rename, (const char* old, const char* name), (old, name), is_below_folder(name))
OPERATION(int, unlink, (const char* name), (name), is_below_folder(name))
OPERATION(int, remove, (const char* name), (name), is_below_folder(name))
OPERATION(int, rmdir, (const char* name), (name), is_below_folder(name))
OPERATION(int, unlinkat, (int where, const char* name, int flags), (where, name, flags), is_below_folder(name))
OPERATION(int, mkdir, (const char* name, mode_t mode), (name, mode), is_below_folder(name))
OPERATION(int, truncate, (const char* name, off_t size), (name, size), is_below_folder(name))
OPERATION(int, truncate64, (const char* name, off64_t size), (name, size), is_below_folder(name))
OPERATION(int, ftruncate, (int file, off_t size), (file, size), is_open_below_folder(file))
OPERATION(int, ftruncate64, (int file, off64_t size), (file, size), is_open_below_folder(file))
OPERATION(int, fsync, (int file), (file), is_open_below_folder(file))

static int changes(const char* name, int flags) {
  return (flags & (O_CREAT | O_TRUNC | O_WRONLY | O_RDWR)) != 0 && is_below_folder(name);
}

#define OPEN(name)                                        \
  int name(const char* path, int flags, ...) {            \
    int (*real)(const char*, int, ...) = original(#name); \
    va_list rest;                                         \
    mode_t mode;                                          \
    int last, result;                                     \
    va_start(rest, flags);                                \
    mode = va_arg(rest, mode_t);                          \
    va_end(rest);                                         \
    last = is_fatal(changes(path, flags));                \
    result = real(path, flags, mode);                     \
    if (last) die();                                      \
    return result;                                        \
  }

OPEN(open)
OPEN(open64)

#define WRITES(mode) ((mode)[0] != 'r' || strchr(mode, '+'))

OPERATION(FILE*, fopen, (const char* name, const char* mode), (name, mode), WRITES(mode) && is_below_folder(name))
OPERATION(FILE*, fopen64, (const char* name, const char* mode), (name, mode), WRITES(mode) && is_below_folder(name))
