"""What the storms share: the nodes of a launch file under a master of their own, and a vehicle that drives to and fro."""
import math
import os
import subprocess
import time
import xmlrpc.client

from ros_session import START_SECONDS, Nodes, SessionFailed, Vehicle, free_port, set_simulator, share_file

BACK_SECONDS = 120.0  # for a node that was killed, an answer, and a vehicle that is to go on; of the wall clock, which only what
                      # hangs takes: how long it took at most is told
# x, y, z in m, yaw in rad: between them lies what stands on the demo's site, of which rocks and chains reach so high.
ENDS = ((10.6115, -12.4845, 2.947, 2.464), (1.2191, 4.8549, 2.883, -1.478))
BEGIN = ("initial_x", "initial_y", "initial_z", "initial_yaw")  # of the simulator
SURVEY_SPEED = 4.0       # simulated seconds in one of the wall clock
SURVEY_SECONDS = 1500.0  # of the wall clock, if nothing else ends it
ABOVE = 4.5          # m: the survey's height


class NotRun(Exception):
    """The machine does not allow this storm; the message says why."""


def process_id(node):
    """None where the node is not there."""
    import rosgraph
    try:
        return xmlrpc.client.ServerProxy(rosgraph.Master("/storm").lookupNode(node)).getPid("/storm")[2]
    except (rosgraph.MasterError, OSError, xmlrpc.client.Error):
        return None


def resident_mb(pid):
    """0 where the process has ended."""
    try:
        with open("/proc/%d/status" % pid) as file:
            for line in file:
                if line.startswith("VmRSS:"):
                    return int(line.split()[1]) / 1e3
    except OSError:
        pass
    return 0.0


def cpu_seconds(pid):
    """0 where the process has ended."""
    try:
        with open("/proc/%d/stat" % pid) as file:
            fields = file.read().rsplit(")", 1)[1].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Overrides:
    """Parameter files of config/ with some values replaced. Those that the user gave as NODE/NAME=VALUE win: with
    them a storm is shown to fail."""

    def __init__(self, folder, given=()):
        self.folder, self.given = folder, {}
        for text in given:
            name, _, value = text.partition("=")
            node, _, parameter = name.partition("/")
            self.given.setdefault(node, {})[parameter] = value

    def write(self, node, config, **values):
        import yaml
        with open(share_file("config", config)) as file:
            parameters = dict(yaml.safe_load(file) or {}, **values)
        parameters.update((key, yaml.safe_load(text)) for key, text in self.given.get(node, {}).items())
        name = os.path.join(self.folder, config)
        with open(name, "w") as file:
            yaml.safe_dump(parameters, file)
        return name


class Master:
    """A rosmaster as a child process, which may be killed and started again."""

    def __init__(self, host="localhost"):
        self.port = free_port()
        os.environ["ROS_MASTER_URI"] = "http://%s:%d" % (host, self.port)
        os.environ["ROS_HOSTNAME"] = host
        os.environ.pop("ROS_IP", None)
        self.process = None

    def __enter__(self):
        import rosgraph
        self.process = subprocess.Popen(["rosmaster", "--core", "-p", str(self.port)], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL, start_new_session=True)
        deadline = time.monotonic() + START_SECONDS
        while not rosgraph.is_master_online():
            if time.monotonic() > deadline:
                raise SessionFailed("no rosmaster")
            time.sleep(0.05)
        return self

    def kill(self):
        self.process.kill()
        self.process.wait()

    def __exit__(self, *_):
        self.kill()


class Session:
    """The nodes of a launch file under a master of their own, and a drive of the vehicle between two ends."""

    NODES = ()
    COMMANDER, TICK = "/navigate_path", 0.02  # publishes cmd_vel; s, its period
    PREFIX = "navigate_prefix"  # the launch file's argument for what is put before the command of the commander
    OVER_A_LINK = {"tf_timeout": 1.0, "no_progress_timeout": 0.0}  # what changes of its parameters where it is on one
    KNOWS_AGES = True  # of all that the commander drives by
    MASTER_TIMEOUT = 6.0  # s, of the commander where it is given in `commander`; None: it has none
    THERE = 0.4      # m: so near to an end the vehicle is sent to the other
    # For the kills in it:
    MAP_NODE = None  # the first map after its end is to have what was occupied
    FIRST_CELLS = 300  # occupied ones before the first kill
    ERASED = 0       # cells that may be free after a kill, beside twice of what one map frees without; an empty map erases hundreds
    BRAKING = 1.2    # simulated s to a stand, and what a message takes

    def __init__(self, folder, launch_file, arguments, ends, host="localhost"):
        self.folder, self.launch_file, self.arguments, self.ends = folder, launch_file, arguments, ends
        self.master = Master(host)
        os.environ["GRID_PATH_PLANNER_SAVE_FOLDER"] = os.path.join(folder, "kept")

    def __enter__(self):
        self.master.__enter__()
        self.nodes = Nodes(self.launch_file, self.arguments, os.path.join(self.folder, "log"), own_master=False)
        try:
            self.vehicle = Vehicle(self.nodes)
            self.vehicle.wait_until_ready()
            self.drive = Drive(self.nodes, self.vehicle, self.ends, self.THERE)
            for node in self.NODES:
                self.nodes.wait_until(lambda node=node: process_id(node), START_SECONDS, node)
            self.prepare()
        except BaseException:
            self.__exit__()
            raise
        return self

    def prepare(self):
        """Once all nodes are there."""

    def pids(self):
        return {node: process_id(node) for node in self.NODES}

    def __exit__(self, *_):
        self.nodes.__exit__()
        self.master.__exit__()


class Demo(Session):
    """The demo's nodes with the vehicle at the first of ENDS, and a drive from there. Without a survey before, it
    begins there and knows nothing of the site: it drives above the rocks, which it maps as obstacles all the same."""

    NODES = ("/simulator", "/projected_map", "/path_planner", "/navigate_path", "/teleop_joy")
    MAP_NODE, ERASED = "/projected_map", 10

    def __init__(self, folder, given=(), simulator=(), mapping=(), commander=(), arguments=(),
                 survey=False, host="localhost"):
        overrides = Overrides(folder, given)
        ends = ENDS if survey else [(x, y, ABOVE, yaw) for x, y, _, yaw in ENDS]
        begin = {} if survey else dict(zip(BEGIN, ends[0]))
        self.survey = survey
        super().__init__(folder, "demo.launch", list(arguments) + [
            "simulator_overrides:=" + overrides.write("simulator", "demo_simulator.yaml", **dict(begin, **dict(simulator))),
            # whole maps are what is compared
            "mapping_overrides:=" + overrides.write("projected_map", "demo_mapping.yaml",
                                                    always_send_full_map=True, **dict(mapping)),
            "navigate_overrides:=" + overrides.write("navigate_path", "demo_navigate.yaml", control_rate=50.0,
                                                     **dict(commander))], ends, host)

    def prepare(self):
        """A survey as fast as the machine can; then the simulator is one that starts at the first of ENDS."""
        if not self.survey:
            return
        import rospy
        set_simulator("real_time_factor", SURVEY_SPEED)
        self.vehicle.drive_file("/survey", share_file("config", "survey_waypoints.yaml"), SURVEY_SECONDS)
        set_simulator("real_time_factor", 1.0)
        for name, value in zip(BEGIN, ENDS[0]):
            rospy.set_param("/simulator/" + name, value)


class Drive:
    """Sends the vehicle to and fro between two ends by path_planner and navigate_path."""

    def __init__(self, nodes, vehicle, ends=ENDS, there=Session.THERE):
        import rospy
        from geometry_msgs.msg import PoseStamped
        from grid_path_planner.msg import PlanStatistics
        from nav_msgs.msg import Path
        self.nodes, self.vehicle, self.ends, self.there = nodes, vehicle, ends, there
        self.goal_type, self.path, self.found, self.reason = PoseStamped, None, 0, "nothing"
        self.end = 1
        self.goals = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1)
        rospy.Subscriber("path", Path, self.on_path)
        rospy.Subscriber("plan_statistics", PlanStatistics,
                         lambda m: setattr(self, "reason", "%s: %s" % (m.status, m.message)))

    def on_path(self, message):
        if message.poses:
            self.path = message

    def is_there(self):
        return self.vehicle.distance(self.ends[self.end]) < self.there

    def send_goal(self):
        """To the end that it drives to, or the other where it is there."""
        if self.is_there():
            self.end = 1 - self.end
        self.publish_goal()

    def publish_goal(self):
        goal = self.goal_type()
        goal.header.frame_id = "map"
        goal.header.stamp = self.vehicle.stamp
        x, y, z, yaw = self.ends[self.end]
        goal.pose.position.x, goal.pose.position.y, goal.pose.position.z = x, y, z
        goal.pose.orientation.z, goal.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        self.goals.publish(goal)

    def retry(self, done, what, every=2.0):
        """Sends the goal again, every so many seconds, until it is done: one may come before a node is there."""
        deadline, due = time.monotonic() + BACK_SECONDS, 0.0
        while not done():
            self.nodes.check()
            self.vehicle.check_untouched()
            if time.monotonic() > deadline:
                raise SessionFailed("no %s within %.0f s; path_planner says %s; see %s" % (
                    what, BACK_SECONDS, self.reason, self.nodes.log_name))
            if time.monotonic() > due and self.goals.get_num_connections() > 0:
                self.send_goal()
                due = time.monotonic() + every
            time.sleep(0.02)

    def ask(self):
        """A path from where the vehicle is."""
        self.path = None
        self.retry(lambda: self.path is not None, "path")
        self.found += 1
        return self.path

    def ask_once(self, too_late):
        """The same, asked once; None where it is too late before there is one, as where the planner is away."""
        self.path = None
        if self.goals.get_num_connections() > 0:
            self.send_goal()
        while self.path is None and not too_late():
            self.nodes.check()
            time.sleep(0.02)
        if self.path is None or too_late():
            return None
        self.found += 1
        return self.path

    def goes_on(self, metres=0.3):
        """Until the vehicle has driven so far, on a path that was asked for now."""
        self.ask()
        begin = self.vehicle.driven_m
        self.retry(lambda: self.vehicle.driven_m > begin + metres, "motion", every=5.0)
        self.vehicle.check_untouched()

    def goes_on_unasked(self, metres=0.3, seconds=BACK_SECONDS):
        """The same, on the path that it has, or until it is where that ends; whether it has driven so far."""
        begin = self.vehicle.driven_m
        self.nodes.wait_until(lambda: self.vehicle.driven_m > begin + metres or self.is_there(), seconds,
                              "motion without a new goal")
        return self.vehicle.driven_m > begin + metres

    def seconds(self, seconds):
        """Drives on for so long, wall clock."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            self.nodes.check()
            self.vehicle.check_untouched()
            if self.is_there():
                self.ask()
            time.sleep(0.05)
