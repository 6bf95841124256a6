// The ranks of an MPI run as workers of a study.
//
// Rank 0 hands out the tasks and does some itself; every other rank serves until rank 0 has no
// more. A rank does its tasks in a child process, so that a crash fails the task and not the rank.
// A rank that is itself lost is noticed by its silence and its task fails, if the launcher lets the
// others live (mpirun --enable-recovery).
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/study/process_pool.h"

namespace grid_path_planner::command_line {

// Whether this process was started by an MPI launcher.
bool startedByMpi();

// MPI from its construction to its destruction. Make the process pool first: its children must not
// hold what MPI opens.
class MpiSession {
 public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }

  // Ends without MPI_Finalize, which may wait for ever for a rank that was lost.
  void doNotFinalize() { finalize_ = false; }

 private:
  int rank_ = 0;
  int ranks_ = 1;
  bool finalize_ = true;
};

// What ranks other than 0 do: tasks by `pool`, until rank 0 says that there are no more.
void serveTasks(MpiSession& session, study::ProcessPool& pool);

// On rank 0.
class MpiWorkers : public study::WorkerGroup {
 public:
  MpiWorkers(MpiSession& session, study::ProcessPool& local);
  ~MpiWorkers() override;  // tells the others to end

  std::size_t idle() const override;
  std::size_t busy() const override;
  void start(std::size_t task) override;
  std::vector<study::TaskEnd> wait(int milliseconds) override;

 private:
  using Clock = std::chrono::steady_clock;
  struct Rank {
    int number = 0;
    bool busy = false;
    bool lost = false;
    std::size_t task = 0;
    Clock::time_point heard;
  };

  bool receive(std::vector<study::TaskEnd>& ends);
  void dropLostRanks(std::vector<study::TaskEnd>& ends);

  MpiSession& session_;
  study::ProcessPool& local_;
  std::vector<Rank> others_;
};

}  // namespace grid_path_planner::command_line
