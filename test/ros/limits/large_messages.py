"""Messages that are right but for their size: a node may use them, or say that it has no room for them.

    large(node, "nav_msgs/OccupancyGrid", 160 << 20)     # None: no message of the type has a size
"""
import math
import struct

import genpy
from hostile_messages import raw, serialized

SIDE = 8192  # pixels, the most that marker_localizer takes
# Text; those of libraries that are not ours; a distortion model, of a dozen numbers.
WITHOUT = ("std_msgs/", "tf2_msgs/", "actionlib_msgs/", "sensor_msgs/CameraInfo")


def stretched(message, owner, name, count):
    """`message` with so many times the element that the array `name` of its part `owner` is given, which no list of Python's
    could hold: the first byte that differs between none and one is their number."""
    one = serialized(message)
    setattr(owner, name, [])
    none = serialized(message)
    at = next(i for i, (a, b) in enumerate(zip(none, one)) if a != b)
    element = one[at + 4:at + 4 + len(one) - len(none)]
    return raw(message, none[:at] + struct.pack("<I", count) + element * count + none[at + 4:])


def grid(message, size):
    side = int(math.sqrt(size))
    place = getattr(message, "info", message)
    place.width = place.height = side
    message.data = [0]
    return stretched(message, message, "data", side * side)


def update(message, size):
    message.x = message.y = 0
    return grid(message, size)


def path(message, size, part=None):
    part = part or message
    part.poses = part.poses[:1]
    return stretched(message, part, "poses", size // len(serialized(part.poses[0])))


def cloud(message, size):
    points = message.data
    message.width = size // len(points) * message.width * message.height
    message.data, message.row_step = points * (size // len(points)), message.width * message.point_step
    message.height = 1
    return message


def image(message, size):
    side = min(SIDE, int(math.sqrt(size)))
    message.width = message.height = message.step = side
    message.data = bytes(side * side)
    return message


def scan(message, size):
    message.angle_increment, message.ranges = 6.0 / (size // 4), [2.0]
    return stretched(message, message, "ranges", size // 4)


def joystick(message, size):
    message.buttons = [0]
    return stretched(message, message, "buttons", size // 4)


def missed(message, size):
    message.result.missed_waypoints = [0]
    return stretched(message, message.result, "missed_waypoints", size // 4)


LARGE = {"nav_msgs/OccupancyGrid": grid, "map_msgs/OccupancyGridUpdate": update, "nav_msgs/Path": path,
         "grid_path_planner/NavigatePathActionGoal": lambda message, size: path(message, size, message.goal.path),
         "grid_path_planner/NavigatePathActionResult": missed,
         "grid_path_planner/PlanPathActionResult": lambda message, size: path(message, size, message.result.path),
         "sensor_msgs/PointCloud2": cloud, "sensor_msgs/Image": image, "sensor_msgs/LaserScan": scan,
         "sensor_msgs/Joy": joystick}


def has_size(kind, message):
    """Whether an array in it has any number of elements."""
    return not kind.startswith(WITHOUT) and any(slot.endswith("[]") for slot in slots(message))


def slots(message):
    for name, kind in zip(message.__slots__, message._slot_types):
        if isinstance(getattr(message, name), genpy.Message):
            yield from slots(getattr(message, name))
        yield kind


def large(node, kind, size):
    make = LARGE.get(kind)
    return make(node.right(kind), size) if make else None
