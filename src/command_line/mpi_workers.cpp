#include "command_line/mpi_workers.h"

#include <mpi.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <thread>

namespace grid_path_planner::command_line {

using study::ProcessPool, study::TaskEnd;

namespace {

constexpr int kTask = 1;    // rank 0 -> other: a number, or one of the two below
constexpr int kDone = 2;    // other -> rank 0: what the work returned
constexpr int kFailed = 3;  // other -> rank 0: why it failed
constexpr int kAlive = 4;   // other -> rank 0: still at it
constexpr std::uint64_t kNoMore = ~std::uint64_t{0};
constexpr std::uint64_t kNoMoreRankLost = kNoMore - 1;
constexpr int kPollMs = 5;
constexpr std::chrono::seconds kAliveEvery{2};
constexpr std::chrono::seconds kLostAfter{15};  // of silence

std::string receiveText(const MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  std::string text(static_cast<std::size_t>(size), '\0');
  MPI_Recv(&text[0], size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return text;
}

void send(const std::string& text, int to, int tag) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, tag, MPI_COMM_WORLD);
}

void sleepShortly() {
  std::this_thread::sleep_for(std::chrono::milliseconds(kPollMs));
}

// Whether a message of any tag from any rank has arrived.
bool waiting(MPI_Status& status) {
  int there = 0;
  const int result = MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  return result == MPI_SUCCESS && there != 0;
}

}  // namespace

bool startedByMpi() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
}

MpiSession::MpiSession() {
  MPI_Init(nullptr, nullptr);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);  // a lost rank is no reason to end
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
}

MpiSession::~MpiSession() {
  if (finalize_) MPI_Finalize();
}

void serveTasks(MpiSession& session, ProcessPool& pool) {
  for (;;) {
    MPI_Status status;
    // Not MPI_Recv, which would keep a core busy.
    for (; !waiting(status); sleepShortly()) continue;
    std::uint64_t task = kNoMore;
    MPI_Recv(&task, 1, MPI_UINT64_T, 0, kTask, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (task == kNoMoreRankLost) session.doNotFinalize();
    if (task >= kNoMoreRankLost) return;
    pool.start(task);
    for (std::vector<TaskEnd> ends; ends.empty();) {
      ends = pool.wait(static_cast<int>(std::chrono::milliseconds(kAliveEvery).count()));
      if (ends.empty())
        send("", 0, kAlive);
      else
        send(ends.front().text, 0, ends.front().failed ? kFailed : kDone);
    }
  }
}

MpiWorkers::MpiWorkers(MpiSession& session, ProcessPool& local) : session_(session), local_(local) {
  for (int rank = 1; rank < session.ranks(); ++rank) {
    Rank other;
    other.number = rank;
    others_.push_back(other);
  }
}

MpiWorkers::~MpiWorkers() {
  const bool lost =
      std::any_of(others_.begin(), others_.end(), [](const Rank& rank) { return rank.lost; });
  const std::uint64_t end = lost ? kNoMoreRankLost : kNoMore;
  for (const Rank& rank : others_)
    if (!rank.lost) MPI_Send(&end, 1, MPI_UINT64_T, rank.number, kTask, MPI_COMM_WORLD);
  if (lost) session_.doNotFinalize();
}

std::size_t MpiWorkers::idle() const {
  return local_.idle() + static_cast<std::size_t>(std::count_if(
                             others_.begin(), others_.end(),
                             [](const Rank& rank) { return !rank.busy && !rank.lost; }));
}

std::size_t MpiWorkers::busy() const {
  return local_.busy() +
         static_cast<std::size_t>(std::count_if(others_.begin(), others_.end(),
                                                [](const Rank& rank) { return rank.busy; }));
}

void MpiWorkers::start(std::size_t task) {
  const auto rank = std::find_if(others_.begin(), others_.end(),
                                 [](const Rank& other) { return !other.busy && !other.lost; });
  if (rank == others_.end()) {
    local_.start(task);
    return;
  }
  rank->busy = true;
  rank->task = task;
  rank->heard = Clock::now();
  const std::uint64_t number = task;
  MPI_Send(&number, 1, MPI_UINT64_T, rank->number, kTask, MPI_COMM_WORLD);
}

bool MpiWorkers::receive(std::vector<TaskEnd>& ends) {
  MPI_Status status;
  if (!waiting(status)) return false;
  Rank& rank = others_[static_cast<std::size_t>(status.MPI_SOURCE - 1)];
  rank.heard = Clock::now();
  const std::string text = receiveText(status);
  if (status.MPI_TAG == kAlive || rank.lost) return true;
  rank.busy = false;
  ends.push_back({rank.task, status.MPI_TAG == kFailed, text});
  return true;
}

void MpiWorkers::dropLostRanks(std::vector<TaskEnd>& ends) {
  for (Rank& rank : others_) {
    if (!rank.busy || Clock::now() - rank.heard < kLostAfter) continue;
    rank.busy = false;
    rank.lost = true;
    ends.push_back({rank.task, true, "rank " + std::to_string(rank.number) + " was lost"});
  }
}

std::vector<TaskEnd> MpiWorkers::wait(int milliseconds) {
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(milliseconds);
  std::vector<TaskEnd> ends;
  do {
    while (receive(ends)) continue;
    for (TaskEnd& local : local_.wait(local_.busy() > 0 ? kPollMs : 0)) ends.push_back(local);
    dropLostRanks(ends);
    if (ends.empty() && local_.busy() == 0) sleepShortly();
  } while (ends.empty() && busy() > 0 && Clock::now() < end);
  return ends;
}

}  // namespace grid_path_planner::command_line
