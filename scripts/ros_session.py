"""What the demo and the survey scripts share: a roscore and the nodes of a launch file as a child process,
and somebody who listens to the simulated vehicle and sends it along its path.

    with Nodes("demo.launch", ["rviz:=false"], "out/demo.log") as nodes:
        vehicle = Vehicle(nodes)
        vehicle.wait_until_ready()
        vehicle.drive_file("/survey", "config/survey_waypoints.yaml", seconds=600)
"""
import math
import os
import signal
import socket
import subprocess
import sys
import time

PACKAGE = "grid_path_planner"
START_SECONDS = 120.0  # of the wall clock, for all nodes to be there: only what hangs takes so long


class SessionFailed(Exception):
    """The message says why."""


def run_session(name, run, arguments):
    """A program: run(arguments), with one line for what went wrong and an exit code that says so."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        run(arguments)
    except SessionFailed as reason:
        print("%s: failed: %s" % (name, reason), file=sys.stderr)
        sys.exit(1)
    except KeyboardInterrupt:
        print("%s: stopped" % name, file=sys.stderr)
        sys.exit(130)


def free_port():
    """Below those that the system gives to sockets that name none: one of them could be somebody's a moment later."""
    for port in range(20000 + os.getpid() % 10000, 32768):
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return port
    raise SessionFailed("no port from 20000 to 32767 is free for a ROS master")


def own_master_arguments():
    """Those of a roslaunch that starts a master on a free port, which is everybody's then."""
    port = free_port()
    os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % port
    os.environ["ROS_HOSTNAME"] = "localhost"
    os.environ.pop("ROS_IP", None)
    return ["-p", str(port)]


def share_file(*parts):
    import rospkg
    return os.path.join(rospkg.RosPack().get_path(PACKAGE), *parts)


def executable(name):
    """From the first workspace that has it: rosrun would ask where a source folder holds two builds."""
    for space in os.environ["CMAKE_PREFIX_PATH"].split(":"):
        path = os.path.join(space, "lib", PACKAGE, name)
        if os.path.exists(path):
            return path
    raise SessionFailed("there is no %s in CMAKE_PREFIX_PATH: is a setup.bash sourced?" % name)


class Nodes:
    """A launch file as a child process, with everything that it starts. Stops it at the end."""

    def __init__(self, launch_file, arguments, log, own_master=True):
        """Without a master of their own they take the one of ROS_MASTER_URI."""
        self.log_name = log
        self.log = open(log, "w")
        # A session of its own: Ctrl-C reaches this program alone, which then stops the nodes in order.
        self.process = subprocess.Popen(
            ["roslaunch"] + (own_master_arguments() if own_master else []) + [PACKAGE, launch_file] + arguments,
            stdout=self.log, stderr=subprocess.STDOUT, start_new_session=True)

    def __enter__(self):
        return self

    def check(self):
        if self.process.poll() is not None:
            raise SessionFailed("roslaunch has ended with code %d, see %s"
                                % (self.process.returncode, self.log_name))

    def wait_until(self, done, seconds, what):
        """Polls `done` for so many seconds of the wall clock."""
        deadline = time.monotonic() + seconds
        while not done():
            self.check()
            if time.monotonic() > deadline:
                raise SessionFailed("no %s within %.0f s, see %s" % (what, seconds, self.log_name))
            time.sleep(0.05)

    def wait_for_service(self, name):
        self.wait_until(lambda: has_service(name), START_SECONDS, name)

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


def has_service(name):
    import rosgraph
    try:
        return bool(rosgraph.Master("/session").lookupService(name))
    except rosgraph.MasterError:
        return False


class Vehicle:
    """Hears what the simulated vehicle does, and sends it along waypoint files."""

    def __init__(self, nodes):
        # Imported here: they read ROS_MASTER_URI, which the nodes' roscore sets.
        import rosgraph
        import rospy
        from nav_msgs.msg import Odometry
        from std_msgs.msg import String, UInt32
        self.nodes = nodes
        self.truth = self.contacts = self.contact = self.stamp = None
        self.driven_m = 0.0
        nodes.wait_until(rosgraph.is_master_online, START_SECONDS, "roscore")
        rospy.init_node("session", anonymous=True, disable_signals=True)
        rospy.Subscriber("contacts", UInt32, self.keep("contacts"))
        rospy.Subscriber("contact", String, self.keep("contact"))
        rospy.Subscriber("ground_truth", Odometry, self.on_truth)

    def keep(self, name):
        return lambda message: setattr(self, name, message)

    def on_truth(self, message):
        if self.truth is not None:
            a, b = self.truth.pose.pose.position, message.pose.pose.position
            self.driven_m += math.dist((a.x, a.y, a.z), (b.x, b.y, b.z))
        self.truth, self.stamp = message, message.header.stamp

    def wait_until_ready(self):
        self.nodes.wait_until(lambda: self.truth and self.stamp and self.contacts is not None,
                              START_SECONDS, "simulator")

    def now(self):
        """Seconds of the simulator's time: simulated ones, or, where it publishes no /clock, of the wall clock."""
        return self.stamp.to_sec() if self.stamp else 0.0

    def pose(self):
        """True x, y, z in m and yaw in rad, in the map."""
        position, q = self.truth.pose.pose.position, self.truth.pose.pose.orientation
        yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
        return position.x, position.y, position.z, yaw

    def speed(self):
        v, w = self.truth.twist.twist.linear, self.truth.twist.twist.angular
        return math.sqrt(v.x ** 2 + v.y ** 2 + v.z ** 2) + abs(w.z)

    def distance(self, pose):
        return math.dist(self.pose()[:3], pose[:3])

    def check_untouched(self):
        if self.contacts.data > 0:
            raise SessionFailed("the vehicle has run into %s at x %.2f, y %.2f, z %.2f" % (
                (self.contact.data if self.contact else "something",) + self.pose()[:3]))

    def drive_file(self, namespace, waypoint_file, seconds):
        """Has the navigate_path of `namespace` drive a waypoint file, within so many seconds of the wall
        clock. Returns the simulated seconds it took. Fails at once where the vehicle touches something."""
        import rospy
        from grid_path_planner.msg import NavigatePathActionGoal, NavigatePathActionResult
        results = []
        action = namespace + "/navigate_path"
        subscriber = rospy.Subscriber(action + "/result", NavigatePathActionResult, results.append)
        publisher = rospy.Publisher(action + "/goal", NavigatePathActionGoal, queue_size=1)
        self.nodes.wait_until(
            lambda: publisher.get_num_connections() > 0 and subscriber.get_num_connections() > 0,
            START_SECONDS, action)
        goal = NavigatePathActionGoal()
        goal.goal_id.id = "%s, asked at %r" % (waypoint_file, time.time())  # one that was known is not driven
        goal.goal.filename = os.path.abspath(waypoint_file)
        begin = self.now()
        publisher.publish(goal)

        def done():
            self.check_untouched()
            return results
        self.nodes.wait_until(done, seconds, "end of " + waypoint_file)
        if results[0].result.status != "ARRIVED":
            raise SessionFailed("%s: %s" % (results[0].result.status, results[0].result.message))
        return self.now() - begin


class Planner:
    """Asks path_planner for the path, and keeps what it answers."""

    def __init__(self, nodes, vehicle):
        import rospy
        from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
        from nav_msgs.msg import Path
        from grid_path_planner.msg import PlanStatistics
        self.nodes, self.vehicle = nodes, vehicle
        self.PoseStamped, self.PoseWithCovarianceStamped = PoseStamped, PoseWithCovarianceStamped
        self.statistics = self.path = None
        self.start = rospy.Publisher("/initialpose", PoseWithCovarianceStamped, queue_size=1)
        self.goal = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1)
        rospy.Subscriber("plan_statistics", PlanStatistics, lambda m: setattr(self, "statistics", m))
        rospy.Subscriber("path", Path, lambda m: setattr(self, "path", m))

    def fill(self, message, pose, values):
        message.header.frame_id = "map"
        message.header.stamp = self.vehicle.stamp
        pose.position.x, pose.position.y, pose.position.z = values[:3]
        pose.orientation.z, pose.orientation.w = math.sin(values[3] / 2), math.cos(values[3] / 2)
        return message

    def ask(self, goal, start):
        if start:
            message = self.PoseWithCovarianceStamped()
            self.start.publish(self.fill(message, message.pose.pose, start))
            time.sleep(0.5)  # two topics: nothing else makes them arrive in this order
        message = self.PoseStamped()
        self.goal.publish(self.fill(message, message.pose, goal))

    def plan(self, goal, start=None):
        """From where the vehicle is, unless a start is given: x, y, z in m and yaw in rad. Asks until there is an
        answer that is not for want of the map or a transform: the nodes of a launch file start in no order."""
        deadline = time.monotonic() + START_SECONDS
        while True:
            self.nodes.wait_until(
                lambda: self.start.get_num_connections() > 0 and self.goal.get_num_connections() > 0,
                START_SECONDS, "path_planner")
            self.statistics = None
            self.ask(goal, start)
            self.nodes.wait_until(lambda: self.statistics, START_SECONDS, "plan_statistics")
            if self.statistics.status == "FOUND":
                self.nodes.wait_until(lambda: self.path and self.path.poses, 10.0, "path")
                return self.statistics, self.path
            if self.statistics.status not in ("NO_MAP", "TRANSFORM_ERROR") or time.monotonic() > deadline:
                raise SessionFailed("%s: %s" % (self.statistics.status, self.statistics.message))
            time.sleep(0.5)


class Mapping:
    """Hears how far projected_map is with the clouds that came, and has it save the map."""

    def __init__(self, nodes):
        import rospy
        from diagnostic_msgs.msg import DiagnosticArray
        self.nodes = nodes
        self.figures = {}
        self.reports = 0
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.on_diagnostics)

    def on_diagnostics(self, message):
        for status in message.status:
            if "projected_map" in status.name:
                self.figures.update((pair.key, pair.value) for pair in status.values)
                self.reports += 1

    def count(self, name):
        return int(self.figures.get(name, "0"))

    def wait_until_mapped(self, seconds):
        """Until all clouds that came before this call are in the map, or dropped."""
        reports = self.reports
        self.nodes.wait_until(lambda: self.reports > reports + 2, START_SECONDS, "/diagnostics of projected_map")
        received = self.count("received")
        self.nodes.wait_until(lambda: self.count("inserted") + self.count("dropped") >= received, seconds,
                              "end of the mapping")

    def save(self, map_file):
        """The 2-D map as a map_server YAML and its image."""
        import rospy
        from grid_path_planner.srv import SaveFile
        answer = rospy.ServiceProxy("/projected_map/save_map", SaveFile)(os.path.abspath(map_file))
        if not answer.success:
            raise SessionFailed(answer.message)


def set_simulator(parameter, value):
    """A number, while it runs."""
    import rospy
    from dynamic_reconfigure.msg import Config, DoubleParameter
    from dynamic_reconfigure.srv import Reconfigure
    rospy.ServiceProxy("/simulator/set_parameters", Reconfigure)(Config(doubles=[DoubleParameter(parameter, value)]))


def plan_rows(s, path):
    return [("status", s.status),
            ("planner", ", ".join(filter(None, (s.planner, s.heuristic, "kernel %d" % s.kernel)))),
            ("path", "%.2f m, %d waypoints" % (s.length_m, len(path.poses))),
            ("cost", "%.3f" % s.cost),
            ("clearance", "%.2f m" % s.clearance_m),
            ("expanded", "%d cells" % s.expanded),
            ("search memory", "%.2f MB" % (s.search_bytes / 1e6)),
            ("planning time", "%.2f ms, map preparation %.1f ms" % (s.planning_time_ms, s.preparation_time_ms))]
