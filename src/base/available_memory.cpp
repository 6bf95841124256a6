#include "base/available_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

namespace grid_path_planner::base {
namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// "max" and the empty text are no limit.
std::size_t bytesOf(const std::string& digits) {
  std::istringstream text(digits);
  std::size_t bytes = 0;
  return text >> bytes ? bytes : kNoLimit;
}

std::size_t machineMemory(const std::string& root) {
  std::ifstream file(root + "/proc/meminfo");
  std::string name, kibibytes, rest;
  while (file >> name >> kibibytes && std::getline(file, rest))
    if (name == "MemAvailable:") return bytesOf(kibibytes) * 1024;
  return kNoLimit;
}

// The least limit of the group and of those that hold it. In a container the group's name may be
// that of the machine outside, which is not below `folder`: then the folder itself is the group.
std::size_t limitOfGroup(const std::string& folder, std::string group, const char* name) {
  std::size_t least = kNoLimit;
  while (true) {
    std::ifstream file(folder + group + "/" + name);
    std::string digits;
    file >> digits;
    least = std::min(least, bytesOf(digits));
    if (group.empty()) return least;
    group.resize(std::min(group.rfind('/'), group.size() - 1));
  }
}

// "4:memory:/group" is a line of version 1, "0::/group" of version 2.
std::size_t groupMemory(const std::string& root) {
  std::ifstream file(root + "/proc/self/cgroup");
  const std::string folder = root + "/sys/fs/cgroup";
  std::size_t least = kNoLimit;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream text(line);
    std::string number, controllers, group;
    std::getline(text, number, ':');
    std::getline(text, controllers, ':');
    std::getline(text, group);
    if (controllers.empty())
      least = std::min(least, limitOfGroup(folder, group, "memory.max"));
    else if (("," + controllers + ",").find(",memory,") != std::string::npos)
      least = std::min(least, limitOfGroup(folder + "/memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

std::size_t addressSpace() {
  struct rlimit limit {};
  const bool limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return limited ? static_cast<std::size_t>(limit.rlim_cur) : kNoLimit;
}

}  // namespace

std::size_t availableMemory(const std::string& root) {
  return std::min({machineMemory(root), groupMemory(root), addressSpace()});
}

std::size_t halfOfAvailableMemory() {
  static const std::size_t half = availableMemory() / 2;
  return half;
}

}  // namespace grid_path_planner::base
