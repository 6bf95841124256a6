// The parameters of the node `map_layers`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/read_limits.h"
#include "layers/scan_layer_options.h"
#include "layers/speed_limits.h"

namespace grid_path_planner::layers {

// What becomes of the map while the laser or the live map is silent.
enum class StaleSource { HOLD, DROP };
const std::vector<std::pair<const char*, StaleSource>>& choicesOf(StaleSource);

struct MapLayersOptions {
  std::string map_frame = "map";
  bool use_live_map = false;
  bool use_scan = false;
  bool use_keep_out_mask = false;
  bool use_speed_mask = false;
  double source_timeout = 2.0;  // s, wall time
  StaleSource stale_source = StaleSource::HOLD;
  double tf_timeout = 0.5;  // s, wall time
  int occupied_min = 65;    // percent
  ScanLayerOptions scan;
  std::string zones_file;
  double max_speed = 0.8;  // m/s
  SpeedMaskScale speed_mask;
  double publish_rate = 10.0;     // Hz, wall time
  double full_map_period = 10.0;  // s, wall time
  base::ReadOptions reading;
};

// Groups of the options, in the order of visitOptions.
template <class Visitor>
void visitSourceOptions(MapLayersOptions& o, Visitor&& visit) {
  visit("map_frame", o.map_frame,
        base::OptionInfo{"Frame of the map; sources and zones in others are refused", ""}.under(
            "Sources"));
  visit(
      "use_live_map", o.use_live_map,
      base::OptionInfo{"Whether live_map, that of projected_map, is laid over static_map. What is "
                       "used is needed: without it there is no map",
                       ""});
  visit("use_scan", o.use_scan,
        base::OptionInfo{"Whether the obstacles of the laser on scan are laid over it", ""});
  visit("use_keep_out_mask", o.use_keep_out_mask,
        base::OptionInfo{"Whether what keep_out_mask has occupied is kept out of", ""});
  visit("use_speed_mask", o.use_speed_mask,
        base::OptionInfo{"Whether the values of speed_mask limit the speed", ""});
  visit("source_timeout", o.source_timeout,
        base::OptionInfo{
            "A laser or live map that has been silent for so long, by the wall clock, is "
            "stale; above the heartbeat_period of projected_map",
            "s", 0.1, 3600.0});
  visit("stale_source", o.stale_source,
        base::OptionInfo{"hold: while one is stale there is no map and no heartbeat, and vehicles "
                         "stand; drop: the map goes on without what it said, which is told",
                         ""});
  visit("tf_timeout", o.tf_timeout,
        base::OptionInfo{"How long a scan waits for its transform, by the wall clock", "s", 0.0,
                         10.0});
  visit("occupied_min", o.occupied_min,
        base::OptionInfo{"Cells of live_map and keep_out_mask with at least this occupancy count "
                         "where cells of other sizes are made of them",
                         "%", 1, 100});
}

template <class Visitor>
void visitOptions(MapLayersOptions& o, Visitor&& visit) {
  visitSourceOptions(o, visit);
  visitOptions(o.scan, visit);
  visit(
      "zones_file", o.zones_file,
      base::OptionInfo{"YAML file of keep-out and slow zones below the folder to load from; empty: "
                       "there are none",
                       ""}
          .under("Zones"));
  visit("max_speed", o.max_speed,
        base::OptionInfo{"max_speed of navigate_path, of which speed_limit is a percentage: with "
                         "another one there the vehicle is as much too fast in slow zones",
                         "m/s", 0.01, 100.0});
  visit("speed_mask_base", o.speed_mask.base,
        base::OptionInfo{"Percent of the speed that a value of speed_mask means: base + multiplier "
                         "* value, as nav2's SpeedFilter has it; the value 0 is no limit",
                         "%", -1e4, 1e4});
  visit("speed_mask_multiplier", o.speed_mask.multiplier,
        base::OptionInfo{"The same: 100 and -1 make 40 % of the value 60, 0 and 1 make 60 %", "%",
                         -100.0, 100.0});
  visit("publish_rate", o.publish_rate,
        base::OptionInfo{"How often changes are published", "Hz", 0.1, 100.0}.under("The map"));
  visit("full_map_period", o.full_map_period,
        base::OptionInfo{"How long after a change the whole map is sent at the latest, by the wall "
                         "clock",
                         "s", 0.1, 3600.0});
  visitOptions(o.reading, visit);
}

}  // namespace grid_path_planner::layers
