// The thread of a node that commands, as the system, the diagnostics and lock_watch.cpp see it.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace grid_path_planner::test {

// Its folder in /proc.
inline std::filesystem::path controlThreadOf(pid_t process) {
  const std::string tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks))
    if (contentOf((task.path() / "comm").string()) == "control\n") return task.path();
  throw std::runtime_error("there is no thread \"control\"");
}

// SCHED_FIFO or SCHED_OTHER.
inline int policyOf(const std::filesystem::path& thread) {
  return ::sched_getscheduler(std::stoi(thread.filename().string()));
}

// Of a processor, so far.
inline double secondsOf(const std::filesystem::path& thread) {
  return 1e-9 * std::stod(contentOf((thread / "schedstat").string()));
}

// The newest value of `key`; empty where there is none.
inline std::string valueIn(const std::vector<diagnostic_msgs::DiagnosticArray>& diagnostics,
                           const std::string& key) {
  std::string value;
  for (const auto& array : diagnostics)
    for (const auto& status : array.status)
      for (const auto& entry : status.values)
        if (entry.key == key) value = entry.value;
  return value;
}

// By the report of a node that has ended (lock_watch.cpp).
inline ::testing::AssertionResult takesNoSlowLock(const std::string& report) {
  const std::string text = contentOf(report);
  const auto counted = [&](const std::string& name) {
    const std::size_t at = text.find(name + ": ");
    return at == std::string::npos ? -1 : std::stoi(text.substr(at + name.size() + 2));
  };
  if (counted("control") <= 0)
    return ::testing::AssertionFailure() << "no thread was watched: " << text;
  if (counted("slow") <= 0) return ::testing::AssertionFailure() << "nothing was slow: " << text;
  if (counted("files") != 0)
    return ::testing::AssertionFailure() << "it opened or synced files itself: " << text;
  if (text.find("both: ") != std::string::npos) return ::testing::AssertionFailure() << text;
  return ::testing::AssertionSuccess();
}

}  // namespace grid_path_planner::test
