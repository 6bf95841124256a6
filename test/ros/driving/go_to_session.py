"""The nodes that go_to.launch starts, with a simulated vehicle in a room with a door, for tests that send goals as users of
move_base do."""
import contextlib
import math
import os
import signal
import subprocess
import tempfile
import threading
import time
import unittest
import xmlrpc.client

import actionlib
import rosgraph
import roslib.packages
import rospy
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped
from grid_path_planner.msg import GoToStatus, PlanPathAction, PlanPathResult
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import OccupancyGrid, Odometry

PACKAGE = "grid_path_planner"
DEADLINE = 60.0  # s, which only a failure reaches
REAL_TIME_FACTOR = 5  # of the simulator
WIDTH, HEIGHT, RESOLUTION = 100, 60, 0.1  # cells, cells, m
ARGUMENTS = {
    "simulator": ["_initial_x:=2", "_initial_y:=1.5", "_real_time_factor:=%d" % REAL_TIME_FACTOR, "_update_rate:=200"],
    "path_planner": ["_radius:=0.3"],
    "navigate_path": ["_control_rate:=200", "_tf_timeout:=3.0", "path:=navigate_path/path"],
    "go_to_pose": ["_recovery_wait:=2", "_server_timeout:=4", "_tf_timeout:=3.0"],
}


def room(door):
    """10 m by 6 m, with a wall at x = 5 m and a door in it, 1.2 m wide."""
    message = OccupancyGrid()
    message.header.frame_id, message.header.stamp = "map", rospy.Time.now()
    message.info.width, message.info.height, message.info.resolution = WIDTH, HEIGHT, RESOLUTION
    message.info.origin.orientation.w = 1.0

    def occupied(column, row):
        border = column in (0, WIDTH - 1) or row in (0, HEIGHT - 1)
        return border or column in (49, 50) and not (door and 36 <= row < 48)
    message.data = [100 if occupied(i % WIDTH, i // WIDTH) else 0 for i in range(WIDTH * HEIGHT)]
    return message


def pose(x, y, yaw=0.0, frame="map"):
    message = PoseStamped()
    message.header.frame_id = frame
    message.pose.position.x, message.pose.position.y = x, y
    message.pose.orientation.z, message.pose.orientation.w = math.sin(0.5 * yaw), math.cos(0.5 * yaw)
    return message


def executable(name):
    return os.path.join(os.environ["CMAKE_PREFIX_PATH"].split(":")[0], "lib", PACKAGE, name)


def until(condition, seconds=DEADLINE):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.01)
    return True


class HeldPlanner:
    """Answers `plan_path`, by the straight line to the goal from (2, 1.5), when it is told to."""

    def __enter__(self):
        self.asked, self.answers = threading.Event(), threading.Event()
        self.server = actionlib.SimpleActionServer("plan_path", PlanPathAction, self.plan, auto_start=False)
        self.server.start()
        return self

    def plan(self, goal):
        self.asked.set()
        self.answers.wait(DEADLINE)
        result = PlanPathResult(status="FOUND")
        result.path.header.frame_id, result.path.header.stamp = "map", rospy.Time.now()
        result.path.poses = [pose(2, 1.5), goal.goal]
        self.server.set_succeeded(result)

    def __exit__(self, *_):
        self.answers.set()
        action = self.server.action_server
        for topic in (action.goal_sub, action.cancel_sub, action.status_pub, action.result_pub, action.feedback_pub):
            topic.unregister()


class GoToTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.processes, cls.statuses, cls.odometry, cls.lock = {}, [], None, threading.Lock()
        cls.addClassCleanup(cls.end_all)
        cls.maps = rospy.Publisher("projected_map", OccupancyGrid, queue_size=1, latch=True)
        rospy.Subscriber("go_to_status", GoToStatus, cls.keep_status)
        rospy.Subscriber("ground_truth", Odometry, cls.keep_odometry)
        for name in ARGUMENTS:
            cls.start(name)
        assert until(lambda: cls.odometry is not None), cls.logs()
        cls.publish_room(door=True)
        threading.Thread(target=cls.keep_publishing, daemon=True).start()
        cls.connect()

    @classmethod
    def publish_room(cls, door):
        with cls.lock:
            cls.door = door
            cls.maps.publish(room(door))

    @classmethod
    def keep_publishing(cls):
        """As whoever makes a map does: by one that has ceased nothing is driven."""
        while not rospy.is_shutdown():
            time.sleep(0.5)
            cls.publish_room(cls.door)

    @classmethod
    def connect(cls):
        """A client of the go_to_pose that runs now."""
        assert until(lambda: cls.is_registered("go_to_pose")), cls.logs()
        cls.client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        assert cls.client.wait_for_server(rospy.Duration(DEADLINE * REAL_TIME_FACTOR)), cls.logs()

    @classmethod
    def start(cls, name, *more, as_nodelet=False):
        log = open(os.path.join(cls.folder.name, name + ".log"), "a")
        program = [executable(name)]
        if as_nodelet:  # in a manager of that name; the prefix is the sanitizer's library, in its runs
            nodelet = roslib.packages.find_node("nodelet", "nodelet")[0]
            program = os.environ.get("GPP_NODELET_PREFIX", "").split() + [nodelet, "standalone", PACKAGE + "/" + name]
        cls.processes[name] = subprocess.Popen(program + ["__name:=" + name] + ARGUMENTS[name] + list(more),
                                               stdout=log, stderr=subprocess.STDOUT)

    @classmethod
    def kill(cls, name):
        cls.processes[name].kill()
        cls.processes[name].wait()

    @classmethod
    @contextlib.contextmanager
    def time_standing_still(cls):
        """The simulator is ROS's clock."""
        cls.processes["simulator"].send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            cls.processes["simulator"].send_signal(signal.SIGCONT)

    @classmethod
    def end_all(cls):
        for process in reversed(list(cls.processes.values())):
            process.send_signal(signal.SIGINT)
        for process in cls.processes.values():
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()

    @classmethod
    def logs(cls):
        texts = []
        for name in ARGUMENTS:
            with open(os.path.join(cls.folder.name, name + ".log"), errors="replace") as file:
                texts.append("%s:\n%s" % (name, file.read()[-3000:]))
        return "\n".join(texts)

    @classmethod
    def keep_status(cls, message):
        with cls.lock:
            cls.statuses.append(message)

    @classmethod
    def keep_odometry(cls, message):
        cls.odometry = message

    def setUp(self):
        self.publish_room(door=True)
        self.forget()

    def tearDown(self):
        going = GoalStatus.PENDING, GoalStatus.ACTIVE
        if self.client.get_state() in going:
            self.client.cancel_goal()  # not all: that could come after the next test's goal, and be for it too
            self.assertTrue(until(lambda: self.client.get_state() not in going), self.logs())
        self.assertTrue(until(self.stands), self.logs())

    def forget(self):
        with self.lock:
            del self.statuses[:]

    def heard(self):
        with self.lock:
            return list(self.statuses)

    def at(self):
        return self.odometry.pose.pose.position.x, self.odometry.pose.pose.position.y

    def is_at(self, x, y, within=0.15):
        return math.hypot(self.at()[0] - x, self.at()[1] - y) < within

    def moves(self):
        speed = self.odometry.twist.twist.linear
        return math.hypot(speed.x, speed.y) > 0.3

    def stands(self):
        speed = self.odometry.twist.twist
        return abs(speed.linear.x) < 1e-3 and abs(speed.linear.y) < 1e-3 and abs(speed.angular.z) < 1e-3

    def start_planner(self):
        self.start("path_planner")
        self.wait_for(lambda: self.serves("path_planner", "plan_path"))

    def send(self, target, **callbacks):
        self.client.send_goal(MoveBaseGoal(target_pose=target), **callbacks)

    def drive_to(self, x, y, yaw=0.0):
        self.send(pose(x, y, yaw))
        self.ends("SUCCEEDED")
        self.wait_for(lambda: self.is_at(x, y))  # where it is comes over another connection than the result

    def ends(self, expected, seconds=DEADLINE):
        """The present goal; its text."""
        done = ("SUCCEEDED", "ABORTED", "PREEMPTED", "REJECTED", "RECALLED", "LOST")
        names = {getattr(GoalStatus, name): name for name in done}
        self.assertTrue(until(lambda: self.client.get_state() in names, seconds), self.logs())
        text = self.client.get_goal_status_text()
        self.assertEqual(expected, names[self.client.get_state()], (text, self.logs()))
        return text

    def wait_for(self, condition):
        self.assertTrue(until(condition), (self.heard()[-1:], self.at(), self.logs()))

    @classmethod
    def serves(cls, name, action):
        """As a process that runs now: starting takes seconds on a machine with other work, and is no silence."""
        try:
            heard = rosgraph.Master("/go_to_session").getSystemState()[1]
        except rosgraph.MasterError:
            return False
        return cls.is_registered(name) and any("/" + name in nodes for topic, nodes in heard
                                               if topic == "/%s/cancel" % action)

    @classmethod
    def is_registered(cls, name):
        """As a process that runs now."""
        try:
            uri = rosgraph.Master("/go_to_session").lookupNode("/" + name)
            return xmlrpc.client.ServerProxy(uri).getPid("/go_to_session")[2] == cls.processes[name].pid
        except (rosgraph.MasterError, OSError):
            return False
