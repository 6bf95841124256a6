// The nodes that the package has, by nodelet_plugins.xml: a test with a list of its own compares it with these.
#pragma once

#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace grid_path_planner::test {

inline std::set<std::string> knownNodes() {
  std::ifstream file(GPP_TEST_DATA "/../../nodelet_plugins.xml");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string before = "class name=\"grid_path_planner/";
  std::set<std::string> names;
  for (std::size_t at = 0; (at = text.find(before, at)) != std::string::npos;) {
    at += before.size();
    names.insert(text.substr(at, text.find('"', at) - at));
  }
  return names;
}

}  // namespace grid_path_planner::test
