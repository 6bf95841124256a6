// Around writes: a write beyond RLIMIT_FSIZE sends SIGXFSZ, which would end the process before the
// error is seen. While one of these lives, the calling thread gets EFBIG instead; other threads are
// left alone.
#pragma once

#include <pthread.h>
#include <signal.h>

#include <ctime>

namespace grid_path_planner {

class HoldFileSizeSignal {
 public:
  HoldFileSizeSignal() {
    sigemptyset(&held_);
    sigaddset(&held_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &held_, &before_);
  }
  ~HoldFileSizeSignal() {
    const timespec at_once{};
    while (sigtimedwait(&held_, nullptr, &at_once) > 0) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  HoldFileSizeSignal(const HoldFileSizeSignal&) = delete;
  HoldFileSizeSignal& operator=(const HoldFileSizeSignal&) = delete;

 private:
  sigset_t held_;
  sigset_t before_;
};

}  // namespace grid_path_planner
