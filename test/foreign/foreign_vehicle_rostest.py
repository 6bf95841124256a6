#!/usr/bin/env python3
"""What other programs tell of the vehicle: images to marker_localizer, its sensors to vehicle_localizer, transforms to those who
plan and drive.

`expect` has
    pose       base: that of the plain image
    taken      the sensor by whose name the diagnostics count it, and nothing is refused
    length     m that are planned from the vehicle, and that are left to drive
    refused    what the log, the diagnostics or the answer say
`ask` has the topic.
"""
import math
import os
import shutil
import struct
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import foreign_nodes
import rooms
import rospy
import rostest
import table
from foreign_nodes import ForeignTest, Row, re, wait_until
from message_classes import message_class
from right_messages import HEIGHT, PICTURE, WIDTH, camera_info, dvl, header, imu, of, picture, pose, pose_stamped
from roslib.message import get_service_class

ENOUGH = float(os.environ.get("ENOUGH", "20"))  # s, for what has to come
LAYOUT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "two_markers.yaml")
FIX = "geometry_msgs/PoseWithCovarianceStamped"
CAMERA = Row(inputs={"camera/image_raw": "sensor_msgs/Image", "camera/camera_info": "sensor_msgs/CameraInfo"},
             outputs={"marker_pose": FIX}, services={}, actions={}, arguments=["_layout:=two_markers.yaml", "_panel_known:=true"],
             tf="listens", probe=None)
SENSORS = Row(inputs={"imu/data": "sensor_msgs/Imu", "dvl/twist": "geometry_msgs/TwistWithCovarianceStamped",
                      "pressure": "sensor_msgs/FluidPressure", "marker_pose": FIX}, outputs={}, services={}, actions={},
              arguments=["_publish_map_to_odom:=false", "_publish_odom_to_base:=false", "_use_pressure:=true"], tf="listens", probe=None)
NAMES = {"imu/data": "IMU", "dvl/twist": "DVL", "pressure": "depth", "marker_pose": "marker pose"}
PLANNER = Row(inputs={"projected_map": "nav_msgs/OccupancyGrid"}, outputs={}, services={"~make_plan": "nav_msgs/GetPlan"}, actions={},
              arguments=["_outside:=free"], tf="listens", probe=None)
DRIVER = Row(inputs={}, outputs={}, services={}, actions={"navigate_path": "grid_path_planner/NavigatePath"},
             arguments=["_check_map:=false", "_no_progress_timeout:=0"], tf="listens", probe=None)


def wide(value):
    return 257 * value


def coded(encoding, pixels, step, **fields):
    return lambda image: [setattr(image, *field) for field in dict(fields, encoding=encoding, data=pixels, step=step).items()]


PICTURES = {
    "bgra8": coded("bgra8", b"".join(bytes((v, v, v, 255)) for v in PICTURE), 4 * WIDTH),
    "rgb8": coded("rgb8", b"".join(bytes((v, v, v)) for v in PICTURE), 3 * WIDTH),
    "mono16": coded("mono16", b"".join(struct.pack("<H", wide(v)) for v in PICTURE), 2 * WIDTH),
    "mono16_big": coded("mono16", b"".join(struct.pack(">H", wide(v)) for v in PICTURE), 2 * WIDTH, is_bigendian=1),
    "padded": coded("mono8", b"".join(PICTURE[row * WIDTH:(row + 1) * WIDTH] + bytes(16) for row in range(HEIGHT)), WIDTH + 16),
    "8UC1": coded("8UC1", PICTURE, WIDTH)}


class Vehicle(ForeignTest):
    kind = "images"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        shutil.copy(LAYOUT, cls.folder.name)
        cls.diagnostics = {}
        rospy.Subscriber("/diagnostics", message_class("diagnostic_msgs/DiagnosticArray"), cls.note)

    @classmethod
    def note(cls, array):
        for status in array.status:
            cls.diagnostics[status.name.split("/")[-1]] = {entry.key: entry.value for entry in status.values}

    def counted(self, name, ending):
        """What the newest diagnostics have under such keys: how many in all, or the texts."""
        values = [value for key, value in self.diagnostics.get(name, {}).items() if key.endswith(ending)]
        return " ".join(values) if ending.endswith("because") else sum(map(int, values))

    def refuses(self, node, name, before, sentence):
        """Once more than before, and why."""
        if self.counted(name, "refused") <= before:
            return False
        return re.search(sentence, self.counted(name, "refused last because")) or node.says(sentence)

    # Images

    def test_images(self):
        node = self.node("marker_localizer", CAMERA)
        self.plain = None
        self.each("marker_localizer", lambda row, expect: self.seen(node, row, expect))

    def look(self, node, row):
        now = self.now()
        node.send("camera/camera_info", table.change(camera_info(node), row.get("info"), now))
        image = picture(node)
        PICTURES.get(row.get("make"), lambda _: None)(image)
        node.send("camera/image_raw", table.change(image, row.get("set"), now))

    def seen(self, node, row, expect):
        name = "marker_localizer: markers"

        def poses():
            return [fix.pose.pose.position for fix in node.heard("marker_pose")]
        node.forget("marker_pose")
        if not wait_until(poses, send=lambda: self.look(node, {}), every=0.3):
            return "the plain image gives no pose: " + node.said()[-600:]
        self.plain = self.plain or poses()[-1]
        node.mark()
        wait_until(lambda: False, 1.2)  # the diagnostics have what came until now
        node.forget("marker_pose")
        before = self.counted(name, "refused")
        if "refused" in expect:
            told = wait_until(lambda: self.refuses(node, name, before, expect["refused"]), ENOUGH, lambda: self.look(node, row), 0.3)
            return "" if told else "%s: %s" % (self.counted(name, "refused last because"), node.said(node.marked))

        def same():
            return any(math.dist((p.x, p.y, p.z), (self.plain.x, self.plain.y, self.plain.z)) < 1e-3 for p in poses())
        if not wait_until(same, ENOUGH, lambda: self.look(node, row), 0.3):
            return "poses: %r; refused because: %s" % (poses()[-1:], self.counted(name, "refused last because"))
        wait_until(lambda: False, 1.2)
        return "" if self.counted(name, "refused") == before else "refused too: " + self.counted(name, "refused last because")

    # Navigation

    def test_navigation(self):
        node = self.node("vehicle_localizer", SENSORS)
        node.frames = {"base_link": {"parent": "odom"}}
        self.each("vehicle_localizer", lambda row, expect: self.measured(node, row, expect), table.rows("navigation"))

    def measurement(self, node, topic):
        if topic == "imu/data":
            return imu(node)
        if topic == "dvl/twist":
            return dvl(node)
        if topic == "pressure":
            return of("sensor_msgs/FluidPressure", header=header(node, "base_link"), fluid_pressure=120900.0)
        fix = of(FIX, header=header(node), pose={"pose": pose(0.5, 0.5)})
        fix.pose.covariance = [0.01 if i % 7 == 0 else 0.0 for i in range(36)]
        return fix

    def measured(self, node, row, expect):
        topic = row["ask"]["topic"]
        name = "vehicle_localizer: " + NAMES[topic]

        def send(changes=None):
            node.send("imu/data", self.measurement(node, "imu/data"))
            message = self.measurement(node, topic)
            node.send(topic, table.change(message, changes, self.now()))

        def received():
            return int(self.diagnostics.get(name, {}).get("received", 0))
        began = received()
        if not wait_until(lambda: received() > began, send=send, every=0.1):
            return "the plain message is not heard: " + node.said()[-600:]
        wait_until(lambda: False, 1.2)
        node.mark()
        before, came = self.counted(name, "refused"), received()
        if "refused" in expect:
            told = wait_until(lambda: self.refuses(node, name, before, expect["refused"]), ENOUGH, lambda: send(row["set"]), 0.1)
            return "" if told else "%r: %s" % (self.diagnostics.get(name), node.said(node.marked))
        if not wait_until(lambda: received() > came + 3, ENOUGH, lambda: send(row["set"]), 0.1):
            return "it is not heard"
        return "" if self.counted(name, "refused") == before else self.counted(name, "refused last because")

    # Transforms: of a node of its own each, since tf remembers.

    def test_transforms_of_path_planner(self):
        self.each("path_planner", lambda row, expect: self.of_its_own("path_planner", PLANNER, self.planned, row, expect),
                  table.rows("transforms"))

    def test_transforms_of_navigate_path(self):
        self.each("navigate_path", lambda row, expect: self.of_its_own("navigate_path", DRIVER, self.driven, row, expect),
                  table.rows("transforms"))

    def of_its_own(self, name, kind, ask, row, expect):
        node = foreign_nodes.ForeignNode(name, kind, self.folder.name, space="/%s_of_%s" % (row["id"], name))
        try:
            node.frames = row["frames"]
            return ask(node, row, expect) if node.starts() else "it does not start: " + node.said()
        finally:
            node.end(9)

    def planned(self, node, row, expect):
        request = get_service_class("nav_msgs/GetPlan")._request_class()
        node.send("projected_map", rooms.before(self.now()))

        def length():
            request.goal = pose_stamped(node)
            request.goal.pose.position.x, request.goal.pose.position.y = rooms.GOAL
            answer = node.call("~make_plan", request)
            poses = answer.plan.poses if answer else []
            points = [(p.pose.position.x, p.pose.position.y) for p in poses]
            return sum(map(math.dist, points, points[1:])) if points else None
        if "refused" in expect:
            told = wait_until(lambda: length() is None and node.says(expect["refused"], 0), ENOUGH)
            return "" if told else node.said()
        found = []
        met = wait_until(lambda: found.append(length()) or (found[-1] and abs(found[-1] - expect["length"]) < 1e-6), ENOUGH)
        return "" if met else "%r m: %s" % (found[-1], node.said()[-600:])

    def driven(self, node, row, expect):
        ids = []

        def send():
            goal = of("grid_path_planner/NavigatePathActionGoal", goal_id={"id": "goal %d" % len(ids)})
            goal.goal.path = of("nav_msgs/Path", header=header(node), poses=[
                {"header": header(node), "pose": pose(*place)} for place in (rooms.START, rooms.GOAL)])
            ids.append(goal.goal_id.id)
            node.send("navigate_path/goal", goal)

        def answer():
            """Of the newest."""
            for topic, part in (("result", "result"), ("feedback", "feedback")):
                heard = [m for m in node.heard("navigate_path/" + topic) if m.status.goal_id.id == ids[-1]]
                if heard:
                    return getattr(heard[-1], part)
            return None

        def is_right():
            found = answer()
            if "refused" in expect:
                return found and getattr(found, "state", "") != "driving" and re.search(expect["refused"], found.message + node.said())
            return found and getattr(found, "state", "") == "driving" and abs(found.distance_remaining_m - expect["length"]) < 1e-6
        return "" if wait_until(is_right, ENOUGH, send, 2.0) else "%s %s" % (answer(), node.said()[-600:])


if __name__ == "__main__":
    rospy.init_node("foreign_vehicle", disable_signals=True)
    rostest.rosrun("grid_path_planner", "foreign_vehicle", Vehicle)
