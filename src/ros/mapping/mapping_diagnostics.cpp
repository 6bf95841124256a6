#include "ros/mapping/mapping_diagnostics.h"

#include <string>

#include "base/seconds_since.h"
#include "ros/guard/scheduling/guarded_timer.h"

namespace grid_path_planner::nodes {

using mapping::MapModel;

namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr int kRestAfterCounting = 50;  // times what counting the memory took

}  // namespace

MappingDiagnostics::MappingDiagnostics(ros::NodeHandle nh, ros::NodeHandle private_nh,
                                       const InputBase& clouds, MappingThread& thread,
                                       MappingPublications& publications,
                                       const MapAutosave* autosave, double autosave_period)
    : clouds_(clouds),
      thread_(thread),
      publications_(publications),
      autosave_(autosave),
      autosave_period_(autosave_period),
      updater_(nh, private_nh, private_nh.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("clouds", this, &MappingDiagnostics::reportClouds);
  updater_.add("map", this, &MappingDiagnostics::reportMap);
  if (autosave_) updater_.add("autosave", this, &MappingDiagnostics::reportAutosave);
  timer_ = guardedTimer(nh, updater_.getPeriod(), [this] { onTimer(); });
}

void MappingDiagnostics::onTimer() {
  thread_.post("measure", [this](MapModel& map) { measure(map); });
  if (ros::Time::isValid()) updater_.force_update();
}

void MappingDiagnostics::measure(const MapModel& map) {
  const auto start = Clock::now();
  if (start < measure_not_before_) return;
  const Figures figures{map.map().tree().size(), map.map().memoryUsage(),
                        map.map().options().resolution, map.projections(), map.areaLeftOut()};
  const auto end = Clock::now();
  measure_not_before_ = end + kRestAfterCounting * (end - start);
  std::lock_guard<std::mutex> lock(mutex_);
  figures_ = figures;
}

void MappingDiagnostics::recordInsertion(const MapModel::Inserted& inserted) {
  std::lock_guard<std::mutex> lock(mutex_);
  last_insertion_ = inserted.seconds;
  full_ = inserted.map_is_full;
  all_insertions_ += inserted.seconds;
  ++insertions_;
  inserted_ = Clock::now();
}

void MappingDiagnostics::reportClouds(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const InputCounts counts = clouds_.counts();
  const auto problem = clouds_.problem();
  const std::uint64_t dropped = counts.refusedInAll();
  std::lock_guard<std::mutex> lock(mutex_);
  const double age = insertions_ == 0 ? -1.0 : base::secondsSince(inserted_);
  if (dropped > reported_drops_)
    status.summary(DiagnosticStatus::WARN, "clouds are being dropped");
  else if (counts.received == 0)
    status.summary(DiagnosticStatus::OK, "no cloud has come yet");
  else if (problem)
    status.summary(DiagnosticStatus::WARN, *problem);
  else
    status.summary(DiagnosticStatus::OK, "clouds are mapped");
  reported_drops_ = dropped;
  status.add("received", counts.received);
  status.add("inserted", counts.used);
  status.add("waiting", counts.waiting);
  status.add("dropped", dropped);
  for (const auto& [reason, count] : counts.refused) status.add("dropped: " + reason, count);
  status.add("last_insertion_s", last_insertion_);
  status.add("last_insertion_age_s", age);
  status.add("mean_insertion_s",
             insertions_ == 0 ? 0.0 : all_insertions_ / static_cast<double>(insertions_));
}

void MappingDiagnostics::reportMap(diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::lock_guard<std::mutex> lock(mutex_);
  status.summary(DiagnosticStatus::OK, figures_.nodes == 0 ? "the map is empty" : "a map is there");
  if (publications_.map().owesMap())
    status.summary(DiagnosticStatus::WARN, "projected_map cannot be made, or was not sent");
  else if (full_)
    status.summary(DiagnosticStatus::WARN, "the map takes memory_limit: nothing new is added");
  else if (figures_.area_left_out > 0.0)
    status.summary(DiagnosticStatus::WARN, "projected_map leaves out a part of what was seen");
  status.add("nodes", figures_.nodes);
  status.add("bytes", figures_.bytes);
  status.add("resolution", figures_.resolution);
  status.add("projections", figures_.projections);
  status.add("left_out_m2", figures_.area_left_out);
  status.add("tree_messages", publications_.octree().builds());
}

void MappingDiagnostics::reportAutosave(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const MapAutosave::State state = autosave_->state();
  if (!state.problem.empty())
    status.summary(DiagnosticStatus::WARN, "the map is not kept: " + state.problem);
  else if (state.behind > autosave_period_)
    status.summary(DiagnosticStatus::WARN,
                   "what was seen longer than autosave_period ago is not kept yet");
  else
    status.summary(DiagnosticStatus::OK, "the map is kept for a node that starts again");
  status.add("age_s", state.age);
  status.add("behind_s", state.behind);
  status.add("newest_cloud", state.newest_cloud);
}

}  // namespace grid_path_planner::nodes
