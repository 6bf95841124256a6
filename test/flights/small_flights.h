// A small study of flights in a folder of its own: a field of 12 x 8 m with a post beside the path.
#pragma once

#include <filesystem>
#include <string>

#include "support/temporary_folder.h"

namespace grid_path_planner::test {

class SmallFlights {
 public:
  // `configurations`: YAML of them; `more`: more lines of the study.
  std::string write(const std::string& configurations, const std::string& more = "",
                    const std::string& route = "[[6, 0, 1.5], [0, 0, 1.5]]") const {
    return folder.write("study.yaml",
                        "title: Small\nworlds: [field.sdf]\nvehicle: vehicle.yaml\n"
                        "start: [0, 0, 1.5, 0]\nstart_shift: 0.2\nyaw_shift: 0.1\nroute: " +
                            route + "\nfence: [0.6, 4]\ntime_limit: 30\n" + more +
                            "\nconfigurations:\n" + configurations);
  }
  static std::string program(const std::string& habit) {
    return "  - {name: " + habit + ", pilot: {program: [" +
           std::filesystem::absolute("test/flights/straight_pilot.py").string() + ", " + habit +
           "]}}\n";
  }

  const TemporaryFolder folder;
  const std::string vehicle = folder.write(
      "vehicle.yaml",
      "vehicle_radius: 0.3\nmax_surge_speed: 2\nmax_sway_speed: 2\nmax_acceleration: 2\n"
      "response_time: 0.15\nodometry_drift: 0.01\nodometry_noise: 0.02\ncamera_width: 80\n"
      "camera_height: 60\ncamera_x: 0\ncamera_z: 0\ncamera_pitch: 0\n");
  const std::string world = folder.write(
      "field.sdf",
      "<sdf version='1.6'><world name='field'>"
      "<model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane>"
      "<normal>0 0 1</normal><size>60 60</size></plane></geometry></collision></link></model>"
      "<model name='post'><static>1</static><pose>3 2 1.5 0 0 0</pose><link name='l'>"
      "<collision name='c'><geometry><cylinder><radius>0.2</radius><length>3</length></cylinder>"
      "</geometry></collision></link></model></world></sdf>");
};

}  // namespace grid_path_planner::test
