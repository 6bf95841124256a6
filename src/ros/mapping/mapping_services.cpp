#include "ros/mapping/mapping_services.h"

#include <ros/console.h>

#include <algorithm>
#include <string>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/incoming/advertised_service.h"
#include "ros/mapping/floor_warning.h"
#include "ros/messages/file_kinds.h"

namespace grid_path_planner::nodes {

using base::InputError;
using mapping::MapModel;

namespace {

// A file to save to: the request's, or that of the parameter `option`.
struct Target {
  std::string option;
  std::string fallback;
  const FileKind& kind;
};

template <class Save>
void answerSaving(const NodeFiles& files, const SaveFile::Request& request, const Target& target,
                  SaveFile::Response& response, Save save) {
  const std::string file = request.filename.empty() ? target.fallback : request.filename;
  try {
    if (file.empty())
      throw InputError("the request names no file, and the parameter " + target.option +
                       " is empty");
    const base::OutputFile output = files.toWrite(target.option, file, target.kind);
    save(output);
    response.success = true;
    response.message = "written to " + output.name();
    ROS_INFO_STREAM("Saved " << output.name());
  } catch (const InputError& error) {
    response.success = false;
    response.message = error.what();
    ROS_ERROR_STREAM("Not saved: " << error.what());
  }
}

// An empty map would take the place of the one that was saved before.
void checkMapped(MapModel& map) {
  const auto& values = map.grid().values();
  if (std::all_of(values.begin(), values.end(), [](std::int8_t value) { return value < 0; }))
    throw InputError("nothing has been mapped yet: every cell is unknown");
}

Eigen::Vector3d vectorOf(const geometry_msgs::Point& point) {
  return {point.x, point.y, point.z};
}

}  // namespace

MappingServices::MappingServices(ros::NodeHandle private_nh, MappingThread& thread,
                                 const NodeFiles& files, Listener listener)
    : thread_(thread), files_(files), listener_(std::move(listener)) {
  reset_ = advertiseService<std_srvs::Empty>(
      private_nh, "reset",
      [this](auto& request, auto& response) { return reset(request, response); });
  clear_box_ = advertiseService<ClearBoxService>(
      private_nh, "clear_bbx",
      [this](auto& request, auto& response) { return clearBox(request, response); });
  save_map_ = advertiseService<SaveFile>(
      private_nh, "save_map",
      [this](auto& request, auto& response) { return saveMap(request, response); });
  save_octree_ = advertiseService<SaveFile>(
      private_nh, "save_octree",
      [this](auto& request, auto& response) { return saveOctree(request, response); });
}

void MappingServices::shutdown() {
  for (ros::ServiceServer* service : {&reset_, &clear_box_, &save_map_, &save_octree_})
    service->shutdown();
}

bool MappingServices::reset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
  thread_.run([this](MapModel& map) {
    listener_.on_reset();
    map.reset();
  });
  ROS_INFO("The map was reset");
  listener_.on_change();
  return true;
}

bool MappingServices::clearBox(ClearBoxService::Request& request, ClearBoxService::Response&) {
  try {
    thread_.run([&](MapModel& map) {
      const auto clear = [&] { map.clearBox(vectorOf(request.min), vectorOf(request.max)); };
      clear();  // what is no box is refused before anything is done
      listener_.on_clear_box(map);
      clear();
    });
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("clear_bbx refused: " << error.what());
    return false;
  }
  listener_.on_change();
  return true;
}

bool MappingServices::saveMap(SaveFile::Request& request, SaveFile::Response& response) {
  thread_.run([&](MapModel& map) {
    answerSaving(files_, request, {"map_file", map.options().map_file, mapServerFiles()}, response,
                 [&](const base::OutputFile& file) {
                   checkMapped(map);
                   map.saveMap(file);
                 });
    if (!response.success) return;
    const std::string warning = floorWarning(map.grid(), map.options());
    if (warning.empty()) return;
    response.message += ". " + warning;
    ROS_WARN_STREAM(warning);
  });
  return true;
}

bool MappingServices::saveOctree(SaveFile::Request& request, SaveFile::Response& response) {
  thread_.run([&](MapModel& map) {
    answerSaving(files_, request, {"octree_file", map.options().octree_file, octreeFiles()},
                 response, [&](const base::OutputFile& file) { map.saveOctree(file); });
  });
  return true;
}

}  // namespace grid_path_planner::nodes
