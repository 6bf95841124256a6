// Flights failed on a busy machine, where their world took more than 30 s by the clock to be read, though it
// takes 0.3 s of processor time: what a study says depended on what else ran beside it.
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "grid_path_planner/simulation/world.h"
#include "support/bounded_run.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::simulation {
namespace {

using base::ReadLimits;
using std::chrono::milliseconds;

constexpr int kMegabytes = 300;
constexpr int kEndless = 60000;  // corners, in whose square the time grows that cutting them takes

ReadLimits limitsOf(double seconds) {
  base::ReadOptions options;
  options.read_memory_limit = kMegabytes;
  options.read_time_limit = seconds;
  return ReadLimits::ofProcessorTime(options);
}

// The process that reads a world for this one, once it is that program; 0: there is none.
pid_t readerOfWorlds() {
  namespace fs = std::filesystem;
  for (const auto& thread : fs::directory_iterator("/proc/self/task")) {
    std::ifstream children(thread.path() / "children");
    for (pid_t child; children >> child;) {
      std::string name;
      std::ifstream("/proc/" + std::to_string(child) + "/comm") >> name;
      if (name == "read_world") return child;
    }
  }
  return 0;
}

// Stops the reader of worlds as soon as there is one, and lets it go on after a time.
class HeldReader {
 public:
  explicit HeldReader(milliseconds time) : thread_([this, time] { hold(time); }) {}
  ~HeldReader() {
    ended_ = true;
    thread_.join();
  }
  bool wasHeld() const { return held_; }

 private:
  void hold(milliseconds time) {
    pid_t reader = 0;
    while (!ended_ && (reader = readerOfWorlds()) == 0)
      std::this_thread::sleep_for(milliseconds(1));
    if (reader == 0) return;
    held_ = ::kill(reader, SIGSTOP) == 0;
    for (milliseconds held{0}; held < time && !ended_; held += milliseconds(10))
      std::this_thread::sleep_for(milliseconds(10));
    if (!ended_) ::kill(reader, SIGCONT);
  }

  std::atomic<bool> ended_{false}, held_{false};
  std::thread thread_;
};

class ProcessorTime : public testing::Test {
 protected:
  // A star.
  std::string worldOfCorners(int count) const {
    std::string obj, face = "f";
    for (int i = 0; i < count; ++i) {
      const double radius = i % 2 == 0 ? 1.0 : 1.5, angle = 2.0 * M_PI * i / count;
      obj += "v " + std::to_string(radius * std::cos(angle)) + " " +
             std::to_string(radius * std::sin(angle)) + " 0\n";
      face += " " + std::to_string(i + 1);
    }
    folder_.write("star.obj", obj + face + "\n");
    return folder_.write("star.sdf",
                         "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>"
                         "<visual name='v'><geometry><mesh><uri>star.obj</uri></mesh></geometry>"
                         "</visual></link></model></world></sdf>");
  }

  const test::TemporaryFolder folder_;
};

TEST_F(ProcessorTime, AReaderThatWaitsForTheProcessorIsWaitedFor) {
  const std::string file = worldOfCorners(3000);
  const HeldReader held(milliseconds(1200));
  EXPECT_EQ(readWorld(file, limitsOf(1.0)).visible().size(), 1u);
  EXPECT_TRUE(held.wasHeld());
}

TEST_F(ProcessorTime, AReaderThatComputesWithoutEndIsEnded) {
  const std::string file = worldOfCorners(kEndless);
  const test::BoundedRun run = test::runBounded([&] { readWorld(file, limitsOf(1.5)); });
  EXPECT_TRUE(test::contains(run.refusal, "read_time_limit")) << run;
  EXPECT_LT(run.cpu_seconds, 5.0) << run;
}

TEST_F(ProcessorTime, AReaderThatSleepsIsEnded) {
  const std::string file = worldOfCorners(kEndless);
  const HeldReader held(std::chrono::hours(1));
  const std::string text = test::errorText([&] { readWorld(file, limitsOf(0.02)); });
  EXPECT_TRUE(test::contains(text, "read_time_limit")) << text;
  EXPECT_TRUE(held.wasHeld());
  EXPECT_EQ(readerOfWorlds(), 0);
}

}  // namespace
}  // namespace grid_path_planner::simulation
