// A folder for one test's files, removed with everything in it when the object goes.
#pragma once

#include <string>
#include <vector>

namespace grid_path_planner::test {

class TemporaryFolder {
 public:
  TemporaryFolder();
  // Below `parent`, which is made where there is none.
  explicit TemporaryFolder(const std::string& parent);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  // The path of `name` inside the folder.
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  // Writes `content` to the file `name` and gives its path.
  std::string write(const std::string& name, const std::string& content) const;
  // The names of what lies in the folder, sorted.
  std::vector<std::string> names() const;
  // The endings of those names, sorted: maps have images whose names are made of their content.
  std::vector<std::string> endings() const;

 private:
  std::string folder_;
};

// The content of a file, byte for byte; throws std::runtime_error where there is none.
std::string contentOf(const std::string& file);

}  // namespace grid_path_planner::test
