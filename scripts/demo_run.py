#!/usr/bin/env python3
"""Runs demo.launch on a roscore of its own, sends a goal, waits until the vehicle has arrived, reports.

    rosrun grid_path_planner demo_run.py [--rviz] [--speed FACTOR] [--out FOLDER]

Writes path.png and waypoints.yaml into FOLDER (default: out), the nodes' output into demo.log there.
The picture is drawn by `grid_path plan` with the same map, ends and parameters; that its path is the
node's is checked. Exit code 0 only if a path was found and driven without touching anything.
"""
import argparse
import json
import math
import os
import signal
import socket
import subprocess
import sys
import time

PACKAGE = "grid_path_planner"
GOAL = (4.6, 4.65, 0.5, 0.35)  # x, y, z in m, yaw in rad: in front of the testing panel, facing it
LARGEST_ARRIVAL_ERROR = 0.2    # m
START_SECONDS = 60.0           # for all nodes to be there and a path to be found
DRIVE_SECONDS = 120.0          # of simulated time


class DemoFailed(Exception):
    """The message says why."""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Nodes:
    """demo.launch as a child process, with everything that it starts. Stops it on the way out."""

    def __init__(self, log, arguments):
        port = free_port()
        os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % port
        os.environ["ROS_HOSTNAME"] = "localhost"
        os.environ.pop("ROS_IP", None)
        self.log_name = log
        self.log = open(log, "w")
        # A session of its own: Ctrl-C reaches this program alone, which then stops the nodes in order.
        self.process = subprocess.Popen(
            ["roslaunch", "-p", str(port), PACKAGE, "demo.launch"] + arguments,
            stdout=self.log, stderr=subprocess.STDOUT, start_new_session=True)

    def __enter__(self):
        return self

    def check(self):
        if self.process.poll() is not None:
            raise DemoFailed("roslaunch has ended with code %d, see %s"
                             % (self.process.returncode, self.log_name))

    def __exit__(self, *_):
        for step, seconds in ((signal.SIGINT, 20), (signal.SIGTERM, 5), (signal.SIGKILL, 5)):
            if self.process.poll() is not None:
                break
            self.process.send_signal(step)
            try:
                self.process.wait(seconds)
            except subprocess.TimeoutExpired:
                pass
        self.log.close()


class Watcher:
    """Hears what the nodes say, and keeps the last of it."""

    def __init__(self):
        # Imported here: they read ROS_MASTER_URI, which the nodes' roscore sets.
        import rospy
        from geometry_msgs.msg import PoseStamped
        from nav_msgs.msg import Odometry, Path
        from rosgraph_msgs.msg import Clock
        from std_msgs.msg import UInt32
        from grid_path_planner.msg import PlanStatistics
        self.rospy = rospy
        self.PoseStamped = PoseStamped
        self.statistics = self.path = self.odometry = self.contacts = self.clock = None
        self.driven_m = 0.0
        rospy.init_node("demo", anonymous=True, disable_signals=True)
        self.goal_publisher = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1)
        rospy.Subscriber("plan_statistics", PlanStatistics, self.keep("statistics"))
        rospy.Subscriber("path", Path, self.keep("path"))
        rospy.Subscriber("contacts", UInt32, self.keep("contacts"))
        rospy.Subscriber("/clock", Clock, self.keep("clock"))
        rospy.Subscriber("odom", Odometry, self.on_odometry)

    def keep(self, name):
        return lambda message: setattr(self, name, message)

    def on_odometry(self, message):
        if self.odometry is not None:
            a, b = self.odometry.pose.pose.position, message.pose.pose.position
            self.driven_m += math.dist((a.x, a.y, a.z), (b.x, b.y, b.z))
        self.odometry = message

    def now(self):
        return self.clock.clock.to_sec() if self.clock else 0.0

    def send_goal(self):
        goal = self.PoseStamped()
        goal.header.frame_id = "map"
        goal.header.stamp = self.clock.clock
        goal.pose.position.x, goal.pose.position.y, goal.pose.position.z = GOAL[:3]
        goal.pose.orientation.z, goal.pose.orientation.w = math.sin(GOAL[3] / 2), math.cos(GOAL[3] / 2)
        self.goal_publisher.publish(goal)

    def pose(self):
        """x, y, z in m and yaw in rad; the simulator's odometry frame coincides with the map."""
        position, q = self.odometry.pose.pose.position, self.odometry.pose.pose.orientation
        yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
        return position.x, position.y, position.z, yaw

    def speed(self):
        v, w = self.odometry.twist.twist.linear, self.odometry.twist.twist.angular
        return math.sqrt(v.x ** 2 + v.y ** 2 + v.z ** 2) + abs(w.z)

    def arrival_error(self):
        return math.dist(self.pose()[:3], GOAL[:3])


def wait_until(nodes, done, seconds, what):
    """Polls `done` for so many seconds of the wall clock."""
    deadline = time.monotonic() + seconds
    while not done():
        nodes.check()
        if time.monotonic() > deadline:
            raise DemoFailed("no %s within %.0f s, see %s" % (what, seconds, nodes.log_name))
        time.sleep(0.05)


def connect(nodes):
    import rosgraph
    wait_until(nodes, rosgraph.is_master_online, START_SECONDS, "roscore")
    watcher = Watcher()
    wait_until(nodes, lambda: watcher.odometry and watcher.clock and watcher.contacts is not None,
               START_SECONDS, "simulator")
    # navigate_path drives no path stamped before it started: it must be there and have seen the clock.
    wait_until(nodes, lambda: has_service("/navigate_path/cancel"), START_SECONDS, "navigate_path")
    begin = watcher.now()
    wait_until(nodes, lambda: watcher.now() > begin + 4.0, START_SECONDS, "running /clock")
    return watcher


def has_service(name):
    import rosgraph
    try:
        return bool(rosgraph.Master("/demo").lookupService(name))
    except rosgraph.MasterError:
        return False


def plan(nodes, watcher):
    """Sends the goal until there is an answer that is not for want of the map or the vehicle's pose:
    the nodes of a launch file start in no order."""
    start = watcher.pose()
    deadline = time.monotonic() + START_SECONDS
    while True:
        watcher.statistics = None
        wait_until(nodes, lambda: watcher.goal_publisher.get_num_connections() > 0,
                   START_SECONDS, "path_planner")
        watcher.send_goal()
        wait_until(nodes, lambda: watcher.statistics, START_SECONDS, "plan_statistics")
        if watcher.statistics.status == "FOUND":
            wait_until(nodes, lambda: watcher.path and watcher.path.poses, 10.0, "path")
            return start
        if watcher.statistics.status not in ("NO_MAP", "TRANSFORM_ERROR") or time.monotonic() > deadline:
            raise DemoFailed("%s: %s" % (watcher.statistics.status, watcher.statistics.message))
        time.sleep(0.5)


def drive(nodes, watcher, speed):
    """Waits until the vehicle stands still at the goal; returns the simulated seconds it took."""
    begin = watcher.now()
    deadline = time.monotonic() + 2 * DRIVE_SECONDS / speed
    while not (watcher.arrival_error() < LARGEST_ARRIVAL_ERROR and watcher.speed() < 0.005):
        nodes.check()
        if watcher.now() > begin + DRIVE_SECONDS or time.monotonic() > deadline:
            raise DemoFailed("after %.0f s the vehicle is %.2f m from the goal, see %s" % (
                watcher.now() - begin, watcher.arrival_error(), nodes.log_name))
        time.sleep(0.02)
    return watcher.now() - begin


def share_folder():
    import rospkg
    return rospkg.RosPack().get_path(PACKAGE)


def executable(name):
    """From the first workspace that has it: rosrun would ask where a source folder holds two builds."""
    for space in os.environ["CMAKE_PREFIX_PATH"].split(":"):
        path = os.path.join(space, "lib", PACKAGE, name)
        if os.path.exists(path):
            return path
    raise DemoFailed("there is no %s in CMAKE_PREFIX_PATH: is a setup.bash sourced?" % name)


def flags(yaml_name):
    """Parameters of path_planner as flags of the command line, which has the same options."""
    import yaml
    with open(yaml_name) as file:
        parameters = yaml.safe_load(file)
    return [part for name, value in parameters.items()
            for part in ("--" + name.replace("_", "-"), str(value).lower())]


def draw(start, picture, statistics):
    """The picture, by the command line; checks that it found the node's path."""
    share = share_folder()
    command = [executable("grid_path"), "plan", "--json", "--image", picture,
               "--map", os.path.join(share, "maps", "demo_site.yaml"),
               "--start", ",".join(map(repr, start)), "--goal", ",".join(map(repr, GOAL))]
    command += flags(os.path.join(share, "config", "demo_planner.yaml"))
    answer = subprocess.run(command, capture_output=True, text=True)
    if answer.returncode != 0:
        raise DemoFailed("grid_path plan: " + (answer.stderr or answer.stdout).strip())
    report = json.loads(answer.stdout)
    if abs(report["cost"] - statistics.cost) > 1e-9 * statistics.cost:
        raise DemoFailed("grid_path plan found a path of cost %r, the node one of %r"
                         % (report["cost"], statistics.cost))


def table(watcher, seconds):
    s = watcher.statistics
    x, y, z, yaw = watcher.pose()
    rows = [
        ("status", s.status),
        ("planner", "%s, %s, kernel %d" % (s.planner, s.heuristic, s.kernel)),
        ("path", "%.2f m, %d waypoints" % (s.length_m, len(watcher.path.poses))),
        ("cost", "%.3f" % s.cost),
        ("clearance", "%.2f m" % s.clearance_m),
        ("expanded", "%d cells" % s.expanded),
        ("search memory", "%.2f MB" % (s.search_bytes / 1e6)),
        ("planning time", "%.2f ms, map preparation %.1f ms" % (s.planning_time_ms, s.preparation_time_ms)),
        ("driven", "%.2f m in %.1f s" % (watcher.driven_m, seconds)),
        ("arrived at", "x %.3f  y %.3f  z %.3f m  yaw %.3f rad" % (x, y, z, yaw)),
        ("arrival error", "%.3f m, %.3f rad" % (
            watcher.arrival_error(), abs(math.remainder(yaw - GOAL[3], 2 * math.pi)))),
        ("contacts", str(watcher.contacts.data)),
    ]
    for name, value in rows:
        print("  %-14s %s" % (name, value))


def run(arguments):
    os.makedirs(arguments.out, exist_ok=True)
    picture = os.path.join(arguments.out, "path.png")
    waypoints = os.path.join(arguments.out, "waypoints.yaml")
    for name in (picture, waypoints):
        if os.path.exists(name):
            os.remove(name)
    launch_arguments = ["rviz:=" + str(arguments.rviz).lower(),
                        "real_time_factor:=%g" % arguments.speed,
                        "waypoints_file:=" + os.path.abspath(waypoints)]
    with Nodes(os.path.join(arguments.out, "demo.log"), launch_arguments) as nodes:
        print("demo: nodes start on %s" % os.environ["ROS_MASTER_URI"], flush=True)
        watcher = connect(nodes)
        start = plan(nodes, watcher)
        print("demo: a path is found, the vehicle drives", flush=True)
        seconds = drive(nodes, watcher, arguments.speed)
        wait_until(nodes, lambda: os.path.exists(waypoints), 10.0, "waypoint file")
        draw(start, picture, watcher.statistics)
        table(watcher, seconds)
        if arguments.rviz and sys.stdin.isatty():
            input("demo: press Enter to close rviz ")
        contacts = watcher.contacts.data
        print("demo: status=%s length_m=%.3f arrival_error_m=%.3f contacts=%d picture=%s waypoints=%s" % (
            watcher.statistics.status, watcher.statistics.length_m, watcher.arrival_error(), contacts,
            picture, waypoints))
        if contacts != 0:
            raise DemoFailed("the vehicle touched something")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rviz", action="store_true", help="show it in rviz")
    parser.add_argument("--speed", type=float, default=4.0, metavar="FACTOR",
                        help="simulated seconds in a second of the wall clock (default: 4)")
    parser.add_argument("--out", default="out", metavar="FOLDER", help="for the results (default: out)")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        run(arguments)
    except DemoFailed as reason:
        print("demo: failed: %s" % reason, file=sys.stderr)
        sys.exit(1)
    except KeyboardInterrupt:
        print("demo: stopped", file=sys.stderr)
        sys.exit(130)


if __name__ == "__main__":
    main()
