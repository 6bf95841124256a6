// Worlds and meshes that ask for gigabytes, end the process that reads them, or never end: each becomes
// a sentence, and this process takes no harm.
#include <dirent.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <thread>

#include "grid_path_planner/simulation/world.h"
#include "support/bombs.h"
#include "support/bounded_run.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::simulation {
namespace {

using test::BoundedRun;
using test::contains;
using test::errorText;
using test::repeated;

constexpr int kMegabytes = 300;  // of the limit

std::string worldOf(const std::string& content) {
  return "<sdf version='1.6'><world name='w'>" + content + "</world></sdf>";
}

std::string modelWith(const std::string& shapes) {
  return "<model name='m'><static>1</static><link name='l'>" + shapes + "</link></model>";
}

std::string visualOf(const std::string& name, const std::string& geometry) {
  return "<visual name='" + name + "'><geometry>" + geometry + "</geometry></visual>";
}

std::string meshVisual(const std::string& name, const std::string& uri) {
  return visualOf(name, "<mesh><uri>" + uri + "</uri></mesh>");
}

int openDescriptors() {
  int count = 0;
  DIR* folder = ::opendir("/proc/self/fd");
  while (::readdir(folder) != nullptr) ++count;
  ::closedir(folder);
  return count;
}

class WorldBombs : public testing::Test {
 protected:
  BoundedRun reading(
      const std::string& content, double seconds = 10.0, void (*before)() = [] {}) const {
    const std::string file = folder_.write("bomb.sdf", content);
    base::ReadOptions options;
    options.read_memory_limit = kMegabytes;
    options.read_time_limit = seconds;
    return test::runBounded([&] {
      before();
      readWorld(file, options);
    });
  }
  // In whoever reads: a signal that ends it is no report of a sanitizer.
  static void endBySignals() {
    for (const char* tool : {"ASAN_OPTIONS", "TSAN_OPTIONS"}) {
      const char* options = std::getenv(tool);
      ::setenv(tool, (std::string(options ? options : "") + ":handle_segv=0").c_str(), 1);
    }
  }
  // Answered or refused by name, and this process is as large as it was.
  static void expectBounded(const BoundedRun& run) {
    EXPECT_TRUE(run.ended) << run;
    EXPECT_TRUE(run.refusal.empty() || contains(run.refusal, "bomb.sdf")) << run;
    EXPECT_LT(run.megabytes, kMegabytes) << run;
    EXPECT_LT(run.cpu_seconds, 30.0) << run;
  }
  // Nobody waits for a child of this process any more, and no pipe is left open.
  static void expectNothingLeft(int descriptors) {
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
    EXPECT_EQ(openDescriptors(), descriptors);
  }

  const test::TemporaryFolder folder_;
};

TEST_F(WorldBombs, AMeshThatIsNamedAThousandTimesIsRefused) {
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", visuals;
  for (int i = 0; i < 30000; ++i)
    obj += "v " + std::to_string(i) + " 1 2\nf 1 2 " + std::to_string(i + 4) + "\n";
  folder_.write("rock.obj", obj);
  for (int i = 0; i < 1000; ++i) visuals += meshVisual("v" + std::to_string(i), "rock.obj");
  const BoundedRun run = reading(worldOf(modelWith(visuals)));
  expectBounded(run);
  EXPECT_TRUE(contains(run.refusal, "read_") || test::hasShadowMemory()) << run;
}

TEST_F(WorldBombs, AMeshFileThatTakesTooMuchIsRefused) {
  folder_.write("faces.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + repeated("f 1 2 3\n", 1200000));
  const BoundedRun run = reading(worldOf(modelWith(meshVisual("v", "faces.obj"))));
  expectBounded(run);
  EXPECT_TRUE(contains(run.refusal, "read_") || test::hasShadowMemory()) << run;
}

TEST_F(WorldBombs, ColladaWhoseCountsLieIsRefused) {
  folder_.write(
      "count.dae",
      "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
      "version='1.4.1'><library_geometries><geometry id='g'><mesh><source id='s'>"
      "<float_array id='a' count='4000000000'>0 0 0</float_array></source></mesh>"
      "</geometry></library_geometries></COLLADA>");
  const BoundedRun run = reading(worldOf(modelWith(meshVisual("v", "count.dae"))));
  expectBounded(run);
  EXPECT_NE(run.refusal, "");
}

// Found by the fuzzer: an array without a count leaves the library without a pointer that it follows.
TEST_F(WorldBombs, AMeshThatEndsTheLibrarysProcessIsRefused) {
  folder_.write(
      "uncounted.dae",
      "<?xml version='1.0'?><COLLADA version='1.4.1'><library_geometries><geometry id='g'><mesh>"
      "<source id='p'><float_array id='a'>0 0 0 1 0 0 0 1 0</float_array>"
      "<technique_common><accessor source='#a' count='3' stride='3'/></technique_common></source>"
      "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles count='1'>"
      "<input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles></mesh></geometry>"
      "</library_geometries><library_visual_scenes><visual_scene id='s'><node>"
      "<instance_geometry url='#g'/></node></visual_scene></library_visual_scenes>"
      "<scene><instance_visual_scene url='#s'/></scene></COLLADA>");
  const BoundedRun run =
      reading(worldOf(modelWith(meshVisual("v", "uncounted.dae"))), 10.0, endBySignals);
  expectBounded(run);
  EXPECT_NE(run.refusal, "") << run;
}

TEST_F(WorldBombs, BinaryMeshesWhoseCountsLieAreRefused) {
  folder_.write("count.stl", std::string(80, ' ') + "\xff\xff\xff\x7f" + std::string(50, '\0'));
  folder_.write(
      "count.ply",
      "ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\nproperty float "
      "y\nproperty float z\nend_header\n0 0 0\n");
  for (const char* name : {"count.stl", "count.ply"}) {
    const BoundedRun run = reading(worldOf(modelWith(meshVisual("v", name))));
    expectBounded(run);
    EXPECT_NE(run.refusal, "") << name;
  }
}

TEST_F(WorldBombs, ElementsNestedWithoutEndAreRefused) {
  const BoundedRun run = reading(worldOf(repeated("<model name='m'>", 100000)));
  expectBounded(run);
  EXPECT_NE(run.refusal, "");
}

TEST_F(WorldBombs, AWorldThatIncludesItselfIsRefused) {
  const BoundedRun run = reading(worldOf("<include><uri>bomb.sdf</uri></include>"));
  expectBounded(run);
  EXPECT_NE(run.refusal, "");
}

TEST_F(WorldBombs, AWorldOfMoreThanTheTimeAllowsIsRefused) {
  std::string models;
  for (int i = 0; i < 20000; ++i)
    models += "<model name='m" + std::to_string(i) + "'><link name='l'>" +
              visualOf("v", "<sphere><radius>1</radius></sphere>") + "</link></model>";
  const BoundedRun run = reading(worldOf(models), 2.0);
  expectBounded(run);
  EXPECT_TRUE(contains(run.refusal, "read_")) << run;
}

TEST_F(WorldBombs, NeitherProcessesNorDescriptorsAreLeft) {
  const std::string good =
      folder_.write("good.sdf", worldOf(modelWith(visualOf("v", "<box><size>1 1 1</size></box>"))));
  const std::string bad = folder_.write("bad.sdf", "<sdf");
  base::ReadOptions short_time;
  short_time.read_time_limit = 0.01;
  readWorld(good);
  const int descriptors = openDescriptors();
  readWorld(good);
  EXPECT_NE(errorText([&] { readWorld(bad); }), "");
  EXPECT_TRUE(contains(errorText([&] { readWorld(good, short_time); }), "read_time_limit"));
  expectNothingLeft(descriptors);
}

TEST_F(WorldBombs, AReadingThatIsCancelledEndsAtOnceAndLeavesNothing) {
  const std::string file = folder_.write(
      "slow.sdf",
      worldOf(modelWith(repeated(visualOf("v", "<box><size>1 1 1</size></box>"), 50000))));
  const int descriptors = openDescriptors();
  base::StopSource stop;
  std::thread canceller([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.cancel();
  });
  const std::string text = errorText([&] { readWorld(file, {base::ReadOptions(), stop.token()}); });
  canceller.join();
  EXPECT_TRUE(contains(text, "cancelled")) << text;
  expectNothingLeft(descriptors);
}

// A nodelet manager reads in one thread and makes whatever it makes in others.
TEST_F(WorldBombs, SeveralThreadsReadAtTheSameTime) {
  const std::string file =
      folder_.write("good.sdf", worldOf(modelWith(visualOf("v", "<box><size>1 1 1</size></box>"))));
  std::vector<std::thread> threads;
  std::atomic<int> read{0};
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] { read += readWorld(file).visible().size() == 1 ? 1 : 0; });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(read, 4);
}

}  // namespace
}  // namespace grid_path_planner::simulation
