#include "ros/mapping/octomap_messages.h"

#ifdef GPP_HAS_OCTOMAP_MSGS

#include <octomap_msgs/GetOctomap.h>
#include <octomap_msgs/Octomap.h>
#include <ros/service_server.h>

#include <sstream>
#include <string>

#include "ros/guard/incoming/advertised_service.h"
#include "ros/mapping/octree_topic.h"

namespace grid_path_planner::nodes {

using mapping::MapModel;

namespace {

octomap_msgs::Octomap messageOf(const MapModel& map, bool binary, const ros::Time& stamp) {
  const octomap::OcTree& tree = map.map().tree();
  std::ostringstream data;
  if (binary)
    tree.writeBinaryData(data);
  else
    tree.writeData(data);
  const std::string bytes = data.str();
  octomap_msgs::Octomap message;
  message.header.frame_id = map.options().frame_id;
  message.header.stamp = stamp;
  message.binary = binary;
  message.id = tree.getTreeType();
  message.resolution = tree.getResolution();
  message.data.assign(bytes.begin(), bytes.end());
  return message;
}

}  // namespace

struct OctomapMessages::Topics {
  explicit Topics(MappingThread& mapping_thread) : thread(mapping_thread) {}

  bool answer(bool binary, octomap_msgs::GetOctomap::Response& response) {
    thread.run([&](MapModel& map) { response.map = messageOf(map, binary, ros::Time::now()); });
    return true;
  }

  MappingThread& thread;
  OctreeTopic binary, full;
  ros::ServiceServer binary_service, full_service;
};

OctomapMessages::OctomapMessages(ros::NodeHandle nh, ros::NodeHandle service_nh, bool latch,
                                 MappingThread& thread, const std::function<void()>& on_subscriber)
    : topics_(std::make_unique<Topics>(thread)) {
  const auto connected = [on_subscriber](const ros::SingleSubscriberPublisher&) {
    on_subscriber();
  };
  topics_->binary.publisher =
      nh.advertise<octomap_msgs::Octomap>("octomap_binary", 1, connected, {}, {}, latch);
  topics_->full.publisher =
      nh.advertise<octomap_msgs::Octomap>("octomap_full", 1, connected, {}, {}, latch);
  const auto answer = [topics = topics_.get()](bool binary) {
    return [=](auto&, auto& response) { return topics->answer(binary, response); };
  };
  using octomap_msgs::GetOctomap;
  topics_->binary_service =
      advertiseService<GetOctomap>(service_nh, "octomap_binary", answer(true));
  topics_->full_service = advertiseService<GetOctomap>(service_nh, "octomap_full", answer(false));
}

OctomapMessages::~OctomapMessages() = default;

bool OctomapMessages::isDue(const MapModel& map) const {
  return topics_->binary.isDue(map) || topics_->full.isDue(map);
}

void OctomapMessages::publish(const MapModel& map, const ros::Time& stamp) {
  if (topics_->binary.isDue(map)) topics_->binary.publish(messageOf(map, true, stamp), map);
  if (topics_->full.isDue(map)) topics_->full.publish(messageOf(map, false, stamp), map);
}

void OctomapMessages::shutdown() {
  topics_->binary_service.shutdown();
  topics_->full_service.shutdown();
}

}  // namespace grid_path_planner::nodes

#else

namespace grid_path_planner::nodes {

using mapping::MapModel;

struct OctomapMessages::Topics {};

OctomapMessages::OctomapMessages(ros::NodeHandle, ros::NodeHandle, bool, MappingThread&,
                                 const std::function<void()>&) {}
OctomapMessages::~OctomapMessages() = default;
bool OctomapMessages::isDue(const MapModel&) const {
  return false;
}
void OctomapMessages::publish(const MapModel&, const ros::Time&) {}
void OctomapMessages::shutdown() {}

}  // namespace grid_path_planner::nodes

#endif
