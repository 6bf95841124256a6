"""Includes only point down the floors of the rooms, private headers are included by their own room only, but
for those of LENT, and ROS is seen in ros/, nodes/ and command_line/ only.

The rooms below a room are read from the gpp_add_room lines of src/*/CMakeLists.txt. The folders inside
planners/ have floors too: PLANNER_FLOORS. The hash of the sources that decide the runs of a study is of its room and all
rooms below it: one that is left out is changed, and runs of before are gone on with.
"""
import os
import re

from common import PLANTED, ROOT, files, finish, read

PACKAGE = "grid_path_planner"
PROGRAMS = {"nodes", "command_line", "option_files", "read_world"}  # they may use every room and the private headers of ros/
ROS_ROOMS = {"ros"} | PROGRAMS
PLANNER_FLOORS = {
    "core": set(),
    "tables": {"core"},
    "astar": {"core", "tables"},
    "replanning": {"core", "tables", "astar"},
    "jump_point": {"core", "tables", "astar", "replanning"},
    "rectangles": {"core"},
    "any_angle": {"core", "rectangles", "tables", "astar"},
}
# Private headers that rooms above include too, though no other package should.
LENT = {
    "path/clearance_meter.h": {"ros_planning"},
    "path/straight_runs.h": {"planning"},
    "planning/vehicle_options.h": {"command_line", "ros_planning"},
    "base/available_memory.h": {"mapping", "planners"},
    "base/child_process.h": {"simulation"},
    "base/cholesky.h": {"localization", "trials", "vision"},
    "base/committed.h": {"planning", "ros_planning"},
    "base/current_error.h": {"ros_adapters", "ros_avoidance", "ros_guard", "ros_driving", "ros_planning", "ros_rviz"},
    "base/plain_text.h": {"ros_guard", "simulation"},
    "base/deflate.h": {"grid", "planners"},
    "base/rebuildable.h": {"planning"},
    "base/seconds_since.h": {"mapping", "ros_gate", "ros_guard", "ros_input", "ros_driving", "ros_layers", "ros_mapping", "ros_planning"},
    "base/shell_text.h": {"command_line", "flights", "study"},
    "base/utf8.h": {"study"},
    "base/zeroed_array.h": {"planners"},
    "costmap/inflation.h": {"planning"},  # the distances that it keeps
    "following/footprint_clearance.h": {"ros_driving"},
    "following/go_to/navigator.h": {"ros_driving"},
    "following/go_to/navigator_options.h": {"ros_driving"},
    "path/zigzags.h": {"planning"},
    "grid/float_decimal.h": {"ros_messages"},
    "grid/foreign_values.h": {"planning", "ros_input", "ros_messages"},
    "grid/fewer_rects.h": {"ros_messages"},
    "grid/map_differences.h": {"planning", "ros_input", "ros_planning"},
    "grid/formats/rectangle_map_file.h": {"planners"},
    "following/speed_limit.h": {"ros_driving"},
    "grid/grid_alignment.h": {"layers"},
    "grid/level_grid.h": {"layers", "ros_layers"},
    "grid/segment.h": {"path", "planning", "vehicle"},
    "grid/polygon_cover.h": {"layers", "vehicle"},
    "layers/layered_map.h": {"ros_layers"},
    "layers/map_layers_options.h": {"option_files"},
    "layers/scan_layer.h": {"ros_layers"},
    "localization/chi_squared.h": {"trials"},
    "localization/filter_options.h": {"trials"},
    "localization/input_statistics.h": {"ros_localization", "trials"},
    "localization/lagged_filter.h": {"ros_localization"},
    "localization/localizer_options.h": {"ros_localization"},
    "localization/measurement.h": {"ros_localization", "trials"},
    "localization/measurement_check.h": {"ros_localization"},
    "localization/measurement_models.h": {"ros_localization"},
    "localization/mounted_pose.h": {"ros_localization", "trials"},
    "localization/so3.h": {"trials"},
    "localization/vehicle_localizer.h": {"ros_localization"},
    "panel/panel_model.h": {"ros_rviz"},
    "panel/path_corners.h": {"ros_rviz"},
    "panel/planner_colours.h": {"ros_rviz"},
    "panel/route_points.h": {"ros_rviz"},
    "panel/shown_text.h": {"ros_rviz"},
    "path/waypoint_formats/waypoint_formats.h": {"command_line"},
    "path/dubins.h": {"planning"},
    "path/motions.h": {"command_line", "following", "planning"},
    "path/pose_spacing.h": {"planning", "ros_adapters", "ros_planning"},
    "planning/cost_planner.h": {"ros_adapters"},
    "planning/cost_planner_options.h": {"ros_adapters"},
    "planners/tables/cost_to_go.h": {"ros_planning"},
    "planning/map_store.h": {"ros_planning"},
    "planning/via/via_plan.h": {"command_line", "ros_planning"},
    "planners/any_angle/theta_star.h": {"study"},  # the base of its published Theta*
    "planners/astar/bucket_search.h": {"planning"},
    "planners/rectangles/rectangle_route.h": {"command_line"},
    "study/confidence.h": {"flights"},
    "study/file/study_nodes.h": {"flights", "trials"},
    "study/fingerprint.h": {"flights", "trials"},
    "study/json_numbers.h": {"flights", "trials"},
    "study/report/finding.h": {"flights", "trials"},
    "study/report/markdown.h": {"flights", "trials"},
    "study/report/markup.h": {"flights", "trials"},
    "study/report/report_page.h": {"flights", "trials"},
    "study/report/svg_chart.h": {"flights", "trials"},
    "study/report/table.h": {"flights"},
    "study/run_folder.h": {"flights", "trials"},
    "study/study_yaml.h": {"flights", "trials"},
    "study/task_loop.h": {"flights", "trials"},
    "planning/explanation.h": {"command_line", "ros_planning"},
    "seen_map/seen_map.h": {"flights", "ros_avoidance"},
    "simulation/read_world_main.h": {"read_world"},
    "simulation/camera/image_camera.h": {"ros_simulation", "trials"},
    "simulation/camera/image_camera_options.h": {"ros_simulation", "trials"},
    "simulation/camera/pinhole.h": {"ros_simulation", "trials"},
    "simulation/mesh_bytes.h": {"flights", "trials"},  # what a world is, for the hash of a study
    "simulation/sensors/dvl.h": {"trials"},
    "simulation/sensors/imu.h": {"trials"},
    "simulation/sensors/navigation_sensor_options.h": {"ros_simulation", "trials"},
    "simulation/sensors/navigation_sensors.h": {"ros_simulation"},
    "simulation/sensors/pressure_sensor.h": {"trials"},
    "simulation/sensors/sensor_faults.h": {"ros_simulation"},
    "simulation/sensors/usbl.h": {"trials"},
    "localization/recording/navigation_recording.h": {"ros_localization", "trials"},
    "trials/recorded_job.h": {"command_line"},
    "trials/trial_job.h": {"command_line"},
    "vehicle/commanded_velocity.h": {"ros_driving"},
    "vehicle/description.h": {"following", "planning", "ros_driving", "ros_messages", "ros_planning", "ros_simulation"},
    "vehicle/footprint.h": {"following", "planning", "ros_driving", "ros_planning"},
    "vehicle/map_obstacles.h": {"following", "simulation"},
    "vehicle/motion.h": {"path"},
    "vehicle/motion_check.h": {"ros_driving"},
    "vehicle/outline.h": {"simulation"},
    "vehicle/sweep.h": {"planning"},
    "vision/camera_calibration.h": {"ros_localization"},
    "vision/grey_conversion.h": {"ros_localization", "trials"},
    "vision/marker_picture.h": {"ros_localization"},
    "vision/marker_pose.h": {"ros_localization", "trials"},
    "vision/marker_pose_options.h": {"ros_localization", "trials"},
    "vision/mean_pose.h": {"trials"},
    "vision/panel_learning.h": {"ros_localization"},
    "vision/panel_learning_options.h": {"ros_localization"},
    "vision/pose_candidates.h": {"trials"},
}
ROS_HEADER = re.compile(
    r"(ros|tf2\w*|nodelet|pluginlib|rosbag|actionlib|dynamic_reconfigure|diagnostic_updater|topic_tools"
    r"|\w+_msgs|std_srvs|%s/[A-Z]\w*)(/.*|\.h)?$" % PACKAGE)


def floors():
    """Each library with all the libraries below it, itself included. Those of ros/ are ros_<component>."""
    direct = {}
    for name in files(("src",), ("CMakeLists.txt",)):
        for room, arguments in re.findall(r"gpp_add_room\((\w+)([^)]*)\)", read(name)):
            rooms = re.search(r"ROOMS((?:\s+(?!LIBRARIES)[a-z_]+)+)", arguments)
            direct[room] = rooms.group(1).split() if rooms else []

    def closure(room):
        found = {room}
        for below in direct[room]:
            found |= closure(below)
        return found
    return {room: closure(room) for room in direct}


def room_of(name):
    """The room of a file; for the folders of ros/ the library."""
    parts = name.split("/")
    room = parts[2] if parts[0] == "include" else parts[1]
    if room == "ros":
        return "ros_" + (parts[2] if parts[0] == "src" else "messages")
    return room


def folders_of_planners(names):
    """The folder of src/planners/ that each header of planners/ belongs to; a public one to that of its .cpp."""
    folders = {}
    for name in names:
        match = re.match(r"src/planners/(\w+)/(\w+)\.(?:h|cpp)$", name)
        if match:
            folders[match.group(2)] = match.group(1)
    return folders


def planner_complaint(name, header, folders):
    stem = os.path.splitext(os.path.basename(name))[0]
    here = folders.get(stem)
    there = folders.get(os.path.splitext(os.path.basename(header))[0], "core")
    if here is None or here == there or there in PLANNER_FLOORS.get(here, set()):
        return None
    return "planners/%s stands not on planners/%s" % (here, there)


def complaint_of(name, header, below, folders):
    room = room_of(name)
    if header.startswith("../"):
        return "reaches into another folder"
    public = re.match(PACKAGE + r"/([a-z_]+)/", header)
    target = public.group(1) if public else None
    if not public and os.path.exists(os.path.join(ROOT, "src", header)):
        target = room_of("src/" + header)
        base, target_base = room.split("_")[0], target.split("_")[0]
        own = room == target or base == target_base == "ros" or room in LENT.get(header, set())
        if not own and not (room in PROGRAMS and target_base == "ros"):
            return "'%s' is a private header of '%s'" % (header, target)
    if target is None:
        if room.split("_")[0] not in ROS_ROOMS and room not in PROGRAMS and ROS_HEADER.match(header):
            return "ROS in room '%s': %s" % (room, header)
        return None
    if target == "ros":
        target = "ros_messages"
    if room in PROGRAMS:
        return None
    if target not in below.get(room, {room}):
        return "room '%s' stands not on '%s'" % (room, target)
    if room == target == "planners":
        return planner_complaint(name, header, folders)
    return None


def hash_complaints(below):
    for name in files(("src",), ("CMakeLists.txt",)):
        for room, rooms in re.findall(r"gpp_add_sources_hash\((\w+)([^)]*)\)", read(name)):
            for other in sorted(below.get(room, {room}) ^ set(rooms.split())):
                yield "%s: the hash of the sources of '%s' and what it stands on differ by '%s'" % (name, room, other)


def main():
    below = floors()
    names = files(("include", "src"), (".h", ".cpp"))
    folders = folders_of_planners(names)
    complaints, borrowed = list(hash_complaints(below)), set()
    for name in names:
        room = room_of(name)
        if room not in below and room not in PROGRAMS:
            complaints.append("%s: no CMakeLists.txt makes room '%s'" % (name, room))
            continue
        for number, line in enumerate(read(name).splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
            if match:
                borrowed.add((match.group(1), room))
            complaint = complaint_of(name, match.group(1), below, folders) if match else None
            if complaint:
                complaints.append("%s:%d: %s" % (name, number, complaint))
    complaints += ["%s is not included by '%s': strike that from LENT in check_includes.py" % (header, room)
                   for header, rooms in sorted(LENT.items()) for room in sorted(rooms)
                   if not PLANTED and (header, room) not in borrowed]
    finish(complaints, "%d files of %d rooms" % (len(names), len(below)) if below else "0 rooms")


main()
