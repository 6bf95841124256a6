#include "ros/mapping/map_autosave.h"

#include <ros/console.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"
#include "ros/guard/master/kept_file.h"
#include "ros/guard/master/shutdown_timeout.h"
#include "ros/guard/scheduling/log_throttle.h"

namespace grid_path_planner::nodes {

using base::decimalText;
using base::InputError;
using base::RegularFile;
using base::StopSource;
using base::TaskQueue;
using base::writeFileAtomically;
using mapping::MapModel;
using mapping::ProjectedMapOptions;

namespace {

constexpr char kSlot[] = "autosave";
constexpr double kAnswers = 3.0;  // s since the master's last answer: it is worth a question
constexpr std::size_t kBeginning = 4096;  // bytes, that hold the lines before the octree

}  // namespace

MapAutosave::MapAutosave(const std::string& folder, const std::string& node,
                         const ProjectedMapOptions& options)
    : folder_(folder), node_(node), run_(runIdAtStart()), file_(fileOf(run_)), options_(options) {
  if (run_.empty())
    noteProblem(no_run_);
  else
    removeOldKeptFiles(file_);
}

std::string MapAutosave::fileOf(const std::string& run) const {
  return folder_ + "/" + keptFileName(node_, run, ".ot");
}

// A roscore that was restarted has another run, under which a node that is killed now starts again. It has a
// /run_id a moment after it answers; or had none when the node started, which then has not begun with what is there.
void MapAutosave::followMaster() {
  const unsigned restarts = master_->restarts();
  if ((restarts == restarts_ && !run_.empty()) || master_->silence() > kAnswers) return;
  const std::string run = runId();
  if (run.empty()) return;
  if (std::error_code ignored; run_.empty() && std::filesystem::exists(fileOf(run), ignored)) {
    no_run_ = fileOf(run) + " is of this run and was not begun with: start the node again";
    return;
  }
  restarts_ = restarts;
  if (std::exchange(run_, run) == run) return;
  replaced_ = std::exchange(file_, fileOf(run_));
}

// A file has its own resolution.
std::string MapAutosave::marker() const {
  std::string octree = options_.filename;
  std::replace(octree.begin(), octree.end(), '\n', ' ');
  return "run " + run_ + ", frame " + options_.frame_id +
         (octree.empty() ? ", resolution " + decimalText(options_.octree.resolution)
                         : ", file " + octree);
}

// What the file says of itself; none where it is not there, or of another map.
std::optional<KeptMap> MapAutosave::kept() const {
  if (run_.empty()) return std::nullopt;
  try {
    return keptMap(RegularFile(file_).read(0, kBeginning), marker());
  } catch (const InputError&) {  // none, or no regular file
    return std::nullopt;
  }
}

std::string MapAutosave::begin() const {
  if (!std::filesystem::exists(file_)) return "";
  if (!kept()) {
    ROS_INFO_STREAM("The map that was kept in "
                    << file_
                    << " is of another frame, resolution or octree file: it is not begun with");
    return "";
  }
  ROS_WARN_STREAM("Begins with the map that was kept in "
                  << file_
                  << (options_.filename.empty() ? "" : ", which began with " + options_.filename)
                  << "; the service ~reset forgets it");
  return file_;
}

ros::Time MapAutosave::newestCloud() const {
  const auto kept = this->kept();
  return kept ? kept->newest_cloud : ros::Time();
}

void MapAutosave::save(const MapModel& map, const ros::Time& newest_cloud, When when) {
  followMaster();
  if (isInFile(map)) return;
  noteUnsaved();
  if (run_.empty()) return noteProblem(no_run_);
  if (when == When::IF_DUE && !share_.due()) return;
  std::string text;
  share_.take([&] { text = map.map().fileText(commentsOf(marker(), newest_cloud)); });
  writer_.post(
      [this, newest_cloud, file = file_, replaced = replaced_, text = std::move(text),
       work = std::make_shared<ShutdownBlocker>()](const StopSource&) {
        write(file, text, newest_cloud);
        std::error_code ignored;  // then it is an old one of another run
        if (!replaced.empty() && state().problem.empty())
          std::filesystem::remove(replaced, ignored);
      },
      kSlot);
  saved_revision_ = map.revision();
}

// As far as what was told to the writer is.
bool MapAutosave::isInFile(const MapModel& map) const {
  std::error_code ignored;  // then it is not there
  return map.revision() == saved_revision_ && state().problem.empty() &&
         std::filesystem::exists(file_, ignored);
}

void MapAutosave::noteProblem(const std::string& problem) {
  static LogThrottle seldom(10.0);
  ROS_WARN_STREAM_COND(seldom.isDue(),
                       "The map cannot be kept for a node that starts again: " << problem);
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.problem = problem;
}

void MapAutosave::noteUnsaved() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!unsaved_since_) unsaved_since_ = Clock::now();
}

void MapAutosave::write(const std::string& file, const std::string& text,
                        const ros::Time& newest_cloud) {
  std::string problem;
  try {
    std::error_code ignored;  // shows in the writing
    std::filesystem::create_directories(folder_, ignored);
    writeFileAtomically(file, text);
  } catch (const std::exception& error) {  // without memory, too: it is not in the file
    problem = error.what();
    noteProblem(problem);
  }
  std::lock_guard<std::mutex> lock(mutex_);
  state_.newest_cloud = newest_cloud;
  if (!problem.empty()) return;
  state_.problem.clear();
  written_ = Clock::now();
  unsaved_since_.reset();  // what came meanwhile is noted again soon
}

void MapAutosave::remove() {
  writer_
      .post(
          [this, file = file_](const StopSource&) {
            std::error_code error;
            std::filesystem::remove(file, error);
            if (error)
              ROS_ERROR_STREAM(file
                               << " cannot be removed, a node that starts again begins with it: "
                               << error.message());
            std::lock_guard<std::mutex> lock(mutex_);
            written_ = {};
            unsaved_since_.reset();
          },
          kSlot, TaskQueue::Turn::NEXT)
      ->wait();
  saved_revision_ = 0;
}

MapAutosave::State MapAutosave::state() const {
  std::lock_guard<std::mutex> lock(mutex_);
  State state = state_;
  const auto since = [now = Clock::now()](Clock::time_point then) {
    return std::chrono::duration<double>(now - then).count();
  };
  if (written_ != Clock::time_point()) state.age = since(written_);
  if (unsaved_since_) state.behind = since(*unsaved_since_);
  return state;
}

}  // namespace grid_path_planner::nodes
