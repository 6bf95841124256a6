#include "grid_path_planner/base/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <thread>
#include <utility>

#include "support/error_text.h"
#include "support/file_size_limit.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::base {
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

TEST(AtomicFile, ALinkStaysALink) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("a.yaml", "first"), link = folder.path("link.yaml");
  std::filesystem::create_symlink("a.yaml", link);
  writeFileAtomically(link, "second");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(contentOf(file), "second");
}

// A node that was told to read or write a pipe waited for its other end for ever, deaf to SIGTERM.
TEST(RegularFile, PipesAndDevicesAreRefusedAtOnce) {
  const test::TemporaryFolder folder;
  const std::string pipe = folder.path("pipe"), link = folder.path("link");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink("pipe", link);
  for (const std::string& file : {pipe, link, std::string("/dev/null"), std::string("/dev/full")}) {
    EXPECT_TRUE(contains(errorText([&] { readWholeFile(file, 100); }), file + ": is no regular"));
    EXPECT_TRUE(contains(errorText([&] { writeFileAtomically(file, "text"); }), "no regular file"));
  }
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_EQ(folder.names(), (Names{"link", "pipe"}));
}

TEST(AtomicFile, ModeAndOwnerStay) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("a.yaml", "first");
  ::chmod(file.c_str(), 0604);
  struct stat before {
  }, after{};
  ::stat(file.c_str(), &before);
  writeFileAtomically(file, "second");
  ::stat(file.c_str(), &after);
  EXPECT_EQ(contentOf(file), "second");
  EXPECT_EQ(after.st_mode, before.st_mode);
  EXPECT_EQ(after.st_uid, before.st_uid);
  EXPECT_EQ(after.st_gid, before.st_gid);
}

// a.yaml.tmp123_0 was a name that anyone could guess: a link planted there was written through.
TEST(AtomicFile, ThePlantedTemporaryNameIsNotWrittenThrough) {
  const test::TemporaryFolder folder;
  const std::string victim = folder.write("victim", "precious");
  const std::string planted = "a.yaml.tmp" + std::to_string(::getpid()) + "_";
  for (int i = 0; i < 200; ++i)
    std::filesystem::create_symlink("victim", folder.path(planted + std::to_string(i)));
  writeFileAtomically(folder.path("a.yaml"), "text");
  EXPECT_EQ(contentOf(victim), "precious");
  EXPECT_FALSE(std::filesystem::is_symlink(folder.path("a.yaml")));
}

// Every killed writer left a file for ever.
TEST(AtomicFile, WhatKilledWritersLeftIsRemovedAndWhatOthersStillWriteIsNot) {
  const test::TemporaryFolder folder;
  const std::string left = folder.write(".a.yaml.tmp0123456789abcdef", "half");
  const std::string held = folder.write(".a.yaml.tmp0123456789abcde0", "half");
  const std::string other = folder.write(".b.yaml.tmp0123456789abcdef", "half");
  const std::string similar = folder.write(".a.yaml.tmpl", "whole");
  const std::string link = folder.path(".a.yaml.tmp0123456789abcde1");
  std::filesystem::create_symlink(".a.yaml.tmpl", link);
  const int lock = ::open(held.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  writeFileAtomically(folder.path("a.yaml"), "text");
  ::close(lock);
  EXPECT_EQ(folder.names(), (Names{".a.yaml.tmp0123456789abcde0", ".a.yaml.tmp0123456789abcde1",
                                   ".a.yaml.tmpl", ".b.yaml.tmp0123456789abcdef", "a.yaml"}));
  EXPECT_EQ(std::filesystem::read_symlink(link), ".a.yaml.tmpl");
}

TEST(AtomicFile, TheLongestNameOfAFileSystemIsWritten) {
  const test::TemporaryFolder folder;
  const std::string name(255, 'a');
  writeFileAtomically(folder.path(name), "text");
  EXPECT_EQ(folder.names(), (Names{name}));
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

// Seen before: each map that was saved on a disk with room for its picture alone left that picture there.
TEST(AtomicFile, OnADiskWithRoomForThePartAloneItIsNotLeft) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("a.yaml");
  const auto text = [](const std::string& name) { return name + std::string(1000, ' '); };
  writeFileWithPart(file, "pgm", "the old picture", text);
  const std::string before = contentOf(file);
  const Names names = folder.names();
  const auto save = [&](const std::string& picture) {
    return refusedOnAFullDisk(100, [&] { writeFileWithPart(file, "pgm", picture, text); });
  };
  EXPECT_TRUE(save("another picture"));
  EXPECT_TRUE(save("the old picture"));
  EXPECT_EQ(folder.names(), names);
  EXPECT_EQ(contentOf(file), before);
}

// Nodelets of one process may all be asked to save to the same place.
TEST(AtomicFile, ThreadsThatWriteTheSameFileDoNotMeet) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("a.yaml");
  const auto writeOften = [&file](char letter, std::string& error) {
    for (int i = 0; i < 100 && error.empty(); ++i)
      error = errorText([&] { writeFileAtomically(file, std::string(50000, letter)); });
  };
  std::string error_of_a, error_of_b;
  std::thread a([&] { writeOften('a', error_of_a); }), b([&] { writeOften('b', error_of_b); });
  a.join();
  b.join();
  EXPECT_EQ(error_of_a, "");
  EXPECT_EQ(error_of_b, "");
  const std::string content = contentOf(file);
  EXPECT_EQ(content, std::string(50000, content.at(0)));
  EXPECT_EQ(folder.names(), (Names{"a.yaml"}));
}

TEST(AtomicFile, WhatAProcessDoesAboutSignalsIsLeftAsItWas) {
  const auto setup = [] {
    struct sigaction action = {};
    sigset_t blocked;
    sigaction(SIGXFSZ, nullptr, &action);
    pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
    return std::make_pair(action.sa_handler, sigismember(&blocked, SIGXFSZ));
  };
  const test::TemporaryFolder folder;
  const auto before = setup();
  writeFileAtomically(folder.path("a.yaml"), "text");
  EXPECT_EQ(setup(), before);
}

}  // namespace
}  // namespace grid_path_planner::base
