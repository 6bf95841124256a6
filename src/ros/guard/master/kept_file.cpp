#include "ros/guard/master/kept_file.h"

#include <ros/master.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "ros/guard/master/xmlrpc_call.h"
#include "ros/guard/run_node.h"

namespace grid_path_planner::nodes {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::hours kOld{1};
constexpr int kAskedForRun = 10;         // times
constexpr double kPatienceForRun = 1.0;  // s, each time

bool isRunId(const std::string& text) {
  const auto belongs = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
  };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), belongs);
}

// Of a name as keptFileName() makes it: what files of other runs share with it.
std::string withoutRun(const fs::path& name) {
  return name.stem().stem().string() + name.extension().string();
}

// An entry that is gone meanwhile is no error.
bool isOld(const fs::directory_entry& entry) {
  std::error_code error;
  const auto written = entry.last_write_time(error);
  return !error && entry.is_regular_file(error) && !entry.is_symlink(error) &&
         written + kOld < fs::file_time_type::clock::now();
}

}  // namespace

// Names of nodes have no dots.
std::string keptFileName(const std::string& node, const std::string& run,
                         const std::string& ending) {
  std::string name = node.substr(std::min(node.find_first_not_of('/'), node.size()));
  std::replace(name.begin(), name.end(), '/', '.');
  return "." + name + "@" + ros::master::getHost() + "_" + std::to_string(ros::master::getPort()) +
         "." + run + ending;
}

std::string runId() {
  std::string run;
  return ros::param::get("/run_id", run) && isRunId(run) ? run : "";
}

std::string runIdAtStart() {
  using XmlRpc::XmlRpcValue;
  std::string run = runId();
  for (int asked = 1; run.empty() && asked < kAskedForRun && !nodeIsToEnd(); ++asked) {
    auto there = callXmlRpc(masterUri(), "hasParam",
                            {XmlRpcValue(ros::this_node::getName()), XmlRpcValue("/run_id")},
                            kPatienceForRun);
    if (there && there->getType() == XmlRpcValue::TypeBoolean && !static_cast<bool&>(*there)) break;
    run = runId();
  }
  return run;
}

void removeOldKeptFiles(const std::string& file) {
  const fs::path kept(file);
  std::error_code error;
  for (fs::directory_iterator entry(kept.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& other = entry->path();
    std::error_code ignored;  // it may be gone
    if (other.filename() != kept.filename() &&
        withoutRun(other.filename()) == withoutRun(kept.filename()) && isOld(*entry))
      fs::remove(other, ignored);
  }
}

}  // namespace grid_path_planner::nodes
