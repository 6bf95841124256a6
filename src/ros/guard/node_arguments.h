// The command line of a node: ROS's own arguments (_parameter:=value, topic:=other), the files that
// its owner names, which may lie anywhere, and the folders for the files that others name.
//
//   const std::vector<FileArgument> files = {{"filename", "MAP", true}};
//   const NodeArguments given = nodeArguments(argc, argv, "map_publisher", files);
//   if (given.exit_code) return *given.exit_code;
//
// roscpp ignores unknown arguments, so that a node started as `navigate_path site.yaml` would wait
// for a path for ever.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grid_path_planner::nodes {

// An option of the node that is the name of a file: `world` is given as --world FILE.
struct FileArgument {
  std::string option;
  std::string value;            // as the usage calls it
  bool without_option = false;  // may be given as FILE alone too
  // Reads the file and throws InputError where that fails; none: it is written. Called before the
  // node's name is registered, which would end a running node of this name.
  std::function<void(const std::string& file)> check = {};
};

// Throws InputError for a file that is not there or cannot be opened.
void checkCanBeOpened(const std::string& file);

// The check of every file that was given. Throws InputError.
void checkGivenFiles(const std::vector<FileArgument>& known,
                     const std::map<std::string, std::string>& given);

struct NodeArguments {
  std::map<std::string, std::string> files;  // by option; those that are given and not empty
  std::string save_folder;                   // "": not given, as the next
  std::string load_folder;
  std::optional<int> exit_code;  // the program ends with it; the message is printed
};

// --help and -h print the usage; any other option, an option twice or without its value, and a file
// too many are refused on the standard error. A node that has neither files nor folders has no `files`.
NodeArguments nodeArguments(int argc, const char* const* argv, const std::string& name,
                            const std::optional<std::vector<FileArgument>>& files = {});

}  // namespace grid_path_planner::nodes
