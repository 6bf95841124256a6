#include "ros/planning/record/recorded_plans.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/messages/bag_reader.h"
#include "ros/planning/record/recorded_maps.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::ReadLimits;
using grid::OccupancyGrid;

namespace {

constexpr double kSeconds = 600.0;
constexpr std::size_t kMostSources = 16;
constexpr std::size_t kCopiesOfMap = 3;  // the bytes, the message, the map made of it

using Ids = std::set<std::uint32_t>;

template <class Message>
bool carries(const BagConnection& connection) {
  return connection.type == ros::message_traits::datatype<Message>() &&
         connection.md5_sum == ros::message_traits::md5sum<Message>();
}

std::string withoutLeadingSlash(const std::string& name) {
  return !name.empty() && name.front() == '/' ? name.substr(1) : name;
}

// Whether a recorder, to which a relative name may have been given, has called the topic so.
bool isNameOf(const std::string& recorded, const std::string& resolved) {
  const std::string ending = "/" + withoutLeadingSlash(recorded);
  const std::string whole = "/" + withoutLeadingSlash(resolved);
  return whole.size() >= ending.size() &&
         whole.compare(whole.size() - ending.size(), ending.size(), ending) == 0;
}

template <class Message>
void take(RecordedMaps& maps, std::string_view bytes) {
  std::optional<Message> message;
  try {
    message = messageFromBytes<Message>(bytes);
  } catch (const InputError& error) {
    return maps.refuse(error.what());
  }
  maps.take(*message);
}

// A topic of maps and that of its updates.
struct Source {
  std::string map_topic, updates_topic;
  Ids of_maps, of_updates;  // connections
  RecordedMaps maps;
};

// Reads a file once.
class Reading {
 public:
  Reading(const std::string& file, ReadLimits& limits)
      : file_(file), limits_(limits), bag_(file, limits) {}

  Recording read() {
    readPlans();
    readMaps();
    for (const Source& source : sources_)
      if (source.maps.refused() > 0)
        recording_.refusals.push_back(std::to_string(source.maps.refused()) + " messages on " +
                                      source.map_topic + " and " + source.updates_topic +
                                      " were refused, as path_planner refuses them; the first: " +
                                      source.maps.firstRefusal());
    return std::move(recording_);
  }

 private:
  void readPlans() {
    const Ids ids = connectionsOfPlans();
    bag_.visit(ids, [&](const BagMessage& message) {
      limits_.take(file_, 2 * message.bytes.size());
      recording_.plans.push_back(messageFromBytes<PlanRecord>(message.bytes));
      return true;
    });
    if (recording_.plans.empty()) throw InputError(file_, "has no plans: none was made");
  }

  Ids connectionsOfPlans() const {
    Ids ids;
    bool other = false;
    for (const BagConnection& connection : bag_.connections()) {
      if (connection.type != ros::message_traits::datatype<PlanRecord>()) continue;
      if (carries<PlanRecord>(connection))
        ids.insert(connection.id);
      else
        other = true;
    }
    if (ids.empty())
      throw InputError(file_, other
                                  ? "has plans as another version of grid_path_planner records them"
                                  : "has no grid_path_planner/PlanRecord: record with record:= of "
                                    "planner.launch");
    return ids;
  }

  // The maps that some planner was given: of two vehicles there are two.
  void readMaps() {
    for (const PlanRecord& plan : recording_.plans) {
      wanted_.insert(plan.map_checksum);
      const auto same = [&](const Source& source) {
        return source.map_topic == plan.map_topic && source.updates_topic == plan.updates_topic;
      };
      if (std::none_of(sources_.begin(), sources_.end(), same)) addSource(plan);
    }
    Ids all;
    for (const Source& source : sources_) {
      all.insert(source.of_maps.begin(), source.of_maps.end());
      all.insert(source.of_updates.begin(), source.of_updates.end());
    }
    bag_.visit(all, [&](const BagMessage& message) {
      for (Source& source : sources_) takeMap(source, message.connection, message.bytes);
      return recording_.maps.size() < wanted_.size();
    });
  }

  void addSource(const PlanRecord& plan) {
    if (sources_.size() == kMostSources)
      throw InputError(
          file_, "has plans on the maps of more than " + std::to_string(kMostSources) + " topics");
    Source source = {plan.map_topic, plan.updates_topic, {}, {}, RecordedMaps(keep())};
    for (const BagConnection& connection : bag_.connections()) {
      if (carries<nav_msgs::OccupancyGrid>(connection) &&
          isNameOf(connection.topic, plan.map_topic))
        source.of_maps.insert(connection.id);
      if (carries<map_msgs::OccupancyGridUpdate>(connection) &&
          isNameOf(connection.topic, plan.updates_topic))
        source.of_updates.insert(connection.id);
    }
    sources_.push_back(std::move(source));
  }

  void takeMap(Source& source, std::uint32_t id, std::string_view bytes) {
    limits_.check(file_, kCopiesOfMap * bytes.size());
    if (source.of_maps.count(id) != 0) take<nav_msgs::OccupancyGrid>(source.maps, bytes);
    if (source.of_updates.count(id) != 0) take<map_msgs::OccupancyGridUpdate>(source.maps, bytes);
  }

  RecordedMaps::OnMap keep() {
    return [this](std::uint64_t checksum, const OccupancyGrid& map) {
      if (wanted_.count(checksum) == 0 || recording_.maps.count(checksum) != 0) return;
      limits_.take(file_, map.values().size());
      recording_.maps.emplace(checksum, std::make_shared<const OccupancyGrid>(map));
    };
  }

  const std::string& file_;
  ReadLimits& limits_;
  const BagReader bag_;
  Recording recording_;
  std::set<std::uint64_t> wanted_;
  std::vector<Source> sources_;
};

}  // namespace

ReadLimits longReading() {
  base::ReadOptions options;
  options.read_time_limit = kSeconds;
  return options;
}

Recording readRecording(const std::string& file, const ReadLimits& limits) {
  return base::readWithin(file, limits,
                          [&](ReadLimits& within) { return Reading(file, within).read(); });
}

}  // namespace grid_path_planner::nodes
