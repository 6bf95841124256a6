// Part of the base library in builds with the address and undefined behaviour sanitizers (scripts/sanitized_tests):
// where both are, GCC's libubsan leaves the log_path of UBSAN_OPTIONS to libasan, which keeps one for itself alone.
// Reports of undefined behaviour in nodes then went to whoever read the node's stderr, if anybody did.
#include <dlfcn.h>

#include <cstdlib>
#include <string>

namespace grid_path_planner::test {
namespace {

std::string logPath() {
  const char* options = std::getenv("UBSAN_OPTIONS");
  const std::string text = options ? options : "";
  const std::string key = "log_path=";
  const std::size_t found = text.find(key);
  if (found == std::string::npos) return {};
  const std::size_t begin = found + key.size();
  return text.substr(begin, text.find(':', begin) - begin);
}

__attribute__((constructor)) void nameReports() {
  const std::string path = logPath();
  void* runtime = dlopen("libubsan.so.1", RTLD_NOW | RTLD_NOLOAD);
  if (path.empty() || !runtime) return;
  const auto name =
      reinterpret_cast<void (*)(const char*)>(dlsym(runtime, "__sanitizer_set_report_path"));
  if (name) name(path.c_str());
}

}  // namespace
}  // namespace grid_path_planner::test
