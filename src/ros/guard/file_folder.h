// A folder below which the files must lie that others may name: by parameter, service or action.
//
//   const FileFolder folder("/home/me/.ros/grid_path_planner", "--save-folder");
//   writeFileAtomically(folder.place("today/site.yaml", waypointFiles()), text);
//
// Guaranteed, for whatever name: nothing outside the folder is written, links and races included.
// The file's folder is opened once, the kernel says where it lies, and what is written is written
// relative to it. A name is refused where one of its parts begins with a dot, where it has not the
// ending of its kind, where it leads to a file that is no regular one, and, for writing, to one that
// is not of its kind. Errors name the file and quote nothing of it.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/base/files.h"

namespace grid_path_planner::nodes {

// What a file is taken for.
struct FileKind {
  std::string name;                  // in errors: "waypoint file"
  std::vector<std::string> endings;  // without the dot
  // Whether a file may begin so: with its first kFileBeginning bytes, or all of a shorter one. Null
  // where none is ever overwritten.
  bool (*begins)(const std::string& beginning);
};

constexpr std::size_t kFileBeginning = 4096;

class FileFolder {
 public:
  // `path` need not exist; relative ones are below the working directory of now. `argument` is what
  // errors call it.
  FileFolder(const std::string& path, std::string argument);

  const std::string& path() const { return path_; }

  // The file `name` below the folder, its links resolved, to be read. Throws InputError.
  std::string find(const std::string& name, const FileKind& kind) const;

  // The file `name` below the folder, to be written; the folder itself is made where there is none.
  // Throws InputError.
  base::OutputFile place(const std::string& name, const FileKind& kind) const;

 private:
  std::string path_;
  std::string argument_;
};

}  // namespace grid_path_planner::nodes
