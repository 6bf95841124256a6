#include "ros/guard/outgoing/unread_log.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

namespace grid_path_planner::nodes {
namespace {

constexpr int kKept = 1 << 20;  // bytes

bool isPipe(int file) {
  struct stat status = {};
  return ::fstat(file, &status) == 0 && S_ISFIFO(status.st_mode);
}

// Opened once more: whether writing waits belongs to what was opened, which
// others share.
void loseWhatIsUnread(int file) {
  if (!isPipe(file)) return;
  const std::string name = "/proc/self/fd/" + std::to_string(file);
  const int own = ::open(name.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  if (own < 0) return;
  ::fcntl(own, F_SETPIPE_SZ, kKept);
  ::dup2(own, file);
  ::close(own);
}

}  // namespace

void loseUnreadLog() {
  loseWhatIsUnread(STDOUT_FILENO);
  loseWhatIsUnread(STDERR_FILENO);
}

}  // namespace grid_path_planner::nodes
