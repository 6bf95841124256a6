// A library for LD_PRELOAD that takes memory from a node: while a file exists, one in five of the allocations of 200 bytes
// and more fails that code of this package asked for, itself or by what it called. The file gets a byte for each.
//
//   FAILING_ALLOCATIONS=file LD_PRELOAD=libfailing_allocations.so navigate_path
//
// With FAILING_ALLOCATIONS_THREAD=NAME only in threads of that name, and there of any size.
//
// Not in the threads in which roscpp receives and keeps timers: what cannot be handed over there is lost for good, and ends
// the process (doc/security_results.md).
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <random>
#include <thread>

#include "memory/failing_operators.h"

namespace grid_path_planner::test {
namespace {

constexpr std::size_t kLeastBytes =
    200;  // smaller ones are had as long as a process can run at all
constexpr unsigned kOneIn = 5;
constexpr int kDeepest = 64;  // calls

thread_local bool inside = false;  // this library itself

const char* fileName() {
  static const char* const file = std::getenv("FAILING_ALLOCATIONS");
  return file;
}

// None: in all.
const char* threadName() {
  static const char* const name = std::getenv("FAILING_ALLOCATIONS_THREAD");
  return name;
}

bool isOfThatThread() {
  std::array<char, 16> name{};
  return ::prctl(PR_GET_NAME, name.data()) == 0 && std::strcmp(name.data(), threadName()) == 0;
}

bool isMeant(std::size_t bytes) {
  return threadName() == nullptr ? bytes >= kLeastBytes : isOfThatThread();
}

bool isOn() {
  return fileName() != nullptr && ::access(fileName(), F_OK) == 0;
}

void tell() {
  const int file = ::open(fileName(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0) return;
  if (::write(file, "x", 1) != 1) std::abort();
  ::close(file);
}

bool isDue() {
  thread_local std::minstd_rand random(
      static_cast<std::uint32_t>(std::hash<std::thread::id>()(std::this_thread::get_id())));
  return random() % kOneIn == 0;
}

bool has(const char* text, const char* part) {
  return text != nullptr && std::strstr(text, part) != nullptr;
}

bool isOfRoscppAlone(const char* function) {
  return has(function, "PollManager10threadFunc") || has(function, "TimerManager");
}

const void* thisLibrary() {
  static const void* const base = [] {
    Dl_info library{};
    return ::dladdr(reinterpret_cast<const void*>(&fileName), &library) != 0 ? library.dli_fbase
                                                                             : nullptr;
  }();
  return base;
}

// From the innermost call to the outermost.
bool isAskedForByUs() {
  std::array<void*, kDeepest> calls{};
  const int depth = ::backtrace(calls.data(), kDeepest);
  bool ours = false;
  for (int i = 0; i < depth; ++i) {
    Dl_info call{};
    if (::dladdr(calls[static_cast<std::size_t>(i)], &call) == 0) continue;
    if (call.dli_fbase == thisLibrary()) continue;
    if (isOfRoscppAlone(call.dli_sname)) return false;
    ours = ours ||
           has(call.dli_sname,
               "17grid_path_planner");  // others call templates of the standard library in ours
  }
  return ours;
}

}  // namespace

bool allocationFails(std::size_t bytes) {
  if (inside) return false;
  inside = true;
  const bool result = isMeant(bytes) && isOn() && isDue() && isAskedForByUs();
  if (result) tell();
  inside = false;
  return result;
}

}  // namespace grid_path_planner::test
