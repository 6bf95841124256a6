// Any ROS client could have any file of the user written: path_planner's ~save_waypoints wrote a
// plan of the client's making onto a shell's start-up file. Names from others lie below a folder.
#include "ros/guard/file_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <random>

#include "ros/messages/file_kinds.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

namespace fs = std::filesystem;
using base::writeFileAtomically;
using test::contains;
using test::contentOf;
using test::errorText;

constexpr char kWaypoints[] = "waypoints:\n  - a\n";
constexpr char kOtherYaml[] = "password: secret\n";

// save/ is the folder; what lies beside it must stay as it is.
class FileFolderTest : public testing::Test {
 protected:
  FileFolderTest() : folder_(path("save"), "--save-folder") {
    for (const char* name :
         {"save/sub", "save/.dots", "save/folder.yaml", "outside", "savesibling"})
      fs::create_directories(path(name));
    for (const char* name : {"save/ours.yaml", "save/sub/ours.yaml", "save/.hidden.yaml",
                             "save/.dots/a.yaml", "outside/ours.yaml", "savesibling/ours.yaml"})
      files_.write(name, kWaypoints);
    for (const char* name : {"save/other.yaml", "save/bashrc", "outside/.bashrc"})
      files_.write(name, kOtherYaml);
    files_.write("save/empty.yaml", "");
    ::mkfifo(path("save/fifo.yaml").c_str(), 0600);
    link("../outside/ours.yaml", "save/out.yaml");
    link("../outside/.bashrc", "save/bashrc.yaml");
    link("../outside/new.yaml", "save/dangling.yaml");
    link("../outside", "save/outside");
    link("/", "save/root");
    link("/dev/null", "save/null.yaml");
    link("loop.yaml", "save/loop.yaml");
    link("ours.yaml", "save/in.yaml");
    link("sub", "save/inside");
    link(".dots", "save/dots");
    link(".hidden.yaml", "save/hidden.yaml");
  }

  std::string path(const std::string& name) const { return files_.path(name); }
  void link(const std::string& target, const std::string& name) const {
    fs::create_symlink(target, path(name));
  }
  void save(const std::string& name, const std::string& content = kWaypoints) const {
    writeFileAtomically(folder_.place(name, waypointFiles()), content);
  }
  std::string whyNotSaved(const std::string& name) const {
    return errorText([&] { save(name); });
  }
  std::string whyNotFound(const std::string& name) const {
    return errorText([&] { folder_.find(name, waypointFiles()); });
  }

  // Everything that no writing may touch, with what would show that it was.
  std::map<std::string, std::string> untouchable() const {
    std::map<std::string, std::string> found;
    addUntouchable(fs::canonical(path(".")), found);
    return found;
  }
  void addUntouchable(const fs::path& place, std::map<std::string, std::string>& found) const {
    for (const auto& entry : fs::directory_iterator(place)) {
      struct stat info {};
      ::lstat(entry.path().c_str(), &info);
      if (S_ISDIR(info.st_mode)) addUntouchable(entry.path(), found);
      const std::string content = S_ISREG(info.st_mode) ? contentOf(entry.path()) : "";
      const bool below_it = contains(entry.path(), "/save/") && !contains(entry.path(), "/.");
      if (below_it && content == kWaypoints) continue;
      found[entry.path()] =
          std::to_string(info.st_ino) + " " + std::to_string(info.st_mode) + " " + content;
    }
  }

  test::TemporaryFolder files_;
  FileFolder folder_;
};

TEST_F(FileFolderTest, FilesBelowItAreReadAndWritten) {
  for (const char* name :
       {"new.yaml", "ours.yaml", "sub/new.yml", "inside/ours.yaml", "a b-c.1.yaml"}) {
    save(name);
    EXPECT_EQ(contentOf(folder_.find(name, waypointFiles())), kWaypoints) << name;
  }
  save(path("save/absolute.yaml"));
  EXPECT_EQ(contentOf(path("save/absolute.yaml")), kWaypoints);
}

TEST_F(FileFolderTest, ALinkInsideIsFollowedAndStays) {
  save("in.yaml", "waypoints: [new]\n");
  EXPECT_TRUE(fs::is_symlink(path("save/in.yaml")));
  EXPECT_EQ(contentOf(path("save/ours.yaml")), "waypoints: [new]\n");
  EXPECT_EQ(folder_.find("in.yaml", waypointFiles()), fs::canonical(path("save/ours.yaml")));
}

TEST_F(FileFolderTest, WhatLiesElsewhereIsRefused) {
  const auto before = untouchable();
  for (const std::string& name :
       {std::string("../outside/ours.yaml"), std::string("sub/../../outside/new.yaml"),
        path("outside/ours.yaml"), path("savesibling/ours.yaml"), path("save/../outside/ours.yaml"),
        std::string("/etc/new.yaml"), std::string("out.yaml"), std::string("bashrc.yaml"),
        std::string("dangling.yaml"), std::string("outside/ours.yaml"),
        std::string("outside/n.yaml"), "root" + path("outside/ours.yaml"), std::string("null.yaml"),
        std::string("loop.yaml"), std::string("root/dev/shm/n.yaml")}) {
    EXPECT_NE(whyNotSaved(name), "") << name;
    EXPECT_NE(whyNotFound(name), "") << name;
  }
  EXPECT_EQ(untouchable(), before);
  EXPECT_EQ(whyNotSaved("/etc/new.yaml"),
            "the waypoint file '/etc/new.yaml' is refused: it does not lie below " + path("save") +
                " (--save-folder)");
}

// Whether ../outside/x is there is nobody's business.
TEST_F(FileFolderTest, TheAnswerDoesNotTellWhatThereIsElsewhere) {
  const auto withoutName = [](std::string text, const std::string& name) {
    return text.replace(text.find(name), name.size(), "NAME");
  };
  for (const std::string& there :
       {path("outside/ours.yaml"), std::string("../outside/ours.yaml")}) {
    const std::string absent = there + "/no/such.yaml";
    EXPECT_EQ(withoutName(whyNotFound(there), there), withoutName(whyNotFound(absent), absent));
  }
}

TEST_F(FileFolderTest, OnlyRegularFilesOfTheKindAreOverwritten) {
  const auto before = untouchable();
  EXPECT_TRUE(contains(whyNotSaved("other.yaml"), "is no waypoint file, and is not overwritten"));
  EXPECT_TRUE(contains(whyNotSaved("empty.yaml"), "is no waypoint file"));
  EXPECT_TRUE(contains(whyNotSaved("fifo.yaml"), "is no regular file"));
  EXPECT_TRUE(contains(whyNotSaved("folder.yaml"), "is no regular file"));
  EXPECT_TRUE(contains(whyNotSaved("bashrc"), "must end in .yaml, .yml"));
  for (const char* name : {".hidden.yaml", ".new.yaml", ".dots/a.yaml", ".dots/new.yaml",
                           "dots/new.yaml", "hidden.yaml", "./ours.yaml", ".yaml"})
    EXPECT_TRUE(contains(whyNotSaved(name), "begins with a dot")) << whyNotSaved(name);
  EXPECT_EQ(untouchable(), before);
  for (const char* name : {"other.yaml", "empty.yaml", "fifo.yaml", "bashrc"})
    EXPECT_FALSE(contains(whyNotSaved(name) + whyNotFound(name), "secret"));
}

TEST_F(FileFolderTest, NamesThatAreNoNamesAreRefused) {
  EXPECT_NE(whyNotSaved(""), "");
  EXPECT_NE(whyNotSaved("/"), "");
  EXPECT_NE(whyNotSaved("sub/"), "");
  EXPECT_NE(whyNotSaved(path("save")), "");
  EXPECT_NE(whyNotSaved("no/such/folder.yaml"), "");
  EXPECT_TRUE(contains(whyNotSaved(std::string("bashrc\0.yaml", 12)), "control characters"));
  EXPECT_TRUE(contains(whyNotSaved("$(reboot).yaml"), "dollar signs"));
  EXPECT_TRUE(contains(whyNotSaved(std::string(256, 'a') + ".yaml"), "too long"));
  EXPECT_TRUE(contains(whyNotSaved(std::string(100000, 'a') + ".yaml"), "at most"));
}

TEST_F(FileFolderTest, ModeAndOwnerOfAnOverwrittenFileStay) {
  ::chmod(path("save/ours.yaml").c_str(), 0640);
  struct stat before {
  }, after{};
  if (::geteuid() == 0) {
    ASSERT_EQ(::chown(path("save/ours.yaml").c_str(), 12345, 54321), 0);
  }
  ::stat(path("save/ours.yaml").c_str(), &before);
  save("ours.yaml", "waypoints: [new]\n");
  ::stat(path("save/ours.yaml").c_str(), &after);
  EXPECT_EQ(contentOf(path("save/ours.yaml")), "waypoints: [new]\n");
  EXPECT_EQ(after.st_mode, before.st_mode);
  EXPECT_EQ(after.st_uid, before.st_uid);
  EXPECT_EQ(after.st_gid, before.st_gid);
}

TEST_F(FileFolderTest, TheFolderIsMadeWithTheFirstFileAndNoneBelowIt) {
  const FileFolder later(path("made/later"), "--save-folder");
  EXPECT_NE(errorText([&] { later.find("a.yaml", waypointFiles()); }), "");
  EXPECT_FALSE(fs::exists(path("made")));
  writeFileAtomically(later.place("a.yaml", waypointFiles()), kWaypoints);
  EXPECT_EQ(contentOf(path("made/later/a.yaml")), kWaypoints);
  EXPECT_NE(errorText([&] { later.place("b/a.yaml", waypointFiles()); }), "");
}

// Between the question and the writing, a folder becomes a link.
TEST_F(FileFolderTest, AFolderThatIsExchangedMeanwhileChangesNothing) {
  const auto place = folder_.place("sub/raced.yaml", waypointFiles());
  fs::rename(path("save/sub"), path("save/moved"));
  link("../outside", "save/sub");
  writeFileAtomically(place, kWaypoints);
  EXPECT_FALSE(fs::exists(path("outside/raced.yaml")));
  EXPECT_EQ(contentOf(path("save/moved/raced.yaml")), kWaypoints);
}

TEST_F(FileFolderTest, AFileThatBecomesALinkMeanwhileIsNotFollowed) {
  const auto place = folder_.place("sub/ours.yaml", waypointFiles());
  fs::remove(path("save/sub/ours.yaml"));
  link("../../outside/ours.yaml", "save/sub/ours.yaml");
  EXPECT_NE(errorText([&] { writeFileAtomically(place, "waypoints: [raced]\n"); }), "");
  EXPECT_EQ(contentOf(path("outside/ours.yaml")), kWaypoints);
}

// 10^5 names of parts that lead somewhere, of separators and of arbitrary bytes.
TEST_F(FileFolderTest, NoNameOfManyLeavesIt) {
  const auto before = untouchable();
  const std::vector<std::string> parts = {"..",
                                          ".",
                                          "/",
                                          "//",
                                          "",
                                          "sub",
                                          "outside",
                                          "root",
                                          "inside",
                                          "dots",
                                          ".dots",
                                          "save",
                                          "new",
                                          "ours.yaml",
                                          "out.yaml",
                                          "in.yaml",
                                          "bashrc.yaml",
                                          "dangling.yaml",
                                          "fifo.yaml",
                                          "null.yaml",
                                          "loop.yaml",
                                          "hidden.yaml",
                                          ".hidden.yaml",
                                          "other.yaml",
                                          "folder.yaml",
                                          ".bashrc",
                                          "bashrc",
                                          "~",
                                          "%2e%2e",
                                          "..\\",
                                          std::string("\0", 1),
                                          "\xc0\xae\xc0\xae",
                                          "a.yaml",
                                          "b.yml",
                                          ".yaml",
                                          path("save"),
                                          path("outside"),
                                          path(""),
                                          "/proc/self/cwd",
                                          "/proc/self/fd/1",
                                          "/dev/null",
                                          "/dev/shm"};
  std::mt19937 random(20131206);
  const auto below = [&random](std::size_t end) { return random() % end; };
  int saved = 0, escaped = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string name;
    for (std::size_t k = 1 + below(6); k > 0; --k) {
      name += below(20) == 0 ? std::string(1, static_cast<char>(below(256)))
                             : parts[below(parts.size())];
      if (below(3) != 0 && k > 1) name += "/";
    }
    if (!whyNotSaved(name).empty()) continue;
    ++saved;
    const std::string place = folder_.find(name, waypointFiles());
    if (place.rfind(fs::canonical(path("save")).string() + "/", 0) != 0) ++escaped;
  }
  EXPECT_EQ(escaped, 0);
  EXPECT_GT(saved, 1000);
  EXPECT_EQ(untouchable(), before);
}

}  // namespace
}  // namespace grid_path_planner::nodes
