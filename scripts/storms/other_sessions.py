"""The sessions beside the demo: launch files of the package, each with a vehicle that drives."""
import os
import threading
import time

from ros_session import share_file

from .sensors import Estimate
from .session import BEGIN, Demo, Overrides, Session

ZONES = """zones:
  - {name: wreck, kind: keep_out, polygon: [[10.3, 1.6], [11.6, 1.6], [11.6, 3.4], [10.3, 3.4]]}
  - {name: door, kind: slow, max_speed: 0.4, polygon: [[12, -6], [14, -6], [14, -3], [12, -3]]}
"""

# Debian has the package for C++ only.
JOY = "Header header\nfloat32[] axes\nint32[] buttons\n" + 80 * "=" + """
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
"""


HELD_EVERY = 0.05  # s


def hold(axes, buttons):
    """A joystick, for ever."""
    import rospy
    from genpy.dynamic import generate_dynamic
    joy = generate_dynamic("sensor_msgs/Joy", JOY)["sensor_msgs/Joy"]
    publisher = rospy.Publisher("joy", joy, queue_size=1)
    while True:
        time.sleep(HELD_EVERY)
        publisher.publish(joy(axes=axes, buttons=buttons))


class Manual(Demo):
    """The demo, above whose site somebody drives circles by joystick, whose button is held for ever; what is planned for
    goals meanwhile nobody drives."""

    FIRST_CELLS = 20
    COMMANDER, TICK, MASTER_TIMEOUT = "/teleop_joy", 0.05, None  # whoever holds the button sees the vehicle
    PREFIX, OVER_A_LINK, KNOWS_AGES = "joystick_prefix", {}, False
    AXES = (0.0, 0.5, 0.0, 0.5, 0.0)  # ahead, and to the left
    BUTTONS = (0, 0, 0, 0, 1, 0)

    def prepare(self):
        threading.Thread(target=hold, args=(self.AXES, self.BUTTONS), daemon=True).start()


class Flight(Session):
    """A multirotor between two groves, of which it knows what it has seen."""

    NODES = ("/simulator", "/projected_map", "/path_planner", "/local_planner")
    THERE = 1.5
    FIRST_CELLS, BRAKING = 20, 1.7  # from 2 m/s
    COMMANDER, TICK = "/local_planner", 0.05
    PREFIX, OVER_A_LINK = "local_prefix", {}

    def __init__(self, folder, given=(), commander=(), arguments=(), host="localhost"):
        overrides = Overrides(folder, given)
        super().__init__(folder, "flight_demo.launch", list(arguments) + [
            "simulator_overrides:=" + overrides.write("simulator", "multirotor.yaml"),
            "mapping_overrides:=" + overrides.write("projected_map", "flight_mapping.yaml", always_send_full_map=True),
            "local_overrides:=" + overrides.write("local_planner", "flight_local.yaml", **dict(commander))],
            ((0.0, 0.0, 1.5, 0.0), (30.0, 10.0, 1.5, 0.0)), host)


COMMANDED = {"demo": Demo, "manual": Manual, "flight": Flight}  # one of each node that publishes cmd_vel


class Localization(Session):
    """A vehicle that knows by its sensors where it is, and drives to and fro before the panel with the markers."""

    NODES = ("/simulator", "/map_publisher", "/path_planner", "/navigate_path", "/marker_localizer", "/vehicle_localizer")
    ENDS = ((4.66, -1.92, 2.9, 1.99), (1.1, -2.7, 2.9, 0.4))
    MAP_NODE = "/map_publisher"

    def __init__(self, folder, given):
        overrides = Overrides(folder, given)
        super().__init__(folder, "localization_demo.launch", [
            "simulator_overrides:=" + overrides.write("simulator", "localization_simulator.yaml",
                                                      **dict(zip(BEGIN, self.ENDS[0])))], self.ENDS)

    def prepare(self):
        import rospy
        from geometry_msgs.msg import PoseWithCovarianceStamped
        self.fixes = 0  # by markers
        self.estimate = Estimate(self.vehicle)
        rospy.Subscriber("marker_pose", PoseWithCovarianceStamped, self.on_fix)

    def on_fix(self, _):
        self.fixes += 1


class Site(Session):
    """A vehicle that is sent as by a client of move_base, over the site's map with zones in which it must not be."""

    NODES = ("/simulator", "/map_publisher", "/map_layers", "/path_planner", "/navigate_path", "/go_to_pose")
    ENDS = ((10.6115, -12.4845, 0.0, 2.464), (1.2191, 4.8549, 0.0, -1.478))
    MAP_NODE = "/map_layers"

    def __init__(self, folder, given):
        overrides = Overrides(folder, given)
        zones = os.path.join(folder, "zones.yaml")
        with open(zones, "w") as file:
            file.write(ZONES)
        x, y, _, yaw = self.ENDS[0]
        super().__init__(folder, "map_demo.launch", [
            "map:=" + share_file("maps", "dexrov_site.yaml"), "x:=%r" % x, "y:=%r" % y, "yaw:=%r" % yaw, "zones_file:=" + zones,
            "navigate_overrides:=" + overrides.write("navigate_path", "navigate_path.yaml"),
            "layers_overrides:=" + overrides.write("map_layers", "map_layers.yaml"), "go_to:=true", "rviz:=false"], self.ENDS)
