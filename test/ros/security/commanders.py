"""Every node that commands a vehicle: what makes it command a motion, and what it cannot do without.

A row is complete: every_commander_rostest.py compares the table with node_table.py. Whoever adds a node that publishes
velocities adds a row.

    arguments   in the place of those of node_table.py: the vehicle never moves, and that is no failure
    feeds       by name, what it hears all the time; without any of them it has to stop the vehicle
    offer       gives it something to drive; teleop_joy has that in what it is fed
    halt        ends that
    far         what it says of a pose beyond a million metres, in its log or its status; None: it asks for none
    clock       whether ROS time that stands still stops the vehicle
    locks       the test of the law that its thread that commands takes no lock that file, map or publishing code holds
"""
import collections
import math
import os
import signal
import tempfile
import threading
import time
import unittest

import node_probes as probes
import rospy
from roslib.message import get_service_class
from node_table import NODES
from running_nodes import Clock, RunningNode

Commander = collections.namedtuple("Commander", "arguments feeds offer halt far clock locks")

DEADLINE = 60.0   # s, which only a failure reaches
QUIET = 1.0       # s without a motion: it stands
VELOCITIES = ("geometry_msgs/Twist", "geometry_msgs/TwistStamped")
TRAJECTORIES = ("trajectory_msgs/MultiDOFJointTrajectory",)
TICK = 0.05       # s, between two of what it is fed
CLOUD_EVERY = 4   # ticks


def send_transforms(node, _):
    node.send("tf", probes.camera_transforms(node))


def send_cloud(node, tick):
    """Of a sky in which no pixel measures anything."""
    if tick % CLOUD_EVERY:
        return
    for topic, message in zip(("camera_info", "points"), probes.sky(node)):
        node.send(topic, message)


def send_joystick(node, _):
    node.send("joy", probes.joystick(node))


def cancel(node):
    node.call("~cancel", get_service_class("std_srvs/Trigger")._request_class())


def let_joystick_go(node):
    released = probes.joystick(node)
    released.buttons = [0] * len(released.buttons)
    node.send("joy", released)


def offer_goal(node):
    goal = probes.pose_stamped(node)
    goal.pose.position.x = 40.0
    node.send("goal", goal)


COMMANDERS = {
    "navigate_path": Commander(
        ["_check_map:=false", "_no_progress_timeout:=0"], {"tf": send_transforms},
        lambda node: node.send("path", probes.path(node)), cancel, "INVALID_POSE", True,
        "driving/navigate_path_locks_rostest.cpp"),
    "local_planner": Commander(
        ["_no_return_clears:=10", "_recover:=false", "_cloud_timeout:=1", "_tf_timeout:=1", "_stuck_timeout:=1e6"],
        {"tf": send_transforms, "clouds": send_cloud}, offer_goal, cancel, "the vehicle's pose is beyond 1e6 m", True,
        "avoidance/local_planner_locks_rostest.cpp"),
    "teleop_joy": Commander([], {"joy": send_joystick}, lambda _: None, let_joystick_go, None, False,
        "driving/teleop_joy_rostest.cpp"),
}


class StoppableClock(Clock):
    """A /clock that can stand still."""

    def __init__(self):
        self.stood, self.stands_since = 0.0, None
        super().__init__(True)

    def now(self):
        until = self.stands_since or time.monotonic()
        return rospy.Time.from_sec(100.0 + until - self.begin - self.stood)

    def stop(self):
        self.stands_since = time.monotonic()

    def go_on(self):
        self.stood += time.monotonic() - self.stands_since
        self.stands_since = None


def is_zero(twist):
    return not any(getattr(part, axis) for part in (twist.linear, twist.angular) for axis in "xyz")


class RunningCommander(RunningNode):
    """One that is fed. `stopped`: what the topic `stop` has said before it starts. `commands` has all velocities that it gave, as (monotonic s, topic, Twist)."""

    def __init__(self, name, kind, clock, folder, stopped=False, master=None, arguments=(), environment=None):
        from std_msgs.msg import Bool
        self.table, self.ceased, self.commands = COMMANDERS[name], set(), []
        self.feeding = threading.Lock()
        self.velocities = {topic for topic, kind in NODES[name].outputs.items() if kind in VELOCITIES}
        self.environment = dict(environment or os.environ, ROSCONSOLE_STDOUT_LINE_BUFFERED="1")
        if master:
            self.environment["ROS_MASTER_URI"] = master
        self.stops = rospy.Publisher("/%s_as_%s/stop" % (name, kind), Bool, queue_size=1, latch=True)
        if stopped is not None:
            self.stops.publish(stopped)
        super().__init__(name, NODES[name]._replace(arguments=self.table.arguments + list(arguments)), kind, clock, folder)
        threading.Thread(target=self.feed, daemon=True).start()

    def feed_transforms(self):
        """feed() does."""

    def feed(self):
        tick = 0
        while not rospy.is_shutdown() and not self.ended:
            tick += 1
            try:
                for name, send in self.table.feeds.items():
                    with self.feeding:
                        if name not in self.ceased:
                            send(self, tick)
            except rospy.ROSException:
                return  # shut down meanwhile
            time.sleep(TICK)

    def cease(self, feed):
        """None of it is sent once this returns."""
        with self.feeding:
            self.ceased.add(feed)

    def keep(self, message, topic):
        if topic in self.velocities:
            with self.lock:
                self.commands.append((time.monotonic(), topic, getattr(message, "twist", message)))
        super().keep(message, topic)

    def stop(self, is_stopped):
        self.stops.publish(is_stopped)

    def moved_after(self, begin):
        """Whether it commanded a motion since then."""
        with self.lock:
            return any(at > begin and not is_zero(twist) for at, _, twist in self.commands)

    def zeroed_after(self, begin):
        """Whether it commanded a zero since then."""
        with self.lock:
            return any(at > begin and is_zero(twist) for at, _, twist in self.commands)

    def stood_from_one_on(self, begin):
        """Whether no motion of a topic came after its first zero since then."""
        with self.lock:
            given = [(topic, is_zero(twist)) for at, topic, twist in self.commands if at > begin]
        return all(not zero or all(later for other, later in given[i:] if other == topic)
                   for i, (topic, zero) in enumerate(given))

    def ends_in_zeros(self):
        """Whether its last velocity of each topic is none."""
        with self.lock:
            last = {topic: twist for _, topic, twist in self.commands}
        return bool(last) and all(map(is_zero, last.values()))


class CommanderTest(unittest.TestCase):
    """Nodes that are `started` on a clock that can stand still, and killed at the end of a test."""

    @classmethod
    def setUpClass(cls):
        cls.clock = StoppableClock()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.started = []
        self.addCleanup(self.end_all)

    def end_all(self):
        """Whatever was commanded in the test is finite."""
        for node in self.started:
            node.end(signal.SIGKILL)
        for node in self.started:
            for _, topic, twist in getattr(node, "commands", ()):
                for number in (twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z):
                    self.assertTrue(math.isfinite(number), "%s of %s" % (topic, node))

    def commander(self, name, kind="process", stopped=False):
        self.started.append(RunningCommander(name, kind, self.clock, self.folder, stopped))
        return self.started[-1]

    def moving(self, name, kind="process"):
        node = self.commander(name, kind)
        self.assertTrue(self.moves(node), "%s: %s" % (node, self.said(node)))
        return node

    def stays(self, node, meanwhile=lambda: None):
        """It commands no motion for a while from now on."""
        begin = time.monotonic()
        while time.monotonic() < begin + QUIET:
            meanwhile()
            time.sleep(0.1)
        return not node.moved_after(begin)

    @staticmethod
    def said(node):
        with open(node.log.name, errors="replace") as file:
            return file.read()[-2000:]

    def times_said(self, node, text):
        with open(node.log.name, errors="replace") as file:
            return file.read().count(text) + sum(text in str(status) for status in node.heard("avoidance_status"))

    def moves(self, node):
        """Whether it commands a motion from now on, offered something to drive now and then."""
        begin = time.monotonic()
        return probes.until(node, lambda: node.moved_after(begin), time.monotonic() + DEADLINE,
                            lambda: node.table.offer(node), 2.0)

    def stands(self, node, meanwhile=lambda: None, every=0.1):
        """It soon commands no motion for a while, whatever is done meanwhile, and has said so by a zero."""
        return probes.until(node, lambda: not node.moved_after(time.monotonic() - QUIET) and node.ends_in_zeros(),
                            time.monotonic() + DEADLINE, meanwhile, every)

    @staticmethod
    def anybody():
        """For a wait that no node's end cuts short."""
        class Anybody:
            @staticmethod
            def lives():
                return True
        return Anybody
