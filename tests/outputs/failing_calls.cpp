// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Calls of the C library by which a process writes files and starts threads, one of which fails.
// Standard output and error are left alone.

#include "injection.h"

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

using fastlio::testing::failsNow;
using fastlio::testing::journal;

namespace
{
constexpr std::size_t kMostFiles = 1024;
constexpr std::size_t kLongestPath = 512;

/** Paths of files that are open for writing, and of folders. */
std::array<std::array<char, kLongestPath>, kMostFiles> paths{};

bool isKnown(int file)
{
  return file > STDERR_FILENO && static_cast<std::size_t>(file) < kMostFiles &&
         paths[static_cast<std::size_t>(file)][0] != '\0';
}

const char* pathOf(int file)
{
  return isKnown(file) ? paths[static_cast<std::size_t>(file)].data() : "?";
}

void remember(int file, const char* path)
{
  if (file <= STDERR_FILENO || static_cast<std::size_t>(file) >= kMostFiles) return;
  auto& entry = paths[static_cast<std::size_t>(file)];
  snprintf(entry.data(), entry.size(), "%s", path);
}

void forget(int file)
{
  if (isKnown(file)) paths[static_cast<std::size_t>(file)][0] = '\0';
}

/** The function that this one hides. */
template <typename Function>
Function* hidden(const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int fail(int error)
{
  errno = error;
  return -1;
}

int openFile(const char* name, const char* path, int flags, mode_t mode)
{
  const bool for_writing = (flags & (O_WRONLY | O_RDWR)) != 0;
  if (for_writing && failsNow("open", path)) return fail(EMFILE);
  const int file = hidden<int(const char*, int, ...)>(name)(path, flags, mode);
  if (for_writing) journal("open", path);
  if (for_writing || (flags & O_DIRECTORY) == O_DIRECTORY) remember(file, path);
  return file;
}

FILE* openStream(const char* name, const char* path, const char* mode)
{
  const bool for_writing = strpbrk(mode, "wa+") != nullptr;
  if (for_writing && failsNow("open", path))
  {
    errno = EMFILE;
    return nullptr;
  }
  FILE* const stream = hidden<FILE*(const char*, const char*)>(name)(path, mode);
  if (for_writing && stream != nullptr) remember(fileno(stream), path);
  return stream;
}
}  // namespace

extern "C"
{
  int open(const char* path, int flags, ...)
  {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    return openFile("open", path, flags, mode);
  }

  int open64(const char* path, int flags, ...)
  {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    return openFile("open64", path, flags, mode);
  }

  FILE* fopen(const char* path, const char* mode)
  {
    return openStream("fopen", path, mode);
  }

  FILE* fopen64(const char* path, const char* mode)
  {
    return openStream("fopen64", path, mode);
  }

  /** A disk that is full takes a part of the bytes first. */
  ssize_t write(int file, const void* bytes, size_t count)
  {
    const auto real = hidden<ssize_t(int, const void*, size_t)>("write");
    if (!isKnown(file)) return real(file, bytes, count);
    if (failsNow("write", pathOf(file))) return fail(ENOSPC);
    const bool partly = failsNow("short-write", pathOf(file)) && count > 1;
    const ssize_t written = real(file, bytes, partly ? count / 2 : count);
    journal("write", pathOf(file), static_cast<long>(written));
    return written;
  }

  ssize_t writev(int file, const struct iovec* parts, int count)
  {
    if (isKnown(file) && failsNow("write", pathOf(file))) return fail(ENOSPC);
    return hidden<ssize_t(int, const struct iovec*, int)>("writev")(file, parts, count);
  }

  ssize_t pwrite(int file, const void* bytes, size_t count, off_t offset)
  {
    if (isKnown(file) && failsNow("write", pathOf(file))) return fail(ENOSPC);
    return hidden<ssize_t(int, const void*, size_t, off_t)>("pwrite")(file, bytes, count, offset);
  }

  int fsync(int file)
  {
    if (failsNow("fsync", pathOf(file))) return fail(EIO);
    const int result = hidden<int(int)>("fsync")(file);
    journal("fsync", pathOf(file));
    return result;
  }

  /** As on network file systems: the file is closed, and data were lost. */
  int close(int file)
  {
    const bool fails = isKnown(file) && failsNow("close", pathOf(file));
    forget(file);
    const int result = hidden<int(int)>("close")(file);
    return fails ? fail(EIO) : result;
  }

  int fclose(FILE* stream)
  {
    const int file = fileno(stream);
    const bool fails = isKnown(file) && failsNow("close", pathOf(file));
    forget(file);
    const int result = hidden<int(FILE*)>("fclose")(stream);
    return fails ? fail(EIO) : result;
  }

  int rename(const char* from, const char* to)
  {
    if (failsNow("rename", to)) return fail(EACCES);
    const int result = hidden<int(const char*, const char*)>("rename")(from, to);
    journal("rename", from, to);
    return result;
  }

  int remove(const char* path)
  {
    const int result = hidden<int(const char*)>("remove")(path);
    journal("remove", path);
    return result;
  }

  int mkdir(const char* path, mode_t mode)
  {
    if (failsNow("mkdir", path)) return fail(ENOSPC);
    return hidden<int(const char*, mode_t)>("mkdir")(path, mode);
  }

  char* mkdtemp(char* pattern)
  {
    if (failsNow("mkdir", pattern))
    {
      errno = ENOSPC;
      return nullptr;
    }
    return hidden<char*(char*)>("mkdtemp")(pattern);
  }

  int pthread_create(
      pthread_t* thread, const pthread_attr_t* attributes, void* (*function)(void*), void* argument)
  {
    if (failsNow("thread", "")) return EAGAIN;
    return hidden<int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>(
        "pthread_create")(thread, attributes, function, argument);
  }
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)
