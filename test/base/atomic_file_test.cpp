#include "grid_path_planner/base/atomic_file.h"

#include <gtest/gtest.h>

#include "support/error_text.h"
#include "support/file_size_limit.h"
#include "support/temporary_folder.h"

namespace grid_path_planner {
namespace {

using test::contains;
using test::contentOf;
using test::errorText;
using test::refusedOnAFullDisk;

using Names = std::vector<std::string>;

TEST(AtomicFile, WritesAndOverwrites) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("a.yaml");
  writeFileAtomically(file, "first");
  EXPECT_EQ(contentOf(file), "first");
  writeFileAtomically(file, "second, longer");
  EXPECT_EQ(contentOf(file), "second, longer");
  EXPECT_EQ(folder.names(), (Names{"a.yaml"}));
}

TEST(AtomicFile, AFileForAParentIsNamed) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("parent", "x") + "/a.yaml";
  EXPECT_TRUE(contains(errorText([&] { writeFileAtomically(file, "text"); }),
                       "parent/a.yaml: cannot be written: Not a directory"));
  EXPECT_EQ(folder.names(), (Names{"parent"}));
}

TEST(AtomicFile, AFolderIsNotOverwritten) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(contains(errorText([&] { writeFileAtomically(folder.path("."), "text"); }),
                       "cannot be written"));
  EXPECT_EQ(folder.names(), Names{});
}

TEST(AtomicFile, OnAFullDiskTheOldFileStaysWholeAndNothingIsLeft) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("a.yaml", "the old one");
  const std::string large(100000, 'x');
  EXPECT_TRUE(refusedOnAFullDisk(4096, [&] { writeFileAtomically(file, large); }));
  EXPECT_EQ(contentOf(file), "the old one");
  EXPECT_EQ(folder.names(), (Names{"a.yaml"}));
  EXPECT_FALSE(refusedOnAFullDisk(1 << 20, [&] { writeFileAtomically(file, large); }));
  EXPECT_EQ(contentOf(file), large);
}

}  // namespace
}  // namespace grid_path_planner
