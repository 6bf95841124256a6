// A command of grid_path called as its main does, with what it printed.
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <string>
#include <vector>

#include "command_line/commands.h"

namespace grid_path_planner::command_line {

struct Outcome {
  int code = 0;
  std::string printed;  // on the standard output
  std::string error;    // of what it threw
};

// `arguments` begin with the command's name.
inline Outcome runCommand(int (*command)(int, char**), std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  Outcome outcome;
  testing::internal::CaptureStdout();
  try {
    outcome.code = command(static_cast<int>(argv.size()), argv.data());
  } catch (const std::exception& error) {
    outcome.code = kBadInput;
    outcome.error = error.what();
  }
  outcome.printed = testing::internal::GetCapturedStdout();
  return outcome;
}

}  // namespace grid_path_planner::command_line
