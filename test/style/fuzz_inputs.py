"""Which targets of the fuzzer (test/fuzz) each reader of files and each handler of messages has."""

# {source below src/: {message type as the source names it, or "file": targets}}, or a reason in Without. Where a target does
# not name the type, Part says what of the message it is given.


class Without(str):
    """Why there is no target."""


class Part(tuple):
    """The targets, and what of the message they are given."""


FILE = "file"
NO_REQUEST = Without("a request without a byte")
OWN = Without("of the system or our own build, not given by anyone")
HANDED_OVER = "claimed_lengths"  # one byte: the type alone is asked for

INPUTS = {
    # Files
    "avoidance/log/flight_log.cpp": {FILE: "flight_log"},
    "base/atomic_writing.cpp": {FILE: Without("looks for a name among the bytes of files, nothing is parsed")},
    "base/available_memory.cpp": {FILE: OWN},
    "base/yaml_file.cpp": {FILE: "yaml_text"},
    "command_line/node_config.cpp": {FILE: "node_config"},
    "flights/flight_file.cpp": {FILE: "flight_study"},
    "grid/formats/image_file.cpp": {FILE: "png_image jpeg_image bmp_image pnm_image map_file"},
    "grid/map_file.cpp": {FILE: "map_file map_server_file moving_ai_map occupancy_dump"},
    "layers/zones.cpp": {FILE: "zones"},
    "vehicle/description.cpp": {FILE: "vehicle_file"},
    "mapping/tree_file.cpp": {FILE: "octree_file"},
    "option_files/main.cpp": {FILE: OWN},
    "path/waypoint_file.cpp": {FILE: "waypoint_file"},
    "path/waypoint_formats/waypoint_formats.cpp": {FILE: "uuv_waypoints pose_array csv_waypoints geojson_waypoints"},
    "planners/rectangles/rectangle_file.cpp": {FILE: "rectangle_file rectangle_lists"},
    "ros/messages/bag.cpp": {FILE: "bag_file"},
    "ros/messages/bag_reader.cpp": {FILE: "bag_file"},
    "ros/guard/node_arguments.cpp": {FILE: Without("one byte is read, and not looked at")},
    "ros/localization/kept_heading.cpp": {FILE: "kept_heading"},
    "ros/localization/navigation_bag.cpp": {FILE: "navigation_bag"},
    "ros/mapping/map_autosave.cpp": {FILE: "kept_map octree_file"},
    "ros/planning/record/recorded_plans.cpp": {FILE: "recording"},
    "simulation/mesh_file.cpp": {FILE: "mesh_file mesh_scene"},
    "simulation/sensors/sensor_faults.cpp": {FILE: "sensor_faults"},
    "simulation/world_meshes.cpp": {FILE: "world_file world_tree"},
    "study/fingerprint.cpp": {FILE: Without("its bytes are hashed; trial_file and marker_layout read them")},
    "study/run_folder.cpp": {FILE: "study_record"},
    "study/scenario_file.cpp": {FILE: "scenario_file"},
    "study/study_file.cpp": {FILE: "study_file"},
    "trials/recorded_trial_file.cpp": {FILE: "recorded_trial"},
    "trials/trial_file.cpp": {FILE: "trial_file"},
    "trials/trial_job.cpp": {FILE: "study_record"},
    "vision/marker_layout.cpp": {FILE: "marker_layout"},

    # Programs of others that answer over a pipe
    "flights/program_pilot.cpp": {FILE: "program_answer"},
    "flights/program_process.cpp": {FILE: "program_answer"},

    # Messages, requests and parameters
    "ros/adapters/planner_adapter.cpp": {"AdapterOptions": "vehicle_config_message"},
    "ros/avoidance/flight_action.h": {"NavigatePathServer": Part(("path_message frame_messages file_name",
                                                                  "its path and its name of a file"))},
    "ros/avoidance/cloud_frames.cpp": {"sensor_msgs::CameraInfo": "local_planner_messages"},
    "ros/avoidance/cloud_frames.h": {"sensor_msgs::PointCloud2": "local_planner_messages"},
    "ros/avoidance/local_planner_node.cpp": {
        "LocalPlannerOptions": "vehicle_config_message", "geometry_msgs::PoseStamped": "frame_messages",
        "nav_msgs::Odometry": "odometry_message", "nav_msgs::Path": "local_planner_messages finished_goals frame_messages",
        "std_srvs::Trigger": NO_REQUEST},
    "ros/guard/action/action_caller.h": {
        "ActionFeedback": Part(("claimed_lengths go_to_pose_messages", "those of both actions")),
        "ActionResult": Part(("claimed_lengths go_to_pose_messages", "those of both actions")),
        "actionlib_msgs::GoalStatusArray": "goal_statuses"},
    "ros/guard/action/action_topics.h": {
        "Cancel": Part(("goal_stamps claimed_lengths", "actionlib_msgs::GoalID")),
        "Goal": Part(("goal_stamps claimed_lengths", "the stamps; what is asked for has targets of its own"))},
    "ros/messages/navigate_path_action.h": {
        "NavigatePathAction": Part(("claimed_lengths path_message file_name", "its path and its name of a file"))},
    "ros/input/map_receiver.cpp": {"map_msgs::OccupancyGridUpdate": "map_update"},
    "ros/input/whole_map_subscription.cpp": {"nav_msgs::OccupancyGrid": "map_message"},
    "ros/input/transform_receiver.cpp": {"tf2_msgs::TFMessage": "transform_message frame_messages rival_transforms"},
    "ros/gate/command_gate.cpp": {"std_msgs::Bool": HANDED_OVER},
    "ros/driving/drive_loop.cpp": {"std_msgs::String": "localization_status"},
    "ros/driving/go_to_pose_node.cpp": {"GoToPoseOptions": "vehicle_config_message",
                                        "geometry_msgs::PoseStamped": Part(("go_to_pose_messages", "as a goal of the action")),
                                        "std_msgs::Bool": HANDED_OVER, "std_msgs::Empty": HANDED_OVER},
    "ros/driving/go_to_pose_node.h": {"NavigatePathAction": Part(("go_to_pose_messages", "feedback and result")),
                                      "PlanPathAction": Part(("go_to_pose_messages", "the result"))},
    "ros/driving/joystick_loop.cpp": {"sensor_msgs::Joy": "joy_message"},
    "ros/driving/move_base_action.h": {"MoveBaseAction": Part(("go_to_pose_messages claimed_lengths", "the goal"))},
    "ros/driving/navigate_path_node.cpp": {"NavigatePathOptions": "config_message", "Trigger": NO_REQUEST,
                                           "nav_msgs::Path": "path_message finished_goals frame_messages"},
    "ros/driving/navigate_path_node.h": {"NavigatePathServer": Part(("path_message frame_messages file_name",
                                                                     "its path and its name of a file"))},
    "ros/driving/speed_limit_receiver.cpp": {"nav_msgs::OccupancyGrid": "speed_limit_map"},
    "ros/driving/teleop_joy_node.cpp": {"TeleopJoyOptions": "config_message"},
    "ros/layers/layer_inputs.cpp": {"nav_msgs::OccupancyGrid": "layer_maps", "std_msgs::Empty": HANDED_OVER},
    "ros/layers/layer_inputs.h": {"sensor_msgs::LaserScan": "scan_message"},
    "ros/layers/map_layers_node.cpp": {"MapLayersOptions": "config_message"},
    "ros/localization/marker_localizer_node.cpp": {
        "CameraInfo": "camera_info_message", "Image": "image_message", "sensor_msgs::Image": "image_message", "MarkerLocalizerOptions": "vehicle_config_message",
        "Trigger": NO_REQUEST},
    "ros/localization/marker_localizer_node.h": {
        "sensor_msgs::CameraInfo": "camera_info_message", "sensor_msgs::Image": "image_message"},
    "ros/localization/vehicle_localizer_node.cpp": {
        "Message": Part(("sensor_messages", "each by its function")), "PoseWithCovarianceStamped": "sensor_messages",
        "SetPose": "sensor_messages", "Twist": "sensor_messages", "TwistWithCovarianceStamped": "sensor_messages",
        "VehicleLocalizerOptions": "vehicle_config_message", "sensor_msgs::FluidPressure": "sensor_messages",
        "sensor_msgs::Imu": "sensor_messages", "std_srvs::Trigger": NO_REQUEST},
    "ros/localization/vehicle_localizer_node.h": {"Message": Part(("sensor_messages", "each by its function"))},
    "ros/mapping/mapping_services.cpp": {"ClearBoxService": Part(("clear_box_request", "ClearBox")),
                                         "SaveFile": Part(("file_name", "its name of a file")),
                                         "std_srvs::Empty": NO_REQUEST},
    "ros/mapping/octomap_messages.cpp": {"GetOctomap": NO_REQUEST},
    "ros/mapping/projected_map_node.cpp": {"ProjectedMapOptions": "config_message"},
    "ros/mapping/projected_map_node.h": {"sensor_msgs::PointCloud2": "cloud_message"},
    "ros/planning/map_publisher_node.cpp": {"MapPublisherOptions": "config_message", "nav_msgs::GetMap": NO_REQUEST},
    "ros/planning/path_planner_node.cpp": {
        "PathPlannerNodeOptions": "config_message", "geometry_msgs::PoseStamped": "goal_message",
        "geometry_msgs::PoseWithCovarianceStamped": Part(("goal_message", "its pose, as the start"))},
    "ros/planning/plan_action.cpp": {"PlanPathAction": Part(("plan_path_goal", "the goal"))},
    "ros/planning/plan_action.h": {"PlanPathAction": Part(("plan_path_goal", "the goal"))},
    "ros/planning/plan_services.cpp": {
        "Comparison": Part(("compare_plans_request", "ComparePlans")), "MakePlan": Part(("goal_message", "nav_msgs/GetPlan")),
        "SaveWaypoints": Part(("file_name", "its name of a file")), "Why": Part(("explain_request", "ExplainPlan"))},
    "ros/simulation/simulator_node.cpp": {"SimulatorOptions": "config_message", "geometry_msgs::Twist": "twist_message",
                                          "nav_msgs::OccupancyGrid": "map_message"},
}

# What runs in the operator's rviz and commands nothing by itself.
NOT_A_NODE = ("ros/rviz/",)
