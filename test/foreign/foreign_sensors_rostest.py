#!/usr/bin/env python3
"""Scans of other programs to map_layers, clouds to projected_map.

`expect` has
    marks    places that are occupied, and no other cell is
    points   all: those of the cloud are occupied, and no others
    refused  what the log says; nothing is marked
`ask` has no_return (of the other rays) and quaternion (of the laser on the vehicle).
"""
import math
import os
import struct
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rooms
import rospy
import rostest
import table
from foreign_nodes import ForeignTest, Row, re, wait_until
from message_classes import message_class
from right_messages import of
from roslib.message import get_service_class

NAN = float("nan")
SIDE = 0.2
LAYERS = Row(inputs={"static_map": "nav_msgs/OccupancyGrid", "scan": "sensor_msgs/LaserScan", "clear_scan": "std_msgs/Empty"},
             outputs={"projected_map": "nav_msgs/OccupancyGrid"}, services={}, actions={},
             arguments=["_use_scan:=true", "_source_timeout:=60", "_tf_timeout:=0.3"], tf="listens", probe=None)
MAPPING = Row(inputs={"cloud_in": "sensor_msgs/PointCloud2"}, outputs={"projected_map": "nav_msgs/OccupancyGrid"},
              services={"~reset": "std_srvs/Empty"}, actions={},
              arguments=["_resolution:=0.1", "_autosave_period:=0", "_tf_timeout:=0.5", "_occupancy_max_z:=1"], tf="listens", probe=None)
POINTS = [(2.05, -0.15, 0.05), (2.05, 0.05, 0.05), (2.05, 0.25, 0.05)]


def stamp_of(now):
    return {"secs": now.secs, "nsecs": now.nsecs}


def scan_of(row, now):
    """The scan of traits/scans.yaml."""
    no_return = float(row.get("ask", {}).get("no_return", NAN))
    ranges = [no_return] * 181
    ranges[135] = 3.0
    degree = math.pi / 180.0
    scan = of("sensor_msgs/LaserScan", header={"frame_id": "laser", "stamp": stamp_of(now)}, angle_min=-math.pi / 2,
              angle_max=math.pi / 2, angle_increment=degree, range_min=0.1, range_max=4.0, ranges=ranges)
    if row.get("make") == "clockwise":
        scan.angle_min, scan.angle_max, scan.angle_increment = scan.angle_max, scan.angle_min, -degree
        scan.ranges = list(reversed(ranges))
    if row.get("make") == "full_circle":
        scan.angle_min, scan.angle_max = -math.pi, math.pi
        scan.angle_increment = 2.0 * math.pi / 359
        scan.ranges = [no_return] * 360
        scan.ranges[round((math.pi + math.pi / 4) / scan.angle_increment)] = 3.0
    return table.change(scan, row.get("set"), now)


def cloud_of(points, now, fields=(("x", 0, 7), ("y", 4, 7), ("z", 8, 7)), step=12, pack=None, rows=1, padding=0, endian="<"):
    """`pack(point)` are its bytes."""
    pack = pack or (lambda point: struct.pack(endian + "fff", *point))
    width = len(points) // rows
    cloud = of("sensor_msgs/PointCloud2", header={"frame_id": "camera", "stamp": stamp_of(now)}, height=rows, width=width,
               point_step=step, row_step=width * step + padding, is_dense=True, is_bigendian=endian == ">")
    cloud.fields = [message_class("sensor_msgs/PointField")(name, offset, kind, 1) for name, offset, kind in fields]
    cloud.data = b"".join(b"".join(pack(point) for point in points[row * width:(row + 1) * width]) + bytes(padding)
                          for row in range(rows))
    return cloud


def organised(points, now):
    """Two rows, of which every other pixel has no depth."""
    pixels = [points[0], (NAN,) * 3, points[1], (NAN,) * 3, points[2], (NAN,) * 3]
    cloud = cloud_of(pixels, now, rows=2)
    cloud.is_dense = False
    return cloud


def cut_stamp(points, now):
    cloud = cloud_of(points, now)
    cloud.header.stamp.nsecs -= cloud.header.stamp.nsecs % 1000
    return cloud


INFINITE = float("inf")
CLOUDS = {
    "organised": organised, "cut_stamp": cut_stamp,
    "padded_points": lambda points, now: cloud_of(
        points, now, (("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("rgb", 16, 7)), 32,
        lambda p: struct.pack("<ffffI", p[0], p[1], p[2], 1.0, 0xff0000) + bytes(12)),
    "padded_rows": lambda points, now: cloud_of(points + points, now, rows=2, padding=20),
    "unaligned": lambda points, now: cloud_of(
        points, now, (("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("intensity", 12, 7), ("tag", 16, 2), ("line", 17, 2)), 18,
        lambda p: struct.pack("<ffff", p[0], p[1], p[2], 9.0) + b"\1\2"),
    "other_order": lambda points, now: cloud_of(points, now, (("z", 0, 7), ("x", 4, 7), ("y", 8, 7)), 12,
                                                lambda p: struct.pack("<fff", p[2], p[0], p[1])),
    "doubles": lambda points, now: cloud_of(points, now, (("x", 0, 8), ("y", 8, 8), ("z", 16, 8)), 24,
                                            lambda p: struct.pack("<ddd", *p)),
    "big_endian": lambda points, now: cloud_of(points, now, endian=">"),
    "with_zeros": lambda points, now: cloud_of(points + [(0.0, 0.0, 0.0)] * 20, now),
    "with_infinities": lambda points, now: cloud_of(
        points + [(INFINITE,) * 3, (-INFINITE,) * 3, (1.0, INFINITE, 0.0)], now),
    "polar": lambda points, now: cloud_of(points, now, (("range", 0, 7), ("bearing", 4, 7), ("z", 8, 7))),
    "integers": lambda points, now: cloud_of(points, now, (("x", 0, 3), ("y", 2, 3), ("z", 4, 3)), 6,
                                             lambda p: struct.pack("<hhh", *(int(1000 * v) for v in p))),
    "no_points_then_right": cloud_of}


class Sensors(ForeignTest):
    kind = "scans"

    def test_scans(self):
        node = self.node("map_layers", LAYERS)
        free = rooms.grid(self.now(), [0] * 1600, 40, 40, SIDE, (-4.0, -4.0))
        node.send("static_map", free)
        self.each("map_layers", lambda row, expect: self.scanned(node, row, expect))

    def scanned(self, node, row, expect):
        node.frames = {"base_link": {"parent": "map"},
                       "laser": {"parent": "base_link", "quaternion": tuple(row.get("ask", {}).get("quaternion", (0, 0, 0, 1)))}}
        node.send("clear_scan", of("std_msgs/Empty"))
        blind = of("sensor_msgs/LaserScan", header={"frame_id": "laser"}, angle_increment=0.1, range_min=0.1, range_max=4.0,
                   ranges=[NAN] * 5)

        def look():
            now = self.now()
            blind.header.stamp = type(now)(now.secs, now.nsecs)
            node.send("scan", blind)

        def marks():
            heard = node.heard("projected_map")
            if not heard:
                return None
            return sorted(index for index, value in enumerate(heard[-1].data) if value == 100)
        if not wait_until(lambda: marks() == [], send=look, every=0.2):
            return "the map without marks does not come: " + node.said()[-900:]
        node.mark()
        wanted = sorted(self.cell(*place) for place in expect.get("marks", []))

        def send():
            node.send("scan", scan_of(row, self.now()))
        if "refused" in expect:
            if not wait_until(lambda: node.says(expect["refused"]), 20.0, send):
                return "it says: " + node.said(node.marked)
            return "" if marks() == [] else "it marks all the same"
        seconds = 3.0 if row.get("open") else 20.0
        return "" if wait_until(lambda: marks() == wanted, seconds, send) else "marks %r, not %r; %s" % (
            marks(), wanted, node.said(node.marked)[-300:])

    @staticmethod
    def cell(x, y):
        return int((y + 4.0) / SIDE) * 40 + int((x + 4.0) / SIDE)

    def test_clouds_of_projected_map(self):
        node = self.node("projected_map", MAPPING)
        self.each("projected_map", lambda row, expect: self.mapped(node, row, expect), table.rows("clouds"))

    def send_cloud(self, node, topic, row, points):
        now = self.now()
        if row.get("make") == "no_points_then_right":
            node.send(topic, cloud_of([], now))
        cloud = CLOUDS[row["make"]](points, now) if "make" in row else cloud_of(points, now)
        node.send(topic, table.change(cloud, row.get("set"), now))

    def mapped(self, node, row, expect):
        node.frames = {"base_link": {"parent": "map"}, "camera": {"parent": "base_link"}}
        node.call("~reset", get_service_class("std_srvs/Empty")._request_class())
        node.forget("projected_map")
        node.mark()

        def occupied():
            heard = node.heard("projected_map")
            if not heard or not heard[-1].data:
                return set()
            info = heard[-1].info
            return {(round(info.origin.position.x + (index % info.width + 0.5) * info.resolution, 3),
                     round(info.origin.position.y + (index // info.width + 0.5) * info.resolution, 3))
                    for index, value in enumerate(heard[-1].data) if value == 100}

        def send():
            self.send_cloud(node, "cloud_in", row, POINTS)
        if "refused" in expect:
            if not wait_until(lambda: node.says(expect["refused"]), 20.0, send):
                return "it says: " + node.said(node.marked)
            return "it is mapped" if occupied() else ""
        wanted = {(x, y) for x, y, _ in POINTS}
        seconds = 3.0 if row.get("open") else 20.0
        return "" if wait_until(lambda: occupied() == wanted, seconds, send) else "occupied: %r; %s" % (
            sorted(occupied()), node.said(node.marked)[-300:])


if __name__ == "__main__":
    rospy.init_node("foreign_sensors", disable_signals=True)
    rostest.rosrun("grid_path_planner", "foreign_sensors", Sensors)
