"""The room of traits/maps.yaml, and what other publishers make of it.

20x12 cells of 0.5 m; the wall in column 10 leaves a gap of three cells at the top. `before` is the room without its wall.
"""
import copy
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "ros", "security"))
from genpy import Duration
from right_messages import of

WIDTH, HEIGHT, WALL, GAP = 20, 12, 10, 3
SIDE = 0.5  # m
START, GOAL = (1.25, 1.25), (6.25, 1.25)
AROUND = 4 * SIDE + 8 * SIDE * math.sqrt(2.0)  # m, from START to GOAL through the gap
STRAIGHT = GOAL[0] - START[0]


def cells(occupied=100, free=0):
    return [occupied if column == WALL and row < HEIGHT - GAP else free for row in range(HEIGHT) for column in range(WIDTH)]


def grid(stamp, values, width=WIDTH, height=HEIGHT, side=SIDE, origin=(-1.0, -1.0)):
    return of("nav_msgs/OccupancyGrid", header={"frame_id": "map", "stamp": {"secs": stamp.secs, "nsecs": stamp.nsecs}},
              data=values, info={"width": width, "height": height, "resolution": side, "origin": {
                  "position": {"x": origin[0], "y": origin[1]}, "orientation": {"w": 1.0}},
                  "map_load_time": {"secs": stamp.secs, "nsecs": stamp.nsecs}})


def room(stamp):
    return grid(stamp, cells())


def before(stamp):
    return grid(stamp, cells(0))



def later(stamp, by):
    return stamp + Duration.from_sec(by)


def without_cells(stamp, resolution=SIDE, frame=""):
    message = grid(stamp, [], 0, 0, resolution, (0.0, 0.0))
    message.header.frame_id = frame
    message.info.origin.orientation.w = 0.0
    return message


def empty_first(stamp):
    return [without_cells(stamp), room(stamp)]


def reset_between(stamp):
    return [before(stamp), without_cells(stamp, 0.0, "map"), room(stamp)]


def grown(stamp):
    """Of a map that held the part in the north-east first."""
    part = [value for row in range(4, HEIGHT) for value in cells()[row * WIDTH + 4:(row + 1) * WIDTH]]
    return [grid(stamp, part, WIDTH - 4, HEIGHT - 4, SIDE, (1.0, 1.0)), room(stamp)]


def older_second(stamp):
    return [before(later(stamp, 0.1)), room(stamp)]


def same_stamp(stamp):
    return [before(stamp), room(stamp)]


def by_another_node(stamp):
    return [room(stamp)]


def fine(stamp):
    return [grid(stamp, [0] * 100 * 40, 100, 40, 0.05, (0.0, 0.0))]


def greys(stamp):
    return [grid(stamp, [(index * 7) % 26 if value == 0 else 65 + index % 36 for index, value in enumerate(cells())])]


def young_greys(stamp):
    return [grid(stamp, cells(57, 38))]


def raw(stamp):
    return [grid(stamp, cells(-51))]


def costs(stamp):
    """Lethal only every second cell of the wall, inscribed between them and beside it, falling costs farther off."""
    values = []
    for row in range(HEIGHT):
        for column in range(WIDTH):
            distance = abs(column - WALL) if row < HEIGHT - GAP else WIDTH
            values.append((100 if row % 2 else 99) if distance == 0 else {1: 60, 2: 26}.get(distance, 0))
    return [grid(stamp, values)]


def turned(stamp):
    message, yaw = room(stamp), math.pi / 6
    position, orientation = message.info.origin.position, message.info.origin.orientation
    position.x, position.y = rotated((position.x, position.y), yaw)
    orientation.z, orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return [message]


def rotated(point, yaw):
    return (point[0] * math.cos(yaw) - point[1] * math.sin(yaw), point[0] * math.sin(yaw) + point[1] * math.cos(yaw))


MAKES = {make.__name__: make for make in (
    empty_first, reset_between, grown, older_second, same_stamp, by_another_node, fine, greys, young_greys, raw, costs, turned)}


def messages_of(row, stamp):
    """What the row's publisher sends, in its order; `set` is done to the last."""
    messages = MAKES[row["make"]](stamp) if "make" in row else [room(stamp)]
    messages[-1] = copy.deepcopy(messages[-1])
    return messages
