// A damaged map file gives a map or an InputError: never a crash, another exception or a map that
// breaks the rules of maps. Meant to be run under the address and undefined behaviour sanitizers
// too.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "grid_path_planner/grid/map_file.h"
#include "support/error_text.h"
#include "support/mutation.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::grid {

using base::InputError;

namespace {

constexpr const char* kYaml =
    "# a site\nimage: a.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.5, 2.0, 0.25]\nnegate: "
    "0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

constexpr const char* kDump =
    "header: \n  seq: 3\n  stamp: \n    secs: 12\n    nsecs: 340000000\n  frame_id: \"map\"\n"
    "info: \n  map_load_time: {secs: 12, nsecs: 0}\n  resolution: 0.05000000074505806\n  width: 4\n"
    "  height: 3\n  origin: \n    position: {x: -1.5, y: 2.0, z: 0.0}\n    orientation: \n"
    "      x: 0.0\n      y: 0.0\n      z: 0.0\n      w: 1.0\n"
    "data: [0, 0, 100, -1, 0, 0, 50, 7, 0, -1, -1, 100]\n---\n";

class DamagedMapFile : public testing::Test {
 protected:
  DamagedMapFile() {
    for (std::int8_t& value : map_.values())
      value = std::array<std::int8_t, 3>{-1, 0, 100}[random_() % 3];
    writeImageFile(folder_.path("a.pgm"), map_);
  }

  // Reads `count` damaged copies of `content`, all of them as a file called `name`.
  void readDamaged(const std::string& name, const std::string& content, int count) {
    int maps = 0;
    for (int trial = 0; trial < count; ++trial)
      if (isGoodMap(name, test::mutated(content, random_))) ++maps;
    // Damage that nothing notices, or that everything dies of, would test nothing.
    EXPECT_GT(maps, 0);
    EXPECT_LT(maps, count);
  }
  void readEveryBeginning(const std::string& name, const std::string& content) {
    for (std::size_t size = 0; size < content.size(); ++size)
      isGoodMap(name, content.substr(0, size));
  }
  // False where the file was refused.
  bool isGoodMap(const std::string& name, const std::string& content) {
    const std::string file = folder_.write(name, content);
    try {
      const OccupancyGrid map = readMapFile(file);
      EXPECT_GT(map.values().size(), 0u);
      EXPECT_EQ(map.values().size(), map.geometry().size());
      EXPECT_EQ(test::errorText([&] { checkOccupancyValues(map); }), "");
      return true;
    } catch (const InputError& error) {
      EXPECT_TRUE(test::contains(error.what(), folder_.path(""))) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << " thrown for\n" << content;
    }
    return false;
  }
  std::string contentOf(const std::string& name) const {
    return test::contentOf(folder_.path(name));
  }

  const test::TemporaryFolder folder_;
  std::mt19937 random_{20261121};
  OccupancyGrid map_{GridGeometry(13, 9, 0.05)};
};

TEST_F(DamagedMapFile, MapServerYaml) {
  readDamaged("a.yaml", kYaml, 2000);
  readEveryBeginning("a.yaml", kYaml);
}

TEST_F(DamagedMapFile, RostopicDump) {
  readDamaged("a.txt", kDump, 2000);
  readEveryBeginning("a.txt", kDump);
}

TEST_F(DamagedMapFile, MovingAi) {
  writeMovingAiFile(folder_.path("b.map"), map_);
  const std::string content = contentOf("b.map");
  readDamaged("a.map", content, 2000);
  readEveryBeginning("a.map", content);
}

TEST_F(DamagedMapFile, Pgm) {
  const std::string content = contentOf("a.pgm");
  readDamaged("b.pgm", content, 1000);
  readEveryBeginning("b.pgm", content);
}

TEST_F(DamagedMapFile, Png) {
  writeImageFile(folder_.path("a.png"), map_);
  const std::string content = contentOf("a.png");
  readDamaged("b.png", content, 1000);
  readEveryBeginning("b.png", content);
}

TEST_F(DamagedMapFile, AnythingUnderAnyName) {
  writeMovingAiFile(folder_.path("b.map"), map_);
  const std::vector<std::string> contents = {kYaml, kDump, contentOf("b.map"), contentOf("a.pgm")};
  for (const char* name : {"c", "c.yaml", "c.map", "c.png", "c.tif", "c.bag"})
    for (const std::string& content : contents)
      for (int trial = 0; trial < 50; ++trial) isGoodMap(name, test::mutated(content, random_));
}

}  // namespace
}  // namespace grid_path_planner::grid
