// Text as one word of a command line, for commands that are printed to be run again.
//
//   const std::string command = "rm " + shellWord("my study.yaml");   // rm 'my study.yaml'
//
// A POSIX shell reads the word as exactly the text, whatever is in it: spaces, quotes, $(...), backquotes, newlines. Text of
// letters, digits and / . _ - + , stays as it is.
#pragma once

#include <string>

namespace grid_path_planner::base {

std::string shellWord(const std::string& text);

}  // namespace grid_path_planner::base
