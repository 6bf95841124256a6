// The files of a node: those that its owner named by argument, which may lie anywhere, and the
// folders below which all others lie.
//
//   const base::OutputFile file = files.toWrite("waypoints_file", request.filename, waypointFiles());
//
//   const WaypointFile waypoints =
//       files.read("config_filename", goal.filename, waypointFiles(),
//                  [](const std::string& file) { return readWaypointFile(file); });
//
// Any ROS client can set a parameter, call a service and end a node so that roslaunch starts it
// again. The folders are therefore no parameters: they are arguments of the process, --save-folder
// and --load-folder, else its environment (GRID_PATH_PLANNER_SAVE_FOLDER and
// GRID_PATH_PLANNER_LOAD_FOLDER; a nodelet's are those of its manager), else
// $ROS_HOME/grid_path_planner, where ROS_HOME is ~/.ros by default.
#pragma once

#include <map>
#include <string>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/file_folder.h"

namespace grid_path_planner::nodes {

class NodeFiles {
 public:
  // Of the environment: a nodelet's.
  NodeFiles();
  // `by_argument`: the names that the node's arguments give, by the option that they replace. Empty
  // folders are those of the environment.
  NodeFiles(std::map<std::string, std::string> by_argument, const std::string& save_folder,
            const std::string& load_folder);

  const FileFolder& saveFolder() const { return save_folder_; }
  const FileFolder& loadFolder() const { return load_folder_; }

  // The argument for `option`, or `value`, that of the parameter, where none was given.
  std::string named(const std::string& option, const std::string& value) const;

  // The file `name`. It may lie anywhere where it is the argument's for `option`, else it lies
  // below the folder to save in or to load from. Throw InputError.
  base::OutputFile toWrite(const std::string& option, const std::string& name,
                           const FileKind& kind) const;
  std::string toRead(const std::string& option, const std::string& name,
                     const FileKind& kind) const;

  // Whether `name` is the argument for `option`: its owner's, who may be told what is in it.
  bool isArgument(const std::string& option, const std::string& name) const;

  // What `reader` makes of the file toRead(). Throws InputError; nothing of the content of a file that
  // no argument names is in it.
  template <class Reader>
  auto read(const std::string& option, const std::string& name, const FileKind& kind,
            Reader reader) const {
    if (isArgument(option, name)) return reader(name);
    const std::string file = toRead(option, name, kind);
    try {
      return reader(file);
    } catch (const base::InputError& error) {
      throw withoutContent(error, file, name, kind);
    }
  }

 private:
  // An error of a reader that quotes nothing of what is in the file: only where it stands.
  static base::InputError withoutContent(const base::InputError& error, const std::string& file,
                                         const std::string& name, const FileKind& kind);

  std::map<std::string, std::string> by_argument_;
  FileFolder save_folder_;
  FileFolder load_folder_;
};

}  // namespace grid_path_planner::nodes
