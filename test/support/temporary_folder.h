// A folder for one test's files, removed with everything in it when the object goes.
#pragma once

#include <string>
#include <vector>

namespace grid_path_planner::test {

class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  // The path of `name` inside the folder.
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  // Writes `content` to the file `name` and gives its path.
  std::string write(const std::string& name, const std::string& content) const;
  // The names of what lies in the folder, sorted.
  std::vector<std::string> names() const;

 private:
  std::string folder_;
};

// The content of a file, byte for byte; throws std::runtime_error where there is none.
std::string contentOf(const std::string& file);

}  // namespace grid_path_planner::test
