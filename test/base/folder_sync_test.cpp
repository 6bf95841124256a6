// What is asked of the file system before a file counts as written: without the folder's fsync() a loss of power may undo the
// renaming, and the file that a node said it had saved is not there.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <functional>

#include "grid_path_planner/base/files.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace {

// What the next calls of fsync() in this program are seen by; it returns an error, or 0 for the call itself.
std::function<int(int descriptor)> seen_by;

}  // namespace

// In the place of the C library's: a program's own function goes before that of its libraries.
extern "C" int fsync(int descriptor) {
  const int error = seen_by ? seen_by(descriptor) : 0;
  if (error == 0) return static_cast<int>(::syscall(SYS_fsync, descriptor));
  errno = error;
  return -1;
}

namespace grid_path_planner::base {
namespace {

using test::contains, test::contentOf, test::errorText;

bool isFolder(int descriptor) {
  struct stat info {};
  return ::fstat(descriptor, &info) == 0 && S_ISDIR(info.st_mode);
}

class FolderSync : public testing::Test {
 protected:
  void TearDown() override { seen_by = nullptr; }
  std::string contentNow() const { return std::filesystem::exists(file_) ? contentOf(file_) : ""; }

  const test::TemporaryFolder folder_;
  const std::string file_ = folder_.path("map.yaml");
};

TEST_F(FolderSync, TheFileIsSyncedThenRenamedThenItsFolderIsSynced) {
  std::vector<std::string> calls;
  seen_by = [&](int descriptor) {
    struct stat synced {
    }, expected{};
    ::fstat(descriptor, &synced);
    ::stat(folder_.path("").c_str(), &expected);
    const bool ours = synced.st_ino == expected.st_ino && synced.st_dev == expected.st_dev;
    calls.push_back((isFolder(descriptor) ? ours ? "folder, " : "another folder, " : "file, ") +
                    contentNow());
    return 0;
  };
  writeFileAtomically(file_, "first");
  writeFileAtomically(file_, "second");
  EXPECT_EQ(calls,
            (std::vector<std::string>{"file, ", "folder, first", "file, first", "folder, second"}));
}

TEST_F(FolderSync, WhatCannotBeSyncedIsTold) {
  seen_by = [](int descriptor) { return isFolder(descriptor) ? EIO : 0; };
  const std::string error = errorText([&] { writeFileAtomically(file_, "first"); });
  EXPECT_TRUE(contains(error, file_ + ": is written, but a loss of power may undo that")) << error;
  EXPECT_TRUE(contains(error, "Input/output error")) << error;
  EXPECT_EQ(contentOf(file_), "first");
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"map.yaml"}));

  seen_by = [](int descriptor) { return isFolder(descriptor) ? 0 : EIO; };
  EXPECT_TRUE(contains(errorText([&] { writeFileAtomically(file_, "second"); }),
                       "cannot be written: Input/output"));
  EXPECT_EQ(contentOf(file_), "first") << "the old file stays";
}

TEST_F(FolderSync, AFileSystemThatCannotSyncIsWrittenAllTheSame) {
  for (const int error : {EINVAL, ENOTSUP, ENOSYS}) {
    seen_by = [error](int) { return error; };
    EXPECT_EQ(errorText([&] { writeFileAtomically(file_, std::to_string(error)); }), "");
    EXPECT_EQ(contentOf(file_), std::to_string(error));
  }
}

TEST_F(FolderSync, APartIsSyncedBeforeWhatNamesIt) {
  std::vector<std::string> folders;
  seen_by = [&](int descriptor) {
    if (isFolder(descriptor)) folders.push_back(contentNow());
    return 0;
  };
  writeFileWithPart(file_, "pgm", "picture", [](const std::string&) { return "text"; });
  EXPECT_EQ(folders, (std::vector<std::string>{"", "text"}));
}

}  // namespace
}  // namespace grid_path_planner::base
