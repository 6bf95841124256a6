#include "ros/planning/map_publisher_node.h"

#include <utility>

#include "grid_path_planner/MapPublisherConfig.h"
#include "grid_path_planner/ros/bag.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/ending/shutdown_flag.h"
#include "ros/guard/incoming/advertised_service.h"
#include "ros/guard/network_text.h"
#include "ros/guard/outgoing/latched_message.h"
#include "ros/guard/parameters.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/guard/scheduling/log_throttle.h"
#include "ros/messages/file_kinds.h"

namespace grid_path_planner::nodes {

using base::InputError;
using grid::checkOccupancyValues;
using grid::MapFileOptions;
using grid::OccupancyGrid;

namespace {

MapPublisherOptions loadMapPublisherOptions(const ros::NodeHandle& private_nh,
                                            const NodeFiles& files) {
  MapPublisherOptions options;
  loadParameters(private_nh, options);
  options.filename = files.named("filename", options.filename);
  checkMapPublisherOptions(options);
  warnUnknownParameters(private_nh, optionNames<MapPublisherOptions>());
  return options;
}

}  // namespace

void checkMapPublisherOptions(const MapPublisherOptions& options) {
  if (options.filename.empty())
    throw InputError(
        "filename must name a map file, got '': give it as `map_publisher FILE`, or as the "
        "parameter "
        "~filename (_filename:=FILE)");
  checkNetworkText("frame_id", options.frame_id);
  checkNetworkText("topic", options.topic);
  checkNetworkText("bag_topic", options.bag_topic);
  if (options.frame_id.empty()) throw InputError("frame_id must name a frame, got ''");
  if (options.topic.empty()) throw InputError("topic must name a topic, got ''");
}

MapPublisherNode::MapPublisherNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                   const NodeFiles& files)
    : files_(files), options_(loadMapPublisherOptions(private_nh, files)), nh_(nh) {
  map_ = readMap(options_);
  map_publisher_ = nh.advertise<nav_msgs::OccupancyGrid>(options_.topic, 1, true);
  metadata_publisher_ = nh.advertise<nav_msgs::MapMetaData>("map_metadata", 1, true);
  service_ = advertiseService<nav_msgs::GetMap>(
      nh, "static_map", [this](auto&, auto& response) { return getMap(response); });
  reconfigurable_ = std::make_unique<Reconfigurable<MapPublisherConfig, MapPublisherOptions>>(
      private_nh, options_, [this](const MapPublisherOptions& options) { use(options); });
  timer_ = guardedTimer(nh, 0.02, [this] { publishOnceThereIsTime(); });
}

MapPublisherNode::~MapPublisherNode() {
  timer_.stop();
  service_.shutdown();
}

OccupancyGrid MapPublisherNode::readMap(const MapPublisherOptions& wanted) const {
  const std::string& filename = wanted.filename;
  const ShutdownFlag end;
  MapFileOptions options;
  options.bag_topic = wanted.bag_topic;
  options.limits = {wanted.reading, end.token()};
  if (files_.isArgument("filename", filename))
    options.warn = [](const std::string& warning) { ROS_WARN_STREAM(warning); };
  options.warn_of_cells_of_images = true;
  OccupancyGrid map = files_.read("filename", filename, mapFiles(), [&](const std::string& file) {
    return readAnyMapFile(file, options);
  });
  checkOccupancyValues(map);
  return map;
}

void MapPublisherNode::use(const MapPublisherOptions& options) {
  checkMapPublisherOptions(options);
  if (options.topic != options_.topic)
    throw InputError("topic cannot be changed while the node runs, it is " + options_.topic);
  map_ = readMap(options);
  options_ = options;
  timer_.start();
}

void MapPublisherNode::publishOnceThereIsTime() {
  if (!ros::Time::isValid()) {
    static LogThrottle seldom(5.0);
    ROS_WARN_COND(seldom.isDue(), "use_sim_time is set and no /clock has come yet: waiting for it");
    return;
  }
  message_ = occupancyToMessage(map_, frameName(options_.frame_id), ros::Time::now());
  publishLatched(map_publisher_, message_);
  publishLatched(metadata_publisher_, message_.info);
  timer_.stop();  // at last: where there was no memory for all of it, it is tried again
  ROS_INFO_STREAM("Published " << options_.filename << ": " << map_.width() << "x" << map_.height()
                               << " cells of " << map_.geometry().resolution() << " m on "
                               << map_publisher_.getTopic());
}

bool MapPublisherNode::getMap(nav_msgs::GetMap::Response& response) {
  if (message_.header.stamp.isZero()) {
    ROS_ERROR("static_map was asked for before there was a ROS time to stamp the map with");
    return false;
  }
  response.map = message_;
  return true;
}

}  // namespace grid_path_planner::nodes
