"""Right data for each node, and the right answer to it: `probe(node)` tries until it came or the deadline is over.

`node` is a RunningNode of running_nodes.py. A probe begins anew: it relies on nothing that was sent before.
"""
import struct
import time
import uuid

from genpy.message import fill_message_args
from message_classes import message_class
from roslib.message import get_service_class
from session_clock import session_seconds


def of(kind, **fields):
    message = message_class(kind)()
    fill_message_args(message, [fields])
    return message


def pose(x, y):
    return {"position": {"x": x, "y": y}, "orientation": {"w": 1.0}}


def header(node, frame="map"):
    now = node.clock.now()
    return {"frame_id": frame, "stamp": {"secs": now.secs, "nsecs": now.nsecs}}


def imu(node):
    return of("sensor_msgs/Imu", header=header(node, "base_link"), orientation={"w": 1.0}, linear_acceleration={"z": 9.8})


def dvl(node):
    message = of("geometry_msgs/TwistWithCovarianceStamped", header=header(node, "base_link"))
    message.twist.covariance = [0.01 if i % 7 == 0 else 0.0 for i in range(36)]
    return message


def grid(node):
    """8 m by 8 m and free."""
    return of("nav_msgs/OccupancyGrid", header=header(node), data=[0] * 64, info={
        "width": 8, "height": 8, "resolution": 1.0, "origin": pose(0.0, 0.0)})


def update(node):
    return of("map_msgs/OccupancyGridUpdate", header=header(node), x=7, y=7, width=1, height=1, data=[0])


def pose_stamped(node):
    return of("geometry_msgs/PoseStamped", header=header(node), pose=pose(6.5, 0.5))


def initial_pose(node):
    return of("geometry_msgs/PoseWithCovarianceStamped", header=header(node), pose={"pose": pose(0.5, 0.5)})


def path(node):
    poses = [{"header": header(node), "pose": pose(x, 0.5)} for x in (0.5, 6.5)]
    return of("nav_msgs/Path", header=header(node), poses=poses)


def joystick(_):
    return of("sensor_msgs/Joy", axes=[0.0, 1.0] + [0.0] * 6, buttons=[0, 0, 0, 0, 1] + [0] * 6)


def cloud(node):
    """A wall a metre wide, four metres ahead of the sensor."""
    points = [(4.0, 0.05 * i, 0.0) for i in range(-10, 10)]
    message = of("sensor_msgs/PointCloud2", header=header(node, "base_link"), height=1, width=len(points),
                 point_step=12, row_step=12 * len(points), is_dense=True)
    message.fields = [message_class("sensor_msgs/PointField")(name, 4 * i, 7, 1) for i, name in enumerate("xyz")]
    message.data = b"".join(struct.pack("<fff", *point) for point in points)
    return message


def scan(node, distance=2.0):
    return of("sensor_msgs/LaserScan", header=header(node, "base_link"), angle_increment=0.1, range_max=30.0,
              ranges=[distance] * 10)


# The first two tags of the family 36h11, row by row from the upper left, 1 is white.
TAG_BITS = (0x21a146bab, 0x92d18fe9b)
WIDTH, HEIGHT, CELL = 240, 120, 8  # pixels


def brightness(column, row):
    """Of two_markers.yaml, seen from its front so that a cell is 8 pixels wide."""
    for bits, left in zip(TAG_BITS, (24, 152)):
        x, y = (column - left) // CELL, (row - 28) // CELL
        if 0 <= x < 8 and 0 <= y < 8:
            inside = 0 < x < 7 and 0 < y < 7
            return 255 if inside and bits >> (35 - 6 * (y - 1) - (x - 1)) & 1 else 0
    return 255


PICTURE = bytes(brightness(column, row) for row in range(HEIGHT) for column in range(WIDTH))


def picture(node):
    return of("sensor_msgs/Image", header=header(node, "base_link"), width=WIDTH, height=HEIGHT, encoding="mono8",
              step=WIDTH, data=PICTURE)


def camera_info(node):
    return of("sensor_msgs/CameraInfo", header=header(node, "base_link"), width=WIDTH, height=HEIGHT,
              K=[120.0, 0.0, 119.5, 0.0, 120.0, 59.5, 0.0, 0.0, 1.0])


def goal_id(node):
    now = node.clock.now()
    return {"id": uuid.uuid4().hex, "stamp": {"secs": now.secs, "nsecs": now.nsecs}}


def drive_goal(node):
    goal = of("grid_path_planner/NavigatePathActionGoal", header=header(node), goal_id=goal_id(node))
    goal.goal.path = path(node)
    return goal


def plan_goal(node):
    goal = of("grid_path_planner/PlanPathActionGoal", header=header(node), goal_id=goal_id(node))
    goal.goal.start, goal.goal.goal = pose_stamped(node), pose_stamped(node)
    goal.goal.start.pose.position.x = 0.5
    return goal


def go_to_goal(node):
    goal = of("move_base_msgs/MoveBaseActionGoal", header=header(node), goal_id=goal_id(node))
    goal.goal.target_pose = pose_stamped(node)
    return goal


def result_of(kind, status):
    """Of an action that go_to_pose calls."""
    def right_result(node, identity=None):
        message = of(kind, header=header(node), status={"goal_id": identity or goal_id(node), "status": SUCCEEDED},
                     result={"status": status})
        if hasattr(message.result, "path"):
            message.result.path = path(node)
        return message
    return right_result


def feedback_of(kind):
    return lambda node: of(kind, header=header(node), status={"goal_id": goal_id(node), "status": 1})


def status_array(node):
    return of("actionlib_msgs/GoalStatusArray", header=header(node), status_list=[
        {"status": 1, "text": "a goal of somebody else's"}])


SUCCEEDED = 3
FOUND = result_of("grid_path_planner/PlanPathActionResult", "FOUND")
ARRIVED = result_of("grid_path_planner/NavigatePathActionResult", "ARRIVED")

RIGHT = {
    "nav_msgs/OccupancyGrid": grid, "map_msgs/OccupancyGridUpdate": update, "nav_msgs/Path": path,
    "geometry_msgs/PoseStamped": pose_stamped, "geometry_msgs/PoseWithCovarianceStamped": initial_pose,
    "sensor_msgs/Imu": imu, "geometry_msgs/TwistWithCovarianceStamped": dvl,
    "sensor_msgs/Joy": joystick, "sensor_msgs/PointCloud2": cloud, "sensor_msgs/LaserScan": scan,
    "sensor_msgs/CameraInfo": camera_info, "sensor_msgs/Image": picture,
    "nav_msgs/Odometry": lambda node: of(
        "nav_msgs/Odometry", header=header(node), child_frame_id="base_link", pose={"pose": pose(0.5, 0.5)}),
    "geometry_msgs/Twist": lambda _: of("geometry_msgs/Twist", linear={"x": 0.5}),
    "std_msgs/Bool": lambda _: of("std_msgs/Bool", data=False), "std_msgs/Empty": lambda _: of("std_msgs/Empty"),
    "grid_path_planner/NavigatePathActionGoal": drive_goal, "grid_path_planner/PlanPathActionGoal": plan_goal,
    "move_base_msgs/MoveBaseActionGoal": go_to_goal,
    "grid_path_planner/PlanPathActionResult": FOUND, "grid_path_planner/NavigatePathActionResult": ARRIVED,
    "grid_path_planner/PlanPathActionFeedback": feedback_of("grid_path_planner/PlanPathActionFeedback"),
    "grid_path_planner/NavigatePathActionFeedback": feedback_of("grid_path_planner/NavigatePathActionFeedback"),
    "actionlib_msgs/GoalStatusArray": status_array,
    "actionlib_msgs/GoalID": lambda node: of("actionlib_msgs/GoalID", **goal_id(node)),
    "tf2_msgs/TFMessage": lambda node: node.transforms(node.clock.now()),
}


def right(kind, node):
    return RIGHT[kind](node)


def until(node, answered, deadline, send=lambda: None, every=0.2):
    """Sends again and again until it is answered. False after the deadline (session_clock.py), or when the node has ended."""
    due = 0.0
    while node.lives():
        if answered():
            return True
        if session_seconds() > deadline:
            return False
        if time.monotonic() > due:
            send()
            due = time.monotonic() + every
        time.sleep(0.02)
    return False


def moving(twist):
    return twist.linear.x > 0.0


def succeeds(node, action, goal, deadline, done):
    """Sends the goal once, which has to be enough, and waits for `done(goal id)`."""
    node.send(action + "/goal", goal)
    return until(node, lambda: done(goal.goal_id.id), deadline)


def status_of(node, action, identity):
    for result in node.heard(action + "/result"):
        if result.status.goal_id.id == identity:
            return result.status.status
    return None


def plans(node, deadline):
    """By service and by action."""
    request = get_service_class("nav_msgs/GetPlan")._request_class()
    request.start, request.goal = initial_pose(node), pose_stamped(node)
    request.start = pose_stamped(node)
    request.start.pose.position.x = 0.5

    def answered():
        node.send("projected_map", grid(node))
        answer = node.call("~make_plan", request)
        return answer is not None and len(answer.plan.poses) > 1
    return until(node, answered, deadline) and succeeds(
        node, "plan_path", plan_goal(node), deadline,
        lambda identity: status_of(node, "plan_path", identity) == SUCCEEDED)


def drives(node, deadline):
    """A path of the topic, then a goal of the action, which is cancelled at last. A path has time to be driven, on a
    machine that is busy too, before what it is offered with cancels it."""
    def offer():
        node.send("manual_control", of("std_msgs/Bool", data=False))
        node.send("stop", of("std_msgs/Bool", data=False))
        for topic in ("projected_map", "speed_limit"):
            node.send(topic, grid(node))
        node.send("navigate_path/cancel", of("actionlib_msgs/GoalID"))
        node.call("~cancel", get_service_class("std_srvs/Trigger")._request_class())
        node.forget("cmd_vel")
        node.send("path", path(node))

    def is_driven():
        return any(moving(twist) for twist in node.heard("cmd_vel"))
    node.forget("cmd_vel")
    if not until(node, is_driven, deadline, offer, every=2.0):
        return False
    goal = drive_goal(node)
    fed = succeeds(node, "navigate_path", goal, deadline, lambda identity: any(
        feedback.status.goal_id.id == identity and feedback.feedback.state == "driving"
        for feedback in node.heard("navigate_path/feedback")))
    node.send("navigate_path/cancel", of("actionlib_msgs/GoalID", id=goal.goal_id.id))
    return fed and until(node, lambda: status_of(node, "navigate_path", goal.goal_id.id) is not None, deadline)


def goes_to_a_pose(node, deadline):
    """Its planner and its driver are these lines. A hostile cancel may be read after the first goal, and be for it too."""
    goals, due = [], [0.0]

    def answer():
        if time.monotonic() > due[0]:
            due[0] = time.monotonic() + 2.0
            goals.append(go_to_goal(node))
            node.send("move_base/goal", goals[-1])
        for topic, result in (("plan_path", FOUND), ("navigate_path", ARRIVED)):
            for asked in node.heard(topic + "/goal")[-1:]:
                stamp = asked.goal_id.stamp
                node.send(topic + "/result", result(node, {
                    "id": asked.goal_id.id, "stamp": {"secs": stamp.secs, "nsecs": stamp.nsecs}}))

    def succeeded():
        return any(status_of(node, "move_base", goal.goal_id.id) == SUCCEEDED for goal in goals)
    return until(node, succeeded, deadline, answer, every=0.1)


def says_what_it_flies_to(node, deadline):
    """A goal of the topic; whatever the clouds were, its status follows, and ~cancel ends it. A status is told when it
    changes: one that a stranger's goal brought about, and that stays with the next goal, is not told again."""
    def offer():
        node.send("manual_control", of("std_msgs/Bool", data=False))
        node.send("stop", of("std_msgs/Bool", data=False))
        node.send("goal", pose_stamped(node))

    def cancel():
        node.call("~cancel", get_service_class("std_srvs/Trigger")._request_class())

    def told(*statuses):
        return any(message.status in statuses for message in node.heard("avoidance_status"))

    def offer_and_cancel():
        offer()
        cancel()
    cancel()
    node.forget("avoidance_status")
    if not until(node, lambda: told("NO_CLOUD", "TRANSFORM_ERROR", "FLYING", "BLOCKED", "ARRIVED", "GOAL_OCCUPIED"),
                 deadline, offer, every=0.5):
        return False
    node.forget("avoidance_status")
    return until(node, lambda: told("CANCELLED", "ARRIVED"), deadline, offer_and_cancel, every=0.5)


def maps(node, deadline):
    """Who takes the updates gets the first map whole, and then what changes."""
    topics = ("projected_map", "projected_map_updates")
    node.call("~reset", get_service_class("std_srvs/Empty")._request_class())
    for topic in topics:
        node.forget(topic)

    def mapped():
        return any(max(message.data, default=0) == 100 for topic in topics for message in node.heard(topic))
    return until(node, mapped, deadline, lambda: node.send("cloud_in", cloud(node)))


def merges_maps(node, deadline):
    """What the laser sees is in the map. It sees farther each time, so that there is something to publish."""
    topics = ("projected_map", "projected_map_updates")
    for topic in topics:
        node.forget(topic)
    steps = iter(range(10**9))

    def feed():
        for topic in ("static_map", "live_map", "keep_out_mask", "speed_mask"):
            node.send(topic, grid(node))
        node.send("tf", node.transforms(node.clock.now()))  # who feeds it ends with a node that is killed
        node.send("scan", scan(node, 2.0 + next(steps) % 4))

    def merged():
        return any(max(message.data, default=0) == 100 for topic in topics for message in node.heard(topic))
    return until(node, merged, deadline, feed)


def serves_a_map(node, deadline):
    request = get_service_class("nav_msgs/GetMap")._request_class()

    def answered():
        answer = node.call("static_map", request)
        return answer is not None and answer.map.info.width > 0
    return until(node, answered, deadline)


def moves(node, deadline):
    """It stops before walls: the map is free first. It has its own time to catch up with when time jumped."""
    node.send("projected_map", grid(node))
    node.forget("ground_truth")

    def moved():
        truth = node.heard("ground_truth")
        return bool(truth) and any(abs(odometry.twist.twist.linear.x) > 0.05 for odometry in truth)
    there = of("geometry_msgs/Twist", linear={"x": 0.5})
    return until(node, moved, deadline, lambda: node.send("cmd_vel", there), every=0.1)


def takes_over(node, deadline):
    node.send("stop", of("std_msgs/Bool", data=False))
    node.forget("cmd_vel")
    return until(node, lambda: any(moving(twist) for twist in node.heard("cmd_vel")), deadline,
                 lambda: node.send("joy", joystick(node)), every=0.1)


def estimates(node, deadline):
    """An IMU and a pose that is set give a pose in the map."""
    request = get_service_class("grid_path_planner/SetPose")._request_class()
    node.forget("odometry/filtered")

    def feed():
        node.send("imu/data", imu(node))
        request.pose = initial_pose(node)
        node.call("~set_pose", request)
    return until(node, lambda: node.heard("odometry/filtered"), deadline, feed, every=0.05)


def sees_markers(node, deadline):
    """An image of the panel gives the pose of the vehicle before it."""
    node.forget("marker_pose")

    def feed():
        node.send("camera/camera_info", camera_info(node))
        node.send("camera/image_raw", picture(node))
    return until(node, lambda: any(abs(fix.pose.pose.position.z - 0.375) < 0.01 for fix in node.heard("marker_pose")),
                 deadline, feed, every=0.1)
