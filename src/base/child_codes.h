// What a child that reads a file tells with its end (child_process.h).
#pragma once

namespace grid_path_planner::base {

constexpr int kAnswered = 0, kRefused = 1, kTooLarge = 3;

// The last byte of an answer: without it the answer was cut.
constexpr char kWhole = '\n';

}  // namespace grid_path_planner::base
