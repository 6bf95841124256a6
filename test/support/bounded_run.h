// What an action takes that reads a hostile file: run in a process of its own, under `ulimit -v`.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <fstream>
#include <ostream>
#include <string>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::test {

struct BoundedRun {
  bool ended = false;   // by itself, with an answer or an InputError
  std::string refusal;  // of the InputError; "" where there was an answer
  double megabytes =
      0.0;  // that its largest resident memory was above that before; 0 with shadow memory
  double cpu_seconds = 0.0;
};

inline std::ostream& operator<<(std::ostream& out, const BoundedRun& run) {
  return out << (run.ended ? run.refusal.empty() ? "answered" : run.refusal : "no end") << ", "
             << run.megabytes << " MB, " << run.cpu_seconds << " s";
}

// The largest resident memory of this process so far, in MB.
inline double residentPeak() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:" && status >> word) return std::stod(word) / 1024.0;
  return 0.0;
}

// Of the sanitizers: it needs all of the address space, and is resident too.
constexpr bool hasShadowMemory() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return true;
#else
  return false;
#endif
}

template <class Action>
BoundedRun runBounded(const Action& action) {
  constexpr rlim_t kAddressSpace = rlim_t{4} << 30, kCpu = 60;
  int pipe_ends[2];
  BoundedRun run;
  if (::pipe(pipe_ends) != 0) return run;
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit space{kAddressSpace, kAddressSpace}, cpu{kCpu, kCpu};
    if (!hasShadowMemory()) ::setrlimit(RLIMIT_AS, &space);
    ::setrlimit(RLIMIT_CPU, &cpu);
    const double before = residentPeak();
    std::string text;
    try {
      action();
    } catch (const base::InputError& error) {
      text = error.what();
    }
    text = std::to_string(hasShadowMemory() ? 0.0 : residentPeak() - before) + " " + text;
    const ssize_t written = ::write(pipe_ends[1], text.data(), text.size());
    ::_exit(written == static_cast<ssize_t>(text.size()) ? 0 : 1);
  }
  ::close(pipe_ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t count; (count = ::read(pipe_ends[0], buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(count));
  ::close(pipe_ends[0]);
  int state = 0;
  rusage usage{};
  ::wait4(child, &state, 0, &usage);
  run.ended = WIFEXITED(state) && WEXITSTATUS(state) == 0 && !text.empty();
  if (run.ended) {
    run.megabytes = std::stod(text);
    run.refusal = text.substr(text.find(' ') + 1);
  }
  const auto seconds = [](const timeval& time) { return time.tv_sec + 1e-6 * time.tv_usec; };
  run.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return run;
}

}  // namespace grid_path_planner::test
