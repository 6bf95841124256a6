// A program that talks over its standard input and output. Whatever it does, a call of ours ends in time.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace grid_path_planner::flights {

class ProgramProcess {
 public:
  using Deadline = std::chrono::steady_clock::time_point;

  // Starts the program that the first word names. Throws InputError where that fails.
  explicit ProgramProcess(const std::vector<std::string>& program);
  ~ProgramProcess();  // ends the program
  ProgramProcess(const ProgramProcess&) = delete;
  ProgramProcess& operator=(const ProgramProcess&) = delete;

  // Both throw InputError where the program has ended, or is not done with it by the deadline.
  void send(const void* data, std::size_t size, Deadline deadline);
  std::string receiveLine(Deadline deadline);

 private:
  void await(int descriptor, short event, Deadline deadline) const;

  std::string name_;
  pid_t process_ = -1;
  int to_ = -1;
  int from_ = -1;
  std::string received_;
};

}  // namespace grid_path_planner::flights
