// The files of a node: those that its owner named by argument, which may lie anywhere, and the
// folders below which all others lie.
//
//   const base::OutputFile file = files.toWrite("waypoints_file", request.filename, waypointFiles());
//
// Any ROS client can set a parameter, call a service and end a node so that roslaunch starts it
// again. The folders are therefore no parameters: they are arguments of the process, --save-folder
// and --load-folder, else its environment (GRID_PATH_PLANNER_SAVE_FOLDER and
// GRID_PATH_PLANNER_LOAD_FOLDER; a nodelet's are those of its manager), else
// $ROS_HOME/grid_path_planner, where ROS_HOME is ~/.ros by default.
#pragma once

#include <map>
#include <string>

#include "ros/common/file_folder.h"

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

 private:
  bool isArgument(const std::string& option, const std::string& name) const;

  std::map<std::string, std::string> by_argument_;
  FileFolder save_folder_;
  FileFolder load_folder_;
};

}  // namespace grid_path_planner::nodes
