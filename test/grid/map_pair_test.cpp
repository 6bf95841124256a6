// A map_server map is two files. They were two renames: of 100 writers that were killed, 20 left the
// YAML of one map with the image of another, and with two writers every sixth reading mixed them, all
// accepted in silence.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/grid/map_file.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::grid {
namespace {

using test::contains;
using test::errorText;

// Of 8 maps: size, values and resolution tell which.
OccupancyGrid mapOf(int number) {
  OccupancyGrid map(GridGeometry(60 + number, 40, 0.05 * (number + 1)), 0);
  for (int cell = 0; cell < 40; ++cell) map[{cell, cell}] = (number >> cell % 3 & 1) == 0 ? 0 : 100;
  return map;
}

// -1 for a mixture.
int numberOf(const OccupancyGrid& map) {
  for (int number = 0; number < 8; ++number)
    if (map == mapOf(number)) return number;
  return -1;
}

[[noreturn]] void writeForEver(const std::string& file, int first) {
  for (int i = first;; i = (i + 2) % 8) writeMapServerFile(file, mapOf(i));
}

// GPP_LONG_STORM: a thousand kills and ten thousand readings.
int times(int few, int many) {
  return std::getenv("GPP_LONG_STORM") ? many : few;
}

class Child {
 public:
  template <class Action>
  explicit Child(const Action& action) : pid_(::fork()) {
    if (pid_ == 0) action();
  }
  ~Child() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

 private:
  pid_t pid_;
};

TEST(MapPair, WritersThatAreKilledLeaveNoMixture) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("site.yaml");
  writeMapServerFile(file, mapOf(0));
  std::mt19937 random(18);
  std::uniform_int_distribution<int> delay(0, 8000);
  for (int i = 0; i < times(40, 1000); ++i) {
    {
      const Child writer([&] { writeForEver(file, i % 8); });
      std::this_thread::sleep_for(std::chrono::microseconds(1000 + delay(random)));
    }
    ASSERT_NE(numberOf(readMapFile(file)), -1) << "kill " << i;
  }
  writeMapServerFile(file, mapOf(7));
  const auto images = folder.endings();
  EXPECT_EQ(numberOf(readMapFile(file)), 7);
  writeMapServerFile(file, mapOf(6));
  EXPECT_EQ(folder.endings().back(), ".yaml");
  EXPECT_EQ(std::count(images.begin(), images.end(), ".pgm"), 1) << "older images are removed";
}

TEST(MapPair, AReaderBetweenTwoWritersGetsOneMapOrTheOther) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("site.yaml");
  writeMapServerFile(file, mapOf(0));
  const Child even([&] { writeForEver(file, 0); }), odd([&] { writeForEver(file, 1); });
  for (int i = 0; i < times(400, 10000); ++i)
    ASSERT_NE(numberOf(readMapFile(file)), -1) << "reading " << i;
}

TEST(MapPair, TheImagesNameIsOfItsContentAndItLiesBesideTheFile) {
  const test::TemporaryFolder folder;
  writeMapServerFile(folder.path("a.yaml"), mapOf(3));
  writeMapServerFile(folder.path("a-b.yaml"), mapOf(3));
  const auto names = folder.names();
  ASSERT_EQ(names.size(), 4u);
  EXPECT_TRUE(contains(test::contentOf(folder.path("a.yaml")), "image: a-"))
      << "as map_server does";
  for (const std::string& name : names)
    if (contains(name, ".pgm"))
      EXPECT_EQ(base::partState(name, test::contentOf(folder.path(name))),
                base::PartState::AS_WRITTEN);
  writeMapServerFile(folder.path("a.yaml"), mapOf(4));
  EXPECT_EQ(readMapFile(folder.path("a-b.yaml")), mapOf(3)) << "another file's image stays";
}

// site.yaml and site.yml share the beginning of their images' names: writing the one removed the image of the
// other, which any client of ~save_map could ask for, and a copy of the YAML lost its image as well.
TEST(MapPair, AnImageThatAnotherFileNamesIsNotRemoved) {
  const test::TemporaryFolder folder;
  writeMapServerFile(folder.path("site.yaml"), mapOf(1));
  folder.write("kept.yaml", test::contentOf(folder.path("site.yaml")));
  writeMapServerFile(folder.path("site.yml"), mapOf(2));
  EXPECT_EQ(readMapFile(folder.path("site.yaml")), mapOf(1));
  writeMapServerFile(folder.path("site.yaml"), mapOf(3));
  EXPECT_EQ(readMapFile(folder.path("kept.yaml")), mapOf(1));
  EXPECT_EQ(readMapFile(folder.path("site.yml")), mapOf(2));
  EXPECT_EQ(readMapFile(folder.path("site.yaml")), mapOf(3));
}

// The YAML was written behind the link, and its image beside the link.
TEST(MapPair, BothFilesLieWhereALinkLeadsTo) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("maps"));
  writeMapServerFile(folder.path("maps/site.yaml"), mapOf(1));
  std::filesystem::create_symlink("maps/site.yaml", folder.path("latest.yaml"));
  writeMapServerFile(folder.path("latest.yaml"), mapOf(2));
  EXPECT_EQ(readMapFile(folder.path("maps/site.yaml")), mapOf(2));
  EXPECT_EQ(folder.names().size(), 2u) << "the folder and the link";
}

// A reader found the image gone and the YAML as it had been: two writers took turns with the same maps,
// and one had put the reader's back meanwhile. It gave up, as if the image had been missing all along.
TEST(MapPair, AMapThatWasReplacedByOneOfTheSameContentIsReadAgain) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("a.yaml");
  writeMapServerFile(file, mapOf(0));
  const std::string yaml = test::contentOf(file);
  int tries = 0;
  MapFileOptions options;
  options.resolution = 1.0;                 // is warned about before the image is read
  options.warn = [&](const std::string&) {  // between YAML and image, in the place of other writers
    writeMapServerFile(file, mapOf(++tries == 1 ? 1 : 0));
    if (tries == 1) base::writeFileAtomically(file, yaml);
  };
  EXPECT_EQ(readMapFile(file, options).width(), mapOf(0).width());
  EXPECT_EQ(tries, 2);
}

// People paint walls into the images of their maps.
TEST(MapPair, AnImageThatSomebodyChangedIsReadWithAWarningAndNotRemoved) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("a.yaml");
  writeMapServerFile(file, mapOf(3));
  const std::string image = folder.names().front();
  std::string content = test::contentOf(folder.path(image));
  content.back() = 0;
  folder.write(image, content);
  MapFileOptions options;
  std::string warning;
  options.warn = [&](const std::string& text) { warning += text; };
  EXPECT_EQ((readMapFile(file, options)[{mapOf(3).width() - 1, 0}]), 100);
  EXPECT_TRUE(contains(warning, "was changed since it was written")) << warning;
  writeMapServerFile(file, mapOf(4));
  EXPECT_EQ(test::contentOf(folder.path(image)), content);
}

}  // namespace
}  // namespace grid_path_planner::grid
