"""Which rows of test/ros/limits have each source that writes files: every_writer asks them on a disk that is full, and on one that
is read-only."""


class Without(str):
    """Why it has none."""


BY_THESE = Without("what others write by")
A_TOOL = Without("of our own build, which ninja makes again")

# {source below src/: rows of scripts/storms/node_writers.py and test/ros/limits/commands.py}
WRITERS = {
    "avoidance/log/flight_log.cpp": "flight_log fresh_flight",
    "base/atomic_writing.cpp": BY_THESE,
    "base/streamed_file.cpp": BY_THESE,
    "command_line/convert.cpp": "convert_yaml convert_map convert_png convert_pgm",
    "command_line/plan.cpp": "plan_image plan_waypoints",
    "command_line/project.cpp": "project project_image",
    "command_line/rectangles.cpp": "rectangles_file",
    "command_line/rectangles_output.cpp": "rectangles_image",
    "command_line/replay.cpp": "replay",
    "command_line/scenarios.cpp": "scenarios",
    "command_line/waypoints.cpp": "waypoints_yaml waypoints_csv",
    "flights/flight_job.cpp": "flights fresh_flights fresh_flight",
    "flights/flight_pilot.cpp": "fresh_flight",
    "flights/report/flight_report.cpp": "flights",
    "grid/formats/image_file.cpp": "convert_png convert_pgm",
    "grid/formats/map_server_file.cpp": "convert_yaml save_map",
    "grid/formats/moving_ai_file.cpp": "convert_map",
    "mapping/map_model.cpp": "save_map",
    "mapping/octree_map.cpp": "save_octree_bt save_octree_ot",
    "mapping/tree_file.cpp": "save_octree_bt save_octree_ot",
    "option_files/main.cpp": A_TOOL,
    "path/path_image.cpp": "plan_image",
    "path/waypoint_file.cpp": "plan_waypoints save_waypoints",
    "path/waypoint_formats/waypoint_formats.cpp": "waypoints_yaml waypoints_csv",
    "planners/rectangles/rectangle_file.cpp": "rectangles_file",
    "ros/avoidance/local_planner_node.cpp": "flight_log",
    "ros/avoidance/logged_pilot.cpp": "flight_log",
    "ros/guard/node_files.cpp": BY_THESE,
    "ros/guard/outgoing/unread_log.cpp": Without("the pipe of the node's own log, opened again"),
    "ros/localization/kept_heading.cpp": Without("vehicle_localizer_restart: a folder that cannot keep it is told"),
    "ros/mapping/map_autosave.cpp": "autosave",
    "ros/mapping/mapping_services.cpp": "save_map save_octree_bt save_octree_ot",
    "ros/planning/path_planner_node.cpp": Without("asks whether a name may be written"),
    "ros/planning/plan_services.cpp": "save_waypoints",
    "ros/planning/planning_server.cpp": "waypoints_file",
    "ros/rviz/panel_questions.cpp": Without("the panel of a person who is told, by writeWaypointFile as in plan_waypoints"),
    "study/run_folder.cpp": "study fresh_study fresh_flights fresh_localization",
    "study/study_job.cpp": "study fresh_study",
    "trials/recorded_job.cpp": "recorded fresh_recorded",
    "trials/report/recorded_report.cpp": "recorded",
    "trials/report/trial_report.cpp": "localization",
    "trials/track_file.cpp": "fresh_localization",
    "trials/trial_job.cpp": "localization fresh_localization",
}
