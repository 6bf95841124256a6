#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <vector>

#include "base/child_codes.h"
#include "base/child_process.h"

// Their shadow memory is larger than any limit.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GPP_WITH_SHADOW_MEMORY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
#define GPP_WITH_SHADOW_MEMORY
#endif
#endif

namespace grid_path_planner::base {
namespace {

enum Argument { PROGRAM, FILE_NAME, BYTES, SECONDS, PARENT, COUNT };

void limit(int resource, rlim_t most) {
  rlimit now{};
  ::getrlimit(resource, &now);
  now.rlim_cur = std::min(most, now.rlim_max);
  ::setrlimit(resource, &now);
}

void limitMemory([[maybe_unused]] rlim_t bytes) {
#ifndef GPP_WITH_SHADOW_MEMORY
  limit(RLIMIT_DATA, bytes);
#endif
  std::set_new_handler([] { ::_exit(kTooLarge); });
}

// What the parent had open without telling that its children should not.
void closeInherited(int kept) {
  std::vector<int> open;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", none))
    open.push_back(std::atoi(entry.path().filename().c_str()));
  for (const int descriptor : open)
    if (descriptor > STDERR_FILENO && descriptor != kept) ::close(descriptor);
}

// What the libraries print on the standard output goes to the standard error; the answer alone goes to
// the descriptor that is returned.
int takeOutput() {
  const int output = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  return output;
}

bool writeAnswer(int output, const std::string& answer) {
  for (std::size_t done = 0; done < answer.size();) {
    const ssize_t count = ::write(output, answer.data() + done, answer.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

int answer(int output, const std::string& file, const ChildWork& read) {
  constexpr std::size_t kLongestRefusal = 4000;
  try {
    return writeAnswer(output, read(file) + kWhole) ? kAnswered : kRefused;
  } catch (const std::bad_alloc&) {
    return kTooLarge;
  } catch (const std::exception& error) {
    const std::string text = error.what();
    writeAnswer(output, text.substr(0, kLongestRefusal));
    return kRefused;
  }
}

}  // namespace

int childMain(int argc, char** argv, const ChildWork& read) {
  if (argc != Argument::COUNT) {
    std::cerr << argv[PROGRAM] << " is started by other programs of grid_path_planner\n";
    return kRefused;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != std::atoi(argv[PARENT])) return kRefused;  // it is gone already
  const int output = takeOutput();
  closeInherited(output);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, std::strtoull(argv[SECONDS], nullptr, 10) + 1);
  limitMemory(std::strtoull(argv[BYTES], nullptr, 10));
  const int code = answer(output, argv[FILE_NAME], read);
  std::cout.flush();
  std::cerr.flush();
  ::_exit(code);  // the destructors of libraries have nothing to add
}

}  // namespace grid_path_planner::base
