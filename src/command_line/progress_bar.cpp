#include "command_line/progress_bar.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace grid_path_planner::command_line {

ProgressBar::ProgressBar(std::size_t total)
    : total_(total), on_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
}

void ProgressBar::done(std::size_t pieces) {
  const Clock::time_point now = Clock::now();
  if (!on_terminal_ || now < next_ || pieces == 0) return;
  next_ = now + std::chrono::milliseconds(200);
  drawn_ = true;
  draw(pieces, std::chrono::duration<double>(now - begin_).count());
}

void ProgressBar::draw(std::size_t pieces, double elapsed_s) const {
  constexpr std::size_t kWidth = 40;
  const std::size_t filled = kWidth * pieces / total_;
  const double left_s =
      elapsed_s * static_cast<double>(total_ - pieces) / static_cast<double>(pieces);
  std::fprintf(stderr, "\r[%s%s] %zu/%zu, %.0f s left\033[K", std::string(filled, '=').c_str(),
               std::string(kWidth - filled, ' ').c_str(), pieces, total_, left_s);
  std::fflush(stderr);
}

}  // namespace grid_path_planner::command_line
