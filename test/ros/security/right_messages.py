"""Right data for each node, as messages. `node` is a RunningNode of running_nodes.py."""
import struct
import uuid

from genpy.message import fill_message_args
from message_classes import message_class


def of(kind, **fields):
    message = message_class(kind)()
    fill_message_args(message, [fields])
    return message


def pose(x, y):
    return {"position": {"x": x, "y": y}, "orientation": {"w": 1.0}}


def header(node, frame=None):
    """Of what is in the map, unless `frame` says where the sensor was."""
    now = node.clock.now()
    return {"frame_id": node.map_frame if frame is None else frame, "stamp": {"secs": now.secs, "nsecs": now.nsecs}}


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


SKY_WIDTH, SKY_HEIGHT, SKY_FOCAL = 80, 60, 52.6
NOTHING_SEEN = struct.pack("<f", float("nan")) * 3 * SKY_WIDTH * SKY_HEIGHT


def camera_transforms(node):
    """Of the vehicle, and of a camera on it that looks ahead."""
    message = node.transforms(node.clock.now())
    camera = node.transforms(node.clock.now()).transforms[0]
    camera.child_frame_id, turn = "camera", camera.transform.rotation
    turn.x, turn.y, turn.z, turn.w = -0.5, 0.5, -0.5, 0.5
    message.transforms.append(camera)
    return message


def sky(node):
    """A cloud of that camera in which no pixel measures anything, and its calibration."""
    seen_from = header(node, "camera")
    info = of("sensor_msgs/CameraInfo", header=seen_from, width=SKY_WIDTH, height=SKY_HEIGHT,
              K=[SKY_FOCAL, 0.0, 0.5 * SKY_WIDTH, 0.0, SKY_FOCAL, 0.5 * SKY_HEIGHT, 0.0, 0.0, 1.0])
    seen = cloud(node)
    seen.header.frame_id, seen.width, seen.height = "camera", SKY_WIDTH, SKY_HEIGHT
    seen.row_step, seen.data = SKY_WIDTH * seen.point_step, NOTHING_SEEN
    return info, seen


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
    "std_msgs/Bool": lambda _: of("std_msgs/Bool", data=False),
    "std_msgs/String": lambda _: of("std_msgs/String", data="OK: the pose is known to 0.1 m"),
    "std_msgs/Empty": lambda _: of("std_msgs/Empty"),
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
