// A library for LD_PRELOAD that watches which locks of a node are held by whom, and while what is done.
//
//   LOCK_WATCH_REPORT=file LD_PRELOAD=liblock_watch.so navigate_path
//
// Watched are mutexes locked by code of this package and of tf2; roscpp's own are not ours to choose. One
// is `slow` where a thread opened, read, wrote or synced a file while it held it, took a lock of roscpp's
// or of the log's, as publishing and logging do, or belongs to the code that receives maps. At the end
// of the process the report says how many locks the thread named `control` took, how many others are
// slow, and, a line each, which are both; and how many files that thread itself opened or synced.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace grid_path_planner::test {
namespace {

struct Lock {
  const void* mutex = nullptr;
  const void* control_site = nullptr;  // where the control thread took it
  const void* slow_site = nullptr;     // where one that was slow took it
};

struct Held {
  const void* mutex;
  const void* site;
  bool watched;
};

constexpr std::size_t kLocks = 1 << 16;
std::array<Lock, kLocks> locks;
std::atomic_flag busy = ATOMIC_FLAG_INIT;

constexpr std::size_t kDeepest = 64;
thread_local std::array<Held, kDeepest> held;
thread_local std::size_t depth = 0;
thread_local bool inside = false;  // this library itself

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

// The table's place of a mutex; between the two lines of the flag.
template <class Work>
void withLock(const void* mutex, Work work) {
  while (busy.test_and_set(std::memory_order_acquire)) ::sched_yield();
  std::size_t at = reinterpret_cast<std::size_t>(mutex) / 8 % kLocks;
  while (locks[at].mutex != nullptr && locks[at].mutex != mutex) at = (at + 1) % kLocks;
  locks[at].mutex = mutex;
  work(locks[at]);
  busy.clear(std::memory_order_release);
}

const char* libraryOf(const void* site) {
  Dl_info info;
  return ::dladdr(site, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "";
}

std::string functionOf(const void* site) {
  Dl_info info;
  return ::dladdr(site, &info) != 0 && info.dli_sname != nullptr ? info.dli_sname : "?";
}

// Of the template that locks roscpp's recursive mutexes the linker may take the copy in our libraries.
bool isWatched(const void* site) {
  const char* const library = libraryOf(site);
  const bool ours = std::strstr(library, "grid_path_planner") != nullptr ||
                    std::strstr(library, "libtf2.so") != nullptr;
  return ours && functionOf(site).find("recursive_mutex") == std::string::npos;
}

bool publishesOrLogs(const char* library) {
  for (const char* name :
       {"libroscpp", "libxmlrpcpp", "librosconsole", "liblog4cxx", "console_bridge"})
    if (std::strstr(library, name) != nullptr) return true;
  return false;
}

bool isControl() {
  char name[16] = "";
  ::prctl(PR_GET_NAME, name);
  return std::strcmp(name, "control") == 0;
}

// What a place in the code that takes a lock belongs to.
struct Kind {
  const void* site = nullptr;
  bool watched = false;
  bool slow = false;  // publishes or logs
  bool maps = false;
};

// To look a place up takes longer than all that is done with the lock: each thread does so once.
const Kind& kindOf(const void* site) {
  thread_local std::array<Kind, 1024> known;
  Kind& kind = known[reinterpret_cast<std::size_t>(site) / 4 % known.size()];
  if (kind.site == site) return kind;
  const std::string function = functionOf(site);
  kind.site = site;
  kind.watched = isWatched(site);
  kind.slow = publishesOrLogs(libraryOf(site));
  kind.maps = function.find("MapReceiver") != std::string::npos ||
              function.find("MapMonitor") != std::string::npos;
  return kind;
}

// All that this thread holds.
void markSlow() {
  if (depth == 0 || isControl()) return;
  for (std::size_t i = 0; i < depth; ++i)
    if (held[i].watched)
      withLock(held[i].mutex, [&](Lock& lock) { lock.slow_site = held[i].site; });
}

void noteLocked(const void* mutex, const void* site) {
  if (inside) return;
  inside = true;
  const Kind& kind = kindOf(site);
  if (kind.slow) markSlow();
  if (depth < kDeepest) held[depth++] = {mutex, site, kind.watched};
  if (kind.watched && isControl())
    withLock(mutex, [&](Lock& lock) { lock.control_site = site; });
  else if (kind.watched && kind.maps)
    withLock(mutex, [&](Lock& lock) { lock.slow_site = site; });
  inside = false;
}

void noteUnlocked(const void* mutex) {
  if (inside) return;
  for (std::size_t i = depth; i-- > 0;)
    if (held[i].mutex == mutex) {
      for (std::size_t k = i + 1; k < depth; ++k) held[k - 1] = held[k];
      --depth;
      return;
    }
}

void noteFile() {
  if (inside) return;
  inside = true;
  markSlow();
  inside = false;
}

std::atomic<int> files_of_control{0};

// Of a file that is no socket: these are read and written, too.
void noteDisk() {
  if (!inside && isControl()) ++files_of_control;
  noteFile();
}

struct Report {
  ~Report() {
    inside = true;
    const char* name = std::getenv("LOCK_WATCH_REPORT");
    std::FILE* const file = name != nullptr ? std::fopen(name, "w") : nullptr;
    if (file == nullptr) return;
    int control = 0, slow = 0;
    for (const Lock& lock : locks) {
      control += lock.control_site != nullptr ? 1 : 0;
      slow += lock.slow_site != nullptr ? 1 : 0;
      if (lock.control_site != nullptr && lock.slow_site != nullptr)
        std::fprintf(file, "both: %s and %s\n", functionOf(lock.control_site).c_str(),
                     functionOf(lock.slow_site).c_str());
    }
    std::fprintf(file, "control: %d\nslow: %d\nfiles: %d\n", control, slow,
                 files_of_control.load());
    std::fclose(file);
  }
} report;

}  // namespace
}  // namespace grid_path_planner::test

using grid_path_planner::test::next;
using grid_path_planner::test::noteDisk;
using grid_path_planner::test::noteFile;
using grid_path_planner::test::noteLocked;
using grid_path_planner::test::noteUnlocked;

extern "C" {

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  static const auto lock = next<int (*)(pthread_mutex_t*)>("pthread_mutex_lock");
  const int result = lock(mutex);
  if (result == 0) noteLocked(mutex, __builtin_return_address(0));
  return result;
}

int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  static const auto lock = next<int (*)(pthread_mutex_t*)>("pthread_mutex_trylock");
  const int result = lock(mutex);
  if (result == 0) noteLocked(mutex, __builtin_return_address(0));
  return result;
}

int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
  static const auto unlock = next<int (*)(pthread_mutex_t*)>("pthread_mutex_unlock");
  noteUnlocked(mutex);
  return unlock(mutex);
}

int open(const char* name, int flags, ...) {
  static const auto call = next<int (*)(const char*, int, ...)>("open");
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  noteDisk();
  return call(name, flags, mode);
}

int openat(int folder, const char* name, int flags, ...) {
  static const auto call = next<int (*)(int, const char*, int, ...)>("openat");
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  noteDisk();
  return call(folder, name, flags, mode);
}

ssize_t read(int file, void* bytes, size_t count) {
  static const auto call = next<ssize_t (*)(int, void*, size_t)>("read");
  noteFile();
  return call(file, bytes, count);
}

ssize_t write(int file, const void* bytes, size_t count) {
  static const auto call = next<ssize_t (*)(int, const void*, size_t)>("write");
  noteFile();
  return call(file, bytes, count);
}

int fsync(int file) {
  static const auto call = next<int (*)(int)>("fsync");
  noteDisk();
  return call(file);
}

}  // extern "C"
