// A library for LD_PRELOAD: who opens the file HELD_FILE waits until there is a file of that name with ".goes_on" behind it.
// That somebody waits is said by one with ".waits".
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdarg>
#include <cstdlib>
#include <string>

namespace grid_path_planner::test {
namespace {

using Open = int (*)(const char*, int, ...);

void waitWhereHeld(Open open, const std::string& name) {
  const char* const held = std::getenv("HELD_FILE");
  if (held == nullptr || name != held) return;
  ::close(open((name + ".waits").c_str(), O_CREAT | O_WRONLY, 0600));
  while (::access((name + ".goes_on").c_str(), F_OK) != 0) ::usleep(10000);
}

}  // namespace
}  // namespace grid_path_planner::test

extern "C" int open(const char* name, int flags, ...) {
  using grid_path_planner::test::Open;
  static const auto call = reinterpret_cast<Open>(::dlsym(RTLD_NEXT, "open"));
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  grid_path_planner::test::waitWhereHeld(call, name);
  return call(name, flags, mode);
}
