// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "injection.h"

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace fastlio::testing
{
namespace
{
// Functions of the C library are replaced in the whole process: the state is that of the process,
// too.
char fault_kind[32] = "";
long fault_number = 0;
std::atomic<long> calls{0};
std::atomic<bool> started{false};
int journal_file = -1;

using Main = int (*)(int, char**, char**);
Main program = nullptr;

int runProgram(int argc, char** argv, char** environment)
{
  started = true;
  return program(argc, argv, environment);
}

/** Runs before main(). */
__attribute__((constructor)) void readEnvironment()
{
  if (const char* const fault = getenv("FASTLIO_FAULT"))
    if (const char* const colon = strchr(fault, ':'))
    {
      snprintf(fault_kind, sizeof fault_kind, "%.*s", static_cast<int>(colon - fault), fault);
      fault_number = atol(colon + 1);
    }
  if (const char* const path = getenv("FASTLIO_JOURNAL"))
    journal_file = static_cast<int>(
        syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  unsetenv("LD_PRELOAD");  // not for children
}

void writeJournal(const char* text, int length)
{
  if (journal_file >= 0 && length > 0)
    syscall(SYS_write, journal_file, text, static_cast<std::size_t>(length));
}
}  // namespace

bool failsNow(const char* kind, const char* about)
{
  if (!started || strcmp(kind, fault_kind) != 0 || ++calls != fault_number) return false;
  journal("injected", kind, about);
  return true;
}

void journal(const char* what, const char* path, const char* other)
{
  if (journal_file < 0) return;
  std::array<char, 4096> line{};
  const int length = snprintf(line.data(), line.size(), "%s %s %s\n", what, path, other);
  writeJournal(line.data(), length);
}

void journal(const char* what, const char* path, long bytes)
{
  std::array<char, 32> number{};
  snprintf(number.data(), number.size(), "%ld", bytes);
  journal(what, path, number.data());
}

}  // namespace fastlio::testing

/** Nobody can handle a failure before main(), in libraries that start up. */
extern "C" int __libc_start_main(  // NOLINT(bugprone-reserved-identifier): it is that function
    fastlio::testing::Main function, int argc, char** argv, void (*begin)(), void (*end)(),
    void (*unload)(), void* stack)
{
  using Start = int(fastlio::testing::Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  fastlio::testing::program = function;
  auto* const start = reinterpret_cast<Start*>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(fastlio::testing::runProgram, argc, argv, begin, end, unload, stack);
}
