#include "ros/mapping/projected_map_node.h"

#include <utility>
#include <vector>

#include "grid_path_planner/ProjectedMapConfig.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/ending/shutdown_flag.h"
#include "ros/guard/master/shutdown_timeout.h"
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

namespace {

constexpr double kFirstCloudWait = 5.0;  // s of the wall clock without the first cloud

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
  const ShutdownFlag end;
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

}  // namespace

ProjectedMapNode::ProjectedMapNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                   const NodeFiles& files)
    : files_(files), transforms_(nh), service_spinner_(1, &service_queue_) {
  ProjectedMapOptions options = loadOptions(private_nh, files);
  ROS_INFO_STREAM(
      memoryLimitLine("The 3-D map", options.octree.memory_limit, memoryLimitOf(options.octree)));
  if (options.autosave_period > 0.0)
    autosave_ = std::make_unique<MapAutosave>(files.saveFolder().path(), private_nh.getNamespace(),
                                              options);
  thread_ = makeThread(withFile(options, ""), autosave_.get());
  filename_ = options.filename;
  thread_->run([&](MapModel& map) { options = map.options(); });  // a file has its own resolution
  options.filename = filename_;
  clouds_ = std::make_unique<Clouds>(nh, "cloud_in", cloudRules(options), transforms_,
                                     Clouds::OnReady{[this] { postInsertion(); }});

  ros::NodeHandle service_nh(nh);
  service_nh.setCallbackQueue(&service_queue_);
  ros::NodeHandle private_service_nh(private_nh);
  private_service_nh.setCallbackQueue(&service_queue_);
  publications_ =
      std::make_unique<MappingPublications>(nh, service_nh, *thread_, transforms_, options);
  services_ = std::make_unique<MappingServices>(
      private_service_nh, *thread_, files_,
      MappingServices::Listener{[this] { publications_->post(); }, [this] { forgetAll(); },
                                [this](MapModel& map) { insertAll(map); }});
  diagnostics_ = std::make_unique<MappingDiagnostics>(
      nh, private_nh, *clouds_, *thread_, *publications_, autosave_.get(), options.autosave_period);
  service_spinner_.start();

  if (filename_.empty())
    silence_timer_ = guardedTimerOnce(nh, kFirstCloudWait, [this] { warnOfSilence(); });
  if (autosave_) startAutosave(nh, options.autosave_period);
  reconfigurable_ = std::make_unique<Reconfigurable<ProjectedMapConfig, ProjectedMapOptions>>(
      private_nh, options, [this](const ProjectedMapOptions& wanted) { use(wanted); });
}

ProjectedMapNode::~ProjectedMapNode() {
  service_spinner_.stop();
  const auto keep = [this](MapModel& map) { save(map, MapAutosave::When::AT_ONCE); };
  if (autosave_) guarded("Keeping the map at the end", [&] { thread_->run(keep); });
  clouds_->shutdown();  // asks the master, which may not answer
  reconfigurable_.reset();
  services_->shutdown();
  publications_->shutdown();
  thread_->stop();
}

// The name of a file is looked for once: what was loaded may be gone when another option changes.
ProjectedMapOptions ProjectedMapNode::withFile(ProjectedMapOptions options,
                                               const std::string& loaded) const {
  if (options.filename == filename_)
    options.filename = loaded;
  else if (!options.filename.empty())
    options.filename = files_.toRead("filename", options.filename, octreeFiles());
  return options;
}

void ProjectedMapNode::use(const ProjectedMapOptions& options) {
  const ShutdownFlag end;
  thread_->run([&](MapModel& map) {
    map.setOptions(withFile(options, map.options().filename), end.token());
    if (autosave_) autosave_->setOptions(options);
  });
  filename_ = options.filename;
  clouds_->setRules(cloudRules(options));
  publications_->use(options);
  publications_->post();
}

// Half of the period is left for the writing.
void ProjectedMapNode::startAutosave(const ros::NodeHandle& nh, double period) {
  thread_->run([this](MapModel&) {
    publications_->map().countCloud(autosave_->newestCloud(), ros::TIME_MAX);
  });
  autosave_timer_ = guardedTimer(nh, period / 2.0, [this] {
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

// One cloud a task, so that services and publications are done in between.
void ProjectedMapNode::postInsertion() {
  thread_->post("insert", [this](MapModel& map) {
    if (insertOne(map)) postInsertion();
  });
}

// Whether there was one.
bool ProjectedMapNode::insertOne(MapModel& map) {
  return clouds_->useNext([&](const Clouds::Arrival& cloud) { insert(map, cloud); });
}

void ProjectedMapNode::insert(MapModel& map, const Clouds::Arrival& cloud) {
  const auto frames = framesOf(cloud.poses, map.options().cloud.filter_ground);
  const MapModel::Inserted inserted = map.insert(finitePoints(*cloud.message), frames);
  publications_->map().countCloud(cloud.message->header.stamp, ros::Time::now());
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

void ProjectedMapNode::save(const MapModel& map, MapAutosave::When when) {
  const ShutdownBlocker work;
  autosave_->save(map, publications_->map().newestCloud(), when);
}

}  // namespace grid_path_planner::nodes
