#include "ros/mapping/projected_map_node.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grid_path_planner/ProjectedMapConfig.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/ending/end_of_node.h"
#include "ros/guard/master/end_without_master.h"
#include "ros/guard/parameters.h"
#include "ros/guard/process/memory_limit_line.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/guard/scheduling/log_throttle.h"
#include "ros/messages/cloud_reader.h"
#include "ros/messages/file_kinds.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::StopReason;
using mapping::checkProjectedMapOptions;
using mapping::ignoredParameter;
using mapping::MapModel;
using mapping::ProjectedMapOptions;
using mapping::ProjectionReference;

namespace {

constexpr double kFirstCloudWait = 5.0;  // s of the wall clock without the first cloud
constexpr double kDecayPeriod = 1.0;     // s of ROS time; decay visits every occupied voxel
constexpr double kLongestDecay = 10.0;   // s of ROS time that a step of the decay counts at most
constexpr double kOldestDepth = 3.0;     // s of ROS time, of the vehicle's that the band refers to

void warnIgnoredParameters(const ros::NodeHandle& private_nh, std::vector<std::string>& known) {
  for (const std::string& name : unknownParameters(private_nh, known)) {
    const std::string reason = ignoredParameter(name);
    if (reason.empty()) continue;
    ROS_WARN_STREAM(private_nh.resolveName(name) << " has no effect: " << reason);
    known.push_back(name);
  }
}

ProjectedMapOptions loadOptions(const ros::NodeHandle& private_nh, const NodeFiles& files) {
  ProjectedMapOptions options;
  loadParameters(private_nh, options);
  options.filename = files.named("filename", options.filename);
  options.map_file = files.named("map_file", options.map_file);
  options.octree_file = files.named("octree_file", options.octree_file);
  options.frame_id = frameName(options.frame_id);
  options.base_frame_id = frameName(options.base_frame_id);
  checkProjectedMapOptions(options);
  auto known = optionNames<ProjectedMapOptions>();
  known.push_back("diagnostic_period");  // diagnostic_updater's
  warnIgnoredParameters(private_nh, known);
  warnUnknownParameters(private_nh, known);
  return options;
}

InputRules cloudRules(const ProjectedMapOptions& options) {
  InputRules rules = rulesOf("projected_map", "cloud_in");
  rules.frames = {options.frame_id};
  if (options.cloud.filter_ground) rules.frames.push_back(options.base_frame_id);
  rules.tf_wait = options.tf_timeout;
  rules.most_waiting = static_cast<std::size_t>(options.queue_size);
  return rules;
}

mapping::CloudFrames framesOf(const std::vector<Eigen::Isometry3d>& poses, bool needs_base) {
  mapping::CloudFrames frames;
  frames.map_from_sensor = poses.at(0);
  if (!needs_base) return frames;
  if (poses.size() < 2) throw InputError("it came before filter_ground was asked for");
  frames.base_from_map = poses[1] * poses[0].inverse();
  return frames;
}

// With the map that was kept; where it is damaged, as without it. A reading that ends with the node, or for want of
// memory, is no such case: the file is still good, and is there when the node starts again.
std::unique_ptr<MappingThread> makeThread(const ProjectedMapOptions& options,
                                          const MapAutosave* autosave) {
  const EndOfNode end;
  const std::string kept = autosave ? autosave->begin() : "";
  try {
    return std::make_unique<MappingThread>(options, kept, end.token());
  } catch (const InputError& error) {
    if (kept.empty() || end.token().reason() != StopReason::NONE) throw;
    ROS_ERROR_STREAM("The map that was kept is lost: " << error.what());
    return std::make_unique<MappingThread>(options, "", end.token());
  } catch (const std::bad_alloc&) {
    if (kept.empty()) throw;
    throw InputError(kept,
                     "holds the map that was kept, for which there is not enough memory; the file "
                     "stays for the next start");
  }
}

bool followsVehicle(const MapModel& map) {
  return map.options().projection.reference == ProjectionReference::VEHICLE;
}

}  // namespace

ProjectedMapNode::ProjectedMapNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                   const NodeFiles& files)
    : nh_(nh), files_(files), transforms_(nh), service_spinner_(1, &service_queue_) {
  ProjectedMapOptions options = loadOptions(private_nh, files);
  ROS_INFO_STREAM(
      memoryLimitLine("The 3-D map", options.octree.memory_limit, memoryLimitOf(options.octree)));
  if (options.autosave_period > 0.0)
    autosave_ = std::make_unique<MapAutosave>(files.saveFolder().path(), private_nh.getNamespace(),
                                              options);
  const ProjectedMapOptions with_file = withFile(options);
  filename_ = options.filename;
  loaded_ = with_file.filename;
  thread_ = makeThread(with_file, autosave_.get());
  thread_->run([&](MapModel& map) { options = map.options(); });  // a file has its own resolution
  options.filename = filename_;
  clouds_ = std::make_unique<Clouds>(nh, "cloud_in", cloudRules(options), transforms_,
                                     [this] { postInsertion(); });

  ros::NodeHandle service_nh(nh);
  service_nh.setCallbackQueue(&service_queue_);
  ros::NodeHandle private_service_nh(private_nh);
  private_service_nh.setCallbackQueue(&service_queue_);
  const auto on_change = [this] { postPublishing(); };
  map_publisher_ = std::make_unique<ProjectedMapPublisher>(nh, options.latch, on_change);
  octree_publisher_ =
      std::make_unique<OctreePublisher>(nh, service_nh, options.latch, *thread_, on_change);
  services_ = std::make_unique<MappingServices>(
      private_service_nh, *thread_, files_,
      MappingServices::Listener{on_change, [this] { forgetAll(); },
                                [this](MapModel& map) { insertAll(map); }});
  diagnostics_ = std::make_unique<MappingDiagnostics>(nh, private_nh, *clouds_, *thread_,
                                                      *map_publisher_, *octree_publisher_,
                                                      autosave_.get(), options.autosave_period);
  service_spinner_.start();

  if (filename_.empty())
    silence_timer_ = guardedTimerOnce(nh, kFirstCloudWait, [this] { warnOfSilence(); });
  startPublishing(options);
  if (autosave_) startAutosave(options.autosave_period);
  complete_ = true;
  reconfigurable_ = std::make_unique<Reconfigurable<ProjectedMapConfig, ProjectedMapOptions>>(
      private_nh, options, [this](const ProjectedMapOptions& wanted) { use(wanted); });
}

ProjectedMapNode::~ProjectedMapNode() {
  silence_timer_.stop();
  publish_timer_.stop();
  heartbeat_timer_.stop();
  autosave_timer_.stop();
  service_spinner_.stop();
  saveAtTheEnd();
  clouds_->shutdown();  // asks the master, which may not answer
  reconfigurable_.reset();
  services_->shutdown();
  octree_publisher_->shutdown();
  thread_->stop();
}

// There may be no memory for it.
void ProjectedMapNode::saveAtTheEnd() {
  if (!autosave_) return;
  try {
    thread_->run([this](MapModel& map) { save(map, MapAutosave::When::AT_ONCE); });
  } catch (...) {
    tellGivenUp("Keeping the map at the end");
  }
}

// The name of a file is looked for once: what was loaded may be gone when another option changes.
ProjectedMapOptions ProjectedMapNode::withFile(ProjectedMapOptions options) const {
  if (options.filename == filename_)
    options.filename = loaded_;
  else if (!options.filename.empty())
    options.filename = files_.toRead("filename", options.filename, octreeFiles());
  return options;
}

void ProjectedMapNode::use(const ProjectedMapOptions& options) {
  const ProjectedMapOptions with_file = withFile(options);
  const EndOfNode end;
  thread_->run([&](MapModel& map) {
    map.setOptions(with_file, end.token());
    if (autosave_) autosave_->setOptions(options);
  });
  filename_ = options.filename;
  loaded_ = with_file.filename;
  clouds_->setRules(cloudRules(options));
  startPublishing(options);
  postPublishing();
}

void ProjectedMapNode::startPublishing(const ProjectedMapOptions& options) {
  publish_timer_ = guardedTimer(nh_, 1.0 / options.publish_rate, [this] { postPublishing(); });
  heartbeat_timer_.stop();
  if (options.heartbeat_period <= 0.0) return;
  heartbeat_timer_ = guardedTimer(nh_, options.heartbeat_period, [this] {
    thread_->post("heartbeat", [this](MapModel& map) { publishHeartbeat(map); });
  });
}

// Half of the period is left for the writing.
void ProjectedMapNode::startAutosave(double period) {
  thread_->run(
      [this](MapModel&) { map_publisher_->countCloud(autosave_->newestCloud(), ros::TIME_MAX); });
  autosave_timer_ = guardedTimer(nh_, period / 2.0, [this] {
    thread_->post("autosave", [this](MapModel& map) { save(map, MapAutosave::When::IF_DUE); });
  });
}

void ProjectedMapNode::warnOfSilence() const {
  if (clouds_->counts().received > 0) return;
  ROS_WARN_STREAM(clouds_->problem().value_or("")
                  << ", in " << kFirstCloudWait << " s: is that the topic of the clouds?");
}

// What was seen before ~reset does not come back by itself.
void ProjectedMapNode::forgetAll() {
  clouds_->clear("came before ~reset");
  if (autosave_) autosave_->remove();
}

// Those that are ready; a cloud that still waits for its transform would fill again what is cleared now.
void ProjectedMapNode::insertAll(MapModel& map) {
  for (std::size_t left = clouds_->counts().waiting; left > 0 && insertOne(map);) --left;
  clouds_->clear("came before ~clear_bbx");
}

void ProjectedMapNode::postInsertion() {
  thread_->post("insert", [this](MapModel& map) { insertNext(map); });
}

// A nodelet's subscribers may be there, in another thread, before it is complete.
void ProjectedMapNode::postPublishing() {
  if (!complete_) return;
  thread_->post("publish", [this](MapModel& map) { publish(map); });
}

// One cloud a task, so that services and publications are done in between.
void ProjectedMapNode::insertNext(MapModel& map) {
  if (insertOne(map)) postInsertion();
}

// Whether there was one.
bool ProjectedMapNode::insertOne(MapModel& map) {
  return clouds_->useNext([&](const Clouds::Arrival& cloud) { insert(map, cloud); });
}

void ProjectedMapNode::insert(MapModel& map, const Clouds::Arrival& cloud) {
  const auto frames = framesOf(cloud.poses, map.options().cloud.filter_ground);
  const MapModel::Inserted inserted = map.insert(finitePoints(*cloud.message), frames);
  map_publisher_->countCloud(cloud.message->header.stamp, ros::Time::now());
  diagnostics_->recordInsertion(inserted);
  static LogThrottle no_ground(10.0), full(10.0), outside(10.0);
  if (inserted.ground_missed)
    ROS_WARN_COND(no_ground.isDue(),
                  "No ground plane found in a cloud: points near z = 0 of %s were taken "
                  "for ground",
                  map.options().base_frame_id.c_str());
  if (inserted.map_is_full)
    ROS_WARN_COND(full.isDue(),
                  "The map takes memory_limit: what was unknown stays so; ~reset, or a coarser "
                  "resolution, helps");
  if (inserted.left_out > 0)
    ROS_WARN_STREAM_COND(outside.isDue(), inserted.left_out
                                              << " of " << inserted.points
                                              << " points of a cloud lie outside the tree");
}

void ProjectedMapNode::publish(MapModel& map) {
  if (!ros::Time::isValid()) return;
  decay(map);
  const ros::Time stamp = ros::Time::now();
  try {
    if (updateVehicleHeight(map))
      map_publisher_->publish(map, stamp);
    else
      map_publisher_->owe();
  } catch (const InputError& error) {
    static LogThrottle seldom(10.0);
    ROS_ERROR_STREAM_COND(seldom.isDue(), "projected_map stays as it was: " << error.what());
  }
  static LogThrottle cut(10.0);
  if (const double area = map.areaLeftOut(); area > 0.0)
    ROS_WARN_STREAM_COND(cut.isDue(), "projected_map leaves out "
                                          << area << " m^2 that were seen: "
                                          << "they do not fit into projection_max_cells");
  octree_publisher_->publish(map, stamp);
}

void ProjectedMapNode::save(const MapModel& map, MapAutosave::When when) {
  const LastWork work;
  autosave_->save(map, map_publisher_->newestCloud(), when);
}

void ProjectedMapNode::publishHeartbeat(MapModel& map) {
  map_publisher_->publishHeartbeat(map.options().frame_id);
}

// Less than passed by a clock that was put forward: in that time nothing could have been seen again.
void ProjectedMapNode::decay(MapModel& map) {
  const ros::Time now = ros::Time::now();
  const double passed = now.toSec() - decayed_until_.toSec();
  if (passed >= 0.0 && passed < kDecayPeriod) return;
  if (map.options().octree.decay_time > 0.0 && passed > 0.0 && !decayed_until_.isZero())
    map.decay(std::min(passed, std::max(kLongestDecay, 2.0 / map.options().publish_rate)));
  decayed_until_ = now;
}

// Returns whether the height that the band refers to is known.
bool ProjectedMapNode::updateVehicleHeight(MapModel& map) {
  if (!followsVehicle(map)) return true;
  const ProjectedMapOptions& options = map.options();
  try {
    const Placed vehicle = transforms_.placeVehicle(
        {options.frame_id, kOldestDepth, Moving::WITH_VEHICLE, options.base_frame_id});
    map.setVehicleHeight(vehicle.pose.translation().z());
    return true;
  } catch (const TransformError& error) {
    static LogThrottle seldom(10.0);
    ROS_WARN_STREAM_COND(seldom.isDue(),
                         "projected_map waits for the vehicle's depth: " << error.what());
    return false;
  }
}

}  // namespace grid_path_planner::nodes
