#include "grid_path_planner/base/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
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

// From a newcomer, whose --output /dev/full became a file.
TEST(AtomicFile, APipeIsWrittenToAndNotReplaced) {
  const test::TemporaryFolder folder;
  const std::string pipe = folder.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  writeFileAtomically(pipe, "content");
  char read[16] = {};
  EXPECT_EQ(::read(reader, read, sizeof read), 7);
  EXPECT_EQ(std::string(read), "content");
  ::close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_EQ(folder.names(), (Names{"pipe"}));
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
