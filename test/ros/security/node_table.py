"""Every node of this package: what it hears, says and serves, and what it answers to right data.

A row is complete: every_node_rostest.py compares it with what the running node has registered, and the names of the
rows with nodelet_plugins.xml and the package's programs. Whoever adds a node adds a row.

    inputs      topics that are subscribed, with their types; those of actions are under `actions`
    outputs     topics that are published; /diagnostics, /rosout, ~parameter_refused and those of dynamic_reconfigure are left out
    services    private ones begin with ~
    actions     name: type without its ending
    arguments   of the program, so that it starts with nothing but a master; parameters go to the nodelet too
    tf          whether it listens to tf, publishes it, or both
    probe       of node_probes.py: gives right data and says whether the right answer came
"""
import collections

import node_probes as probes

Row = collections.namedtuple("Row", "inputs outputs services actions arguments tf probe")

MAPS = {"projected_map": "nav_msgs/OccupancyGrid", "projected_map_updates": "map_msgs/OccupancyGridUpdate"}
TRIGGER = "std_srvs/Trigger"
FIX = "geometry_msgs/PoseWithCovarianceStamped"


def called(action, kind):
    """What a client of an action hears, and what it says."""
    return ({action + "/result": kind + "ActionResult", action + "/feedback": kind + "ActionFeedback",
             action + "/status": "actionlib_msgs/GoalStatusArray"},
            {action + "/goal": kind + "ActionGoal", action + "/cancel": "actionlib_msgs/GoalID"})


PLANNER, DRIVER = (called("plan_path", "grid_path_planner/PlanPath"),
                   called("navigate_path", "grid_path_planner/NavigatePath"))

NODES = {
    "path_planner": Row(
        inputs=dict(MAPS, goal="geometry_msgs/PoseStamped", initialpose="geometry_msgs/PoseWithCovarianceStamped"),
        outputs={"path": "nav_msgs/Path", "planning_map": "nav_msgs/OccupancyGrid",
                 "planning_map_updates": "map_msgs/OccupancyGridUpdate",
                 "plan_statistics": "grid_path_planner/PlanStatistics",
                 "plan_record": "grid_path_planner/PlanRecord",
                 "~cost_to_go": "nav_msgs/OccupancyGrid", "~cost_to_go_image": "sensor_msgs/Image",
                 "search_markers": "visualization_msgs/MarkerArray",
                 "explanation_markers": "visualization_msgs/MarkerArray",
                 "rectangle_map": "grid_path_planner/RectangleMap",
                 "rectangle_markers": "visualization_msgs/MarkerArray"},
        services={"~make_plan": "nav_msgs/GetPlan", "~compare_plans": "grid_path_planner/ComparePlans",
                  "~explain_plan": "grid_path_planner/ExplainPlan",
                  "~save_waypoints": "grid_path_planner/SaveWaypoints"},
        actions={"plan_path": "grid_path_planner/PlanPath"},
        arguments=["_publish_rectangles:=true", "_replan_period:=0.5"], tf="listens", probe=probes.plans),
    "navigate_path": Row(
        inputs=dict(MAPS, path="nav_msgs/Path", stop="std_msgs/Bool", manual_control="std_msgs/Bool",
                    speed_limit="nav_msgs/OccupancyGrid", localization_status="std_msgs/String"),
        outputs={"cmd_vel": "geometry_msgs/Twist", "current_waypoint": "geometry_msgs/PoseStamped",
                 "drive_cancelled": "std_msgs/Empty"},
        services={"~pause": TRIGGER, "~resume": TRIGGER, "~cancel": TRIGGER},
        actions={"navigate_path": "grid_path_planner/NavigatePath"},
        arguments=["_no_progress_timeout:=0"], tf="listens", probe=probes.drives),
    "go_to_pose": Row(
        inputs=dict(PLANNER[0], **DRIVER[0], manual_control="std_msgs/Bool", drive_cancelled="std_msgs/Empty",
                    **{"move_base_simple/goal": "geometry_msgs/PoseStamped"}),
        outputs=dict(PLANNER[1], **DRIVER[1], go_to_status="grid_path_planner/GoToStatus", go_to_path="nav_msgs/Path",
                     clear_scan="std_msgs/Empty"),
        services={}, actions={"move_base": "move_base_msgs/MoveBase"}, arguments=[], tf="listens",
        probe=probes.goes_to_a_pose),
    "local_planner": Row(
        inputs={"points": "sensor_msgs/PointCloud2", "camera_info": "sensor_msgs/CameraInfo", "odom": "nav_msgs/Odometry",
                "goal": "geometry_msgs/PoseStamped", "path": "nav_msgs/Path", "stop": "std_msgs/Bool",
                "manual_control": "std_msgs/Bool"},
        outputs={"cmd_vel": "geometry_msgs/Twist", "setpoint_velocity": "geometry_msgs/TwistStamped",
                 "drive_cancelled": "std_msgs/Empty", "local_path": "nav_msgs/Path", "avoidance_status": "grid_path_planner/AvoidanceStatus",
                 "setpoint_trajectory": "trajectory_msgs/MultiDOFJointTrajectory",
                 "obstacle_distance": "sensor_msgs/LaserScan", "remembered_points": "sensor_msgs/PointCloud2",
                 "histogram_image": "sensor_msgs/Image", "avoidance_markers": "visualization_msgs/MarkerArray"},
        services={"~pause": TRIGGER, "~resume": TRIGGER, "~cancel": TRIGGER, "~explain": TRIGGER},
        actions={"navigate_path": "grid_path_planner/NavigatePath"},
        arguments=["_cloud_timeout:=10", "_no_return_clears:=10", "_recover:=false", "_stuck_timeout:=1e6"], tf="listens",
        probe=probes.flies),
    "marker_localizer": Row(
        inputs={"camera/image_raw": "sensor_msgs/Image", "camera/camera_info": "sensor_msgs/CameraInfo"},
        outputs={"marker_pose": FIX, "panel_pose": FIX, "panel_markers": "visualization_msgs/MarkerArray",
                 "marker_image": "sensor_msgs/Image"},
        services={"~learn_panel": TRIGGER}, actions={},
        arguments=["_layout:=two_markers.yaml", "_panel_known:=true"], tf="listens", probe=probes.sees_markers),
    "vehicle_localizer": Row(
        inputs={"imu/data": "sensor_msgs/Imu", "dvl/twist": "geometry_msgs/TwistWithCovarianceStamped",
                "depth": FIX, "usbl/pose": FIX, "marker_pose": FIX, "initialpose": FIX, "cmd_vel": "geometry_msgs/Twist"},
        outputs={"odometry/filtered": "nav_msgs/Odometry", "odometry/local": "nav_msgs/Odometry",
                 "localization_status": "std_msgs/String", "fix_markers": "visualization_msgs/MarkerArray"},
        services={"~set_pose": "grid_path_planner/SetPose", "~reset": TRIGGER}, actions={},
        # Others publish these transforms in the test.
        arguments=["_publish_map_to_odom:=false", "_publish_odom_to_base:=false", "_usbl_frame:=base_link",
                   "_depth_frame:=base_link"],
        tf="listens, publishes", probe=probes.estimates),
    "projected_map": Row(
        inputs={"cloud_in": "sensor_msgs/PointCloud2"},
        outputs=dict(MAPS, occupied_cells_vis_array="visualization_msgs/MarkerArray",
                     free_cells_vis_array="visualization_msgs/MarkerArray",
                     octomap_point_cloud_centers="sensor_msgs/PointCloud2"),
        services={"~reset": "std_srvs/Empty", "~clear_bbx": None, "~save_map": "grid_path_planner/SaveFile",
                  "~save_octree": "grid_path_planner/SaveFile"},
        actions={}, arguments=["_autosave_period:=0"], tf="listens", probe=probes.maps),
    "map_publisher": Row(
        inputs={}, outputs={"projected_map": "nav_msgs/OccupancyGrid", "map_metadata": "nav_msgs/MapMetaData"},
        services={"static_map": "nav_msgs/GetMap"}, actions={},
        arguments=["_filename:=projected_map.bag"], tf="", probe=probes.serves_a_map),
    "map_layers": Row(
        inputs={"static_map": "nav_msgs/OccupancyGrid", "static_map_updates": "map_msgs/OccupancyGridUpdate",
                "live_map": "nav_msgs/OccupancyGrid", "live_map_updates": "map_msgs/OccupancyGridUpdate",
                "scan": "sensor_msgs/LaserScan", "clear_scan": "std_msgs/Empty",
                "keep_out_mask": "nav_msgs/OccupancyGrid", "speed_mask": "nav_msgs/OccupancyGrid"},
        outputs=dict(MAPS, speed_limit="nav_msgs/OccupancyGrid"), services={}, actions={},
        arguments=["_zones_file:=zones.yaml", "_use_live_map:=true", "_use_scan:=true", "_use_keep_out_mask:=true",
                   "_use_speed_mask:=true", "_source_timeout:=10"],
        tf="listens", probe=probes.merges_maps),
    "simulator": Row(
        inputs={"cmd_vel": "geometry_msgs/Twist", "projected_map": "nav_msgs/OccupancyGrid"},
        outputs={"ground_truth": "nav_msgs/Odometry", "odom": "nav_msgs/Odometry", "contacts": "std_msgs/UInt32",
                 "contact": "std_msgs/String"},
        services={}, actions={}, arguments=["_publish_clock:=false"], tf="publishes", probe=probes.moves),
    "teleop_joy": Row(
        inputs={"joy": "sensor_msgs/Joy", "stop": "std_msgs/Bool"},
        outputs={"cmd_vel": "geometry_msgs/Twist", "manual_control": "std_msgs/Bool"},
        services={}, actions={}, arguments=[], tf="", probe=probes.takes_over),
}
