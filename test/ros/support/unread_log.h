// Programs whose log nobody reads, for rostests.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace grid_path_planner::test {

// The command with stdout and stderr in a socket that is open and never read: once it is full, who logs waits, as
// nothing can be done about it (ros/guard/outgoing/unread_log.h does for pipes).
inline std::vector<std::string> withUnreadSocket(const std::vector<std::string>& command) {
  std::vector<std::string> all{"python3", "-c",
                               "import os, socket, sys\n"
                               "kept, log = socket.socketpair()\n"
                               "os.set_inheritable(kept.fileno(), True)\n"
                               "os.dup2(log.fileno(), 1)\n"
                               "os.dup2(log.fileno(), 2)\n"
                               "os.execvp(sys.argv[1], sys.argv[1:])\n"};
  all.insert(all.end(), command.begin(), command.end());
  return all;
}

// The command with stdout and stderr in a pipe of this name that is open and never read.
inline std::vector<std::string> withUnreadPipe(const std::string& pipe,
                                               const std::vector<std::string>& command) {
  std::vector<std::string> all{"bash", "-c", R"(mkfifo "$0"; exec 3<>"$0"; exec "$@" >&3 2>&3)",
                               pipe};
  all.insert(all.end(), command.begin(), command.end());
  return all;
}

// Until it takes no more.
inline void fillPipe(const std::string& pipe) {
  const int file = ::open(pipe.c_str(), O_WRONLY | O_NONBLOCK);
  const std::string text(4096, 'x');
  while (file >= 0 && ::write(file, text.data(), text.size()) > 0) {
  }
  ::close(file);
}

}  // namespace grid_path_planner::test
