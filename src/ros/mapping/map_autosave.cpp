#include "ros/mapping/map_autosave.h"

#include <ros/console.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"
#include "ros/common/master/end_without_master.h"
#include "ros/common/master/kept_file.h"
#include "ros/common/scheduling/log_throttle.h"

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
constexpr std::size_t kBeginning = 4096;  // bytes, that hold the lines before the octree

std::string firstRunId() {
  const std::string run = runId();
  if (!run.empty()) return run;
  ROS_WARN(
      "The master has no /run_id, as roscore sets it: the map is not kept for a node that starts "
      "again");
  return "";
}

}  // namespace

MapAutosave::MapAutosave(const std::string& folder, const std::string& node,
                         const ProjectedMapOptions& options)
    : folder_(folder),
      file_(folder + "/" + keptFileName(node, ".ot")),
      run_(firstRunId()),
      frame_id_(options.frame_id) {
  setOptions(options);
}

void MapAutosave::setOptions(const ProjectedMapOptions& options) {
  octree_ = options.filename;
  std::replace(octree_.begin(), octree_.end(), '\n', ' ');
  resolution_ = options.octree.resolution;
}

// A roscore that was restarted has another run, under which a node that is killed now starts again. It has a
// /run_id a moment after it answers.
void MapAutosave::followMaster() {
  const unsigned restarts = master_->restarts();
  if (restarts == restarts_) return;
  const std::string run = runId();
  if (run.empty()) return;
  restarts_ = restarts;
  if (std::exchange(run_, run) != run) saved_revision_ = 0;
}

// A file has its own resolution.
std::string MapAutosave::marker() const {
  return "run " + run_ + ", frame " + frame_id_ +
         (octree_.empty() ? ", resolution " + decimalText(resolution_) : ", file " + octree_);
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
    ROS_INFO_STREAM(
        "The map that was kept in "
        << file_ << " is of another run, frame, resolution or octree file: it is not begun with");
    return "";
  }
  ROS_WARN_STREAM("Begins with the map that was kept in "
                  << file_ << (octree_.empty() ? "" : ", which began with " + octree_)
                  << "; the service ~reset forgets it");
  return file_;
}

ros::Time MapAutosave::newestCloud() const {
  const auto kept = this->kept();
  return kept ? kept->newest_cloud : ros::Time();
}

void MapAutosave::save(const MapModel& map, const ros::Time& newest_cloud, When when) {
  followMaster();
  const bool failed = !state().problem.empty();
  if (run_.empty() || (map.revision() == saved_revision_ && !failed)) return;
  noteUnsaved();
  if (when == When::IF_DUE && !share_.due()) return;
  std::string text;
  share_.take([&] { text = map.map().fileText(commentsOf(marker(), newest_cloud)); });
  saved_revision_ = map.revision();
  writer_.post([this, newest_cloud, text = std::move(text), work = std::make_shared<LastWork>()](
                   const StopSource&) { write(text, newest_cloud); },
               kSlot);
}

void MapAutosave::noteUnsaved() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!unsaved_since_) unsaved_since_ = Clock::now();
}

void MapAutosave::write(const std::string& text, const ros::Time& newest_cloud) {
  State state;
  state.newest_cloud = newest_cloud;
  try {
    std::error_code ignored;  // shows in the writing
    std::filesystem::create_directories(folder_, ignored);
    writeFileAtomically(file_, text);
  } catch (const InputError& error) {
    state.problem = error.what();
    static LogThrottle seldom(10.0);
    ROS_WARN_STREAM_COND(seldom.isDue(),
                         "The map cannot be kept for a node that starts again: " << state.problem);
  }
  std::lock_guard<std::mutex> lock(mutex_);
  if (state.problem.empty()) {
    written_ = Clock::now();
    unsaved_since_.reset();  // what came meanwhile is noted again soon
  }
  state_ = state;
}

void MapAutosave::remove() {
  writer_
      .post(
          [this](const StopSource&) {
            std::error_code error;
            std::filesystem::remove(file_, error);
            if (error)
              ROS_ERROR_STREAM(file_
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
