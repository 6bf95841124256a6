#include "ros/guard/node_files.h"

#include <cstdlib>
#include <utility>

namespace grid_path_planner::nodes {

using base::InputError;
using base::OutputFile;

namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

std::string folderOf(const std::string& argument, const char* variable) {
  if (!argument.empty()) return argument;
  if (const std::string folder = environment(variable); !folder.empty()) return folder;
  const std::string ros_home = environment("ROS_HOME");
  return (ros_home.empty() ? environment("HOME") + "/.ros" : ros_home) + "/grid_path_planner";
}

}  // namespace

NodeFiles::NodeFiles() : NodeFiles({}, "", "") {}

NodeFiles::NodeFiles(std::map<std::string, std::string> by_argument, const std::string& save_folder,
                     const std::string& load_folder)
    : by_argument_(std::move(by_argument)),
      save_folder_(folderOf(save_folder, "GRID_PATH_PLANNER_SAVE_FOLDER"), "--save-folder"),
      load_folder_(folderOf(load_folder, "GRID_PATH_PLANNER_LOAD_FOLDER"), "--load-folder") {}

std::string NodeFiles::named(const std::string& option, const std::string& value) const {
  const auto given = by_argument_.find(option);
  return given == by_argument_.end() ? value : given->second;
}

OutputFile NodeFiles::toWrite(const std::string& option, const std::string& name,
                              const FileKind& kind) const {
  return isArgument(option, name) ? OutputFile(name) : save_folder_.place(name, kind);
}

std::string NodeFiles::toRead(const std::string& option, const std::string& name,
                              const FileKind& kind) const {
  return isArgument(option, name) ? name : load_folder_.find(name, kind);
}

InputError NodeFiles::withoutContent(const InputError& error, const std::string& file,
                                     const std::string& name, const FileKind& kind) {
  const std::string text = error.what();
  const std::size_t begin = file.size() + 1;
  std::string line;
  if (text.compare(0, begin, file + ":") == 0)
    line = text.substr(begin, text.find_first_not_of("0123456789", begin) - begin);
  return InputError("the " + kind.name + " '" + name + "' cannot be used" +
                    (line.empty() ? "" : ", from line " + line) +
                    ": what is in it is told only of files that the node's arguments name");
}

bool NodeFiles::isArgument(const std::string& option, const std::string& name) const {
  const auto given = by_argument_.find(option);
  return given != by_argument_.end() && given->second == name;
}

}  // namespace grid_path_planner::nodes
