// A bar on a terminal for work that takes more than a second; nothing elsewhere.
#pragma once

#include <chrono>
#include <cstddef>

namespace grid_path_planner::command_line {

class ProgressBar {
 public:
  // Of `total` pieces of work, on the standard error.
  explicit ProgressBar(std::size_t total);
  ~ProgressBar();  // wipes the bar
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void done(std::size_t pieces);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::size_t pieces, double elapsed_s) const;

  std::size_t total_;
  bool on_terminal_;
  bool drawn_ = false;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_ + std::chrono::seconds(1);
};

}  // namespace grid_path_planner::command_line
