// Names of files as services and parameters give them: nothing outside the folder is written or read.
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "fuzz/fuzz_target.h"
#include "ros/guard/node_files.h"
#include "ros/messages/file_kinds.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfNames() {
  return {
      "a.yaml",       "today/site.yaml", "../b.yaml",   "/etc/passwd", "link.yaml",
      "out/b.yaml",   ".hidden.yaml",    "pipe.yaml",   "a.yaml/",     "today/../../b.yaml",
      "other/b.yaml", "loop.yaml",       "today//a.bt", "./a.yaml",    std::string("a\0.yaml", 7)};
}

// The folder that names are below, and beside it what must not be touched.
class Folders {
 public:
  Folders() {
    namespace fs = std::filesystem;
    fs::create_directories(inside("today"));
    fs::create_directories(folder_.path("outside"));
    fs::create_directory_symlink(folder_.path("outside"), inside("out"));
    fs::create_directory_symlink(inside("today"), inside("other"));
    fs::create_symlink(folder_.path("outside/b.yaml"), inside("link.yaml"));
    fs::create_symlink(inside("loop.yaml"), inside("loop.yaml"));
    ::mkfifo(inside("pipe.yaml").c_str(), 0600);
  }
  std::string inside(const std::string& name) const { return folder_.path("inside/" + name); }
  bool isUntouched() const {
    return std::filesystem::is_empty(folder_.path("outside")) &&
           folder_.names() == std::vector<std::string>{"inside", "outside"};
  }

 private:
  const test::TemporaryFolder folder_;
};

FUZZ_TARGET(file_name, seedsOfNames) {
  static const Folders folders;
  const nodes::NodeFiles files({}, folders.inside("."), folders.inside("."));
  for (const nodes::FileKind* kind :
       {&nodes::waypointFiles(), &nodes::mapServerFiles(), &nodes::octreeFiles()}) {
    mayRefuse([&] {
      const auto file = files.toWrite("waypoints_file", input, *kind);
      base::writeFileAtomically(file, "waypoints:\n");
      const std::string found = files.toRead("waypoints_file", input, *kind);
      mustHold(found.find("/inside/") != std::string::npos, "what is found lies in the folder");
      ::unlink(found.c_str());
    });
    mustHold(folders.isUntouched(), "nothing outside of the folder is touched");
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
