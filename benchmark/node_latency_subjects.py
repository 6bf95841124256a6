"""What node_latency measures: path_planner as a node and as a nodelet, and move_base with two planners and with ours."""
import math
import os
import time

import node_latency_maps as maps
from node_latency_ros import (DEADLINE, FRAME, Missed, Positions, Service, Topic, Usage, as_bytes, end, start, transforms_class,
                              update_class, wait_until, whole_map_class)

RADIUS, DECAY = 0.3, 3.0     # m, 1/m
POLL = 0.0005                # s between two questions for a plan that is not there yet


def executable(package, name):
    """None where no workspace of the environment has it."""
    for space in os.environ.get("CMAKE_PREFIX_PATH", "").split(":") + ["/usr"]:
        path = os.path.join(space, "lib", package, name)
        if os.path.exists(path):
            return path
    return None


def package_version(package):
    import rospkg
    try:
        return package + " " + rospkg.RosPack().get_manifest(package).version
    except rospkg.ResourceNotFound:
        return package


class Node:
    """A planning node with a tiny map, and all that one talks to it with. `world` is not sent yet."""

    has_goals = False  # answers goals and blocked paths by itself, on `path`

    def __init__(self, world, inflated, log_folder, grows):
        """`grows`: the case is about maps of another size than the first."""
        import rospy
        from geometry_msgs.msg import PoseStamped, TransformStamped
        from nav_msgs.srv import GetPlan
        self.PoseStamped, self.OccupancyGridUpdate, self.GetPlan = PoseStamped, update_class(), GetPlan
        self.world, self.inflated, self.log_folder, self.grows = world.copy(), inflated, log_folder, grows
        self.Map, Transforms = whole_map_class(), transforms_class()
        self.maps = rospy.Publisher("projected_map", self.Map.__mro__[1], queue_size=None, latch=True, tcp_nodelay=True)
        self.updates = rospy.Publisher("projected_map_updates", self.OccupancyGridUpdate, queue_size=None, tcp_nodelay=True)
        self.goals = rospy.Publisher("goal", PoseStamped, queue_size=None, tcp_nodelay=True)
        self.transforms = rospy.Publisher("/tf_static", Transforms, queue_size=1, latch=True)
        self.ends = self.corner(0), self.corner(1)
        vehicle = TransformStamped()
        vehicle.header.frame_id, vehicle.child_frame_id = FRAME, "base_link"
        vehicle.transform.translation.x, vehicle.transform.translation.y = self.ends[0]
        vehicle.transform.rotation.w = 1.0
        self.transforms.publish(Transforms([vehicle]))
        self.process = self.service = None
        self.topics = []

    def corner(self, which):
        """The middle of the free cells' first place from a corner where inflation leaves room."""
        side = min(self.world.width, self.world.height)
        for i in range(12, side // 2):
            at = i if which == 0 else side - 1 - i
            around = [self.world.at(at + c, at + r) for c in range(-10, 11) for r in range(-10, 11)]
            if not any(around):
                return self.world.centre(at, at)
        raise Missed("the map has no free corner")

    def __enter__(self):
        import rospy
        for name in self.parameters():
            rospy.set_param(name, self.parameters()[name])
        self.publish_map(self.first_map())
        self.process = start(self.command(), os.path.join(self.log_folder, "node.log"))
        try:
            self.service = Service(self.service_name, self.GetPlan)
            wait_until(lambda: self.maps.get_num_connections() > 0 and self.updates.get_num_connections() > 0,
                       "subscription to the map")
            self.usage = Usage(self.process.pid)
            self.connect()
        except BaseException:
            self.__exit__()
            raise
        return self

    def first_map(self):
        return maps.Map("tiny", 40, bytearray(1600), self.world.origin)

    def connect(self):
        """What a subject needs besides."""

    def __exit__(self, *_):
        import rospy
        end(self.process)
        for topic in self.topics:
            topic.close()
        for publisher in (self.maps, self.updates, self.goals, self.transforms):
            publisher.unregister()
        if rospy.has_param(self.namespace):
            rospy.delete_param(self.namespace)

    def topic(self, name):
        self.topics.append(Topic(name))
        wait_until(self.topics[-1].connected, name)
        return self.topics[-1]

    # Messages

    def pose(self, position):
        import rospy
        pose = self.PoseStamped()
        pose.header.frame_id, pose.header.stamp = FRAME, rospy.Time.now()
        pose.pose.position.x, pose.pose.position.y = position
        pose.pose.orientation.w = 1.0
        return pose

    def map_message(self, world):
        import rospy
        message = self.Map()
        message.header.frame_id, message.header.stamp = FRAME, rospy.Time.now()
        message.info.resolution, message.info.width, message.info.height = maps.RESOLUTION, world.width, world.height
        message.info.origin.position.x, message.info.origin.position.y = world.origin
        message.info.origin.orientation.w = 1.0
        message.data = bytes(world.cells)
        return message

    def publish_map(self, world):
        """When it was begun to be sent."""
        return self.send(self.map_message(world))

    def send(self, message):
        """The same of a map's message, stamped now."""
        import rospy
        message.header.stamp = rospy.Time.now()
        begin = time.monotonic()
        self.maps.publish(message)
        return begin

    def update(self, cells):
        """Sets cells occupied, an update each; when it was begun to be sent."""
        import rospy
        messages = []
        for column, row in cells:
            message = self.OccupancyGridUpdate(x=column, y=row, width=1, height=1, data=[maps.OCCUPIED])
            message.header.frame_id, message.header.stamp = FRAME, rospy.Time.now()
            messages.append(message)
            self.world.set(column, row, maps.OCCUPIED)
        begin = time.monotonic()
        for message in messages:
            self.updates.publish(message)
        return begin

    def request(self, from_position, to_position):
        return as_bytes(self.GetPlan._request_class(self.pose(from_position), self.pose(to_position), 0.0))

    def plan(self, request=None):
        """The path's positions."""
        answer = self.service.call(request or self.request(*self.ends))
        return Positions(answer) if answer else None

    def plan_when_there(self, accept=lambda path: True):
        """The first that there is and that is accepted, and when it came."""
        request = self.request(*self.ends)
        deadline = time.monotonic() + DEADLINE
        while time.monotonic() < deadline:
            path = self.plan(request)
            if path and path.count > 1 and accept(path):
                return path, time.monotonic()
            time.sleep(POLL)
        raise Missed("no such plan")

    def first_plan(self, on_time):
        """Sends the world and waits for a plan across it."""
        begin = self.publish_map(self.world)
        self.path, ended = self.plan_when_there()
        on_time(ended - begin)

    def cells_of(self, path):
        return {self.world.cell_entered(*path[i]) for i in range(path.count)}

    def path_around(self, cells, change):
        """Calls change(), which blocks these cells and returns when it began. How long until a path avoids them."""
        begin = change()
        self.path, ended = self.plan_when_there(lambda path: not self.cells_of(path) & set(cells))
        return ended - begin


class PathPlanner(Node):
    title = "path_planner"
    namespace, service_name = "/path_planner", "/path_planner/make_plan"
    has_goals = True

    @staticmethod
    def version():
        return package_version("grid_path_planner")

    def parameters(self):
        return {"/path_planner/radius": RADIUS if self.inflated else 0.0,
                "/path_planner/decay": DECAY if self.inflated else 0.0, "/path_planner/timeout": 60.0,
                "/path_planner/smooth": False,
                "/path_planner/outside": "free"}  # as the border is to the other nodes

    def command(self):
        return [executable("grid_path_planner", "path_planner"), "__name:=path_planner"]

    def connect(self):
        self.paths, self.statistics = self.topic("path"), self.topic("plan_statistics")
        wait_until(lambda: self.goals.get_num_connections() > 0, "subscription to goals")

    def first_plan(self, on_time):
        """By a goal, which is then the active one."""
        seen = len(self.paths.received)
        begin = self.publish_map(self.world)
        while time.monotonic() < begin + DEADLINE:  # a goal that comes before the map is answered on the tiny one
            self.goals.publish(self.pose(self.ends[1]))
            ended, data = self.paths.next(seen, "path")
            seen = len(self.paths.received)
            self.path = Positions(data)
            if self.path.count > 1:
                return on_time(ended - begin)
        raise Missed("no path across the map")

    def path_around(self, cells, change):
        seen = len(self.paths.received)
        begin = change()
        while True:
            ended, data = self.paths.next(seen, "path around an edit")
            seen += 1
            self.path = Positions(data)
            if self.path.count == 0:
                raise Missed("an edit closed the way")
            if not self.cells_of(self.path) & set(cells):
                return ended - begin

    def planning_times(self, first, goals):
        """Of the engine, by the index of the goal, of the plans to these goals in order; None that of a plan which was
        not told, since the topic keeps the newest only. `first`: as many statistics came before."""
        from grid_path_planner.msg import PlanStatistics
        times, at = [None] * len(goals), 0
        for _, data in self.statistics.received[first:]:
            plan = PlanStatistics().deserialize(data)
            position = plan.goal.pose.position
            for i in range(at, len(goals)):
                if math.dist((position.x, position.y), goals[i]) < 1e-9:
                    times[i], at = plan.planning_time_ms * 1e-3, i + 1
                    break
        return times


class PathPlannerNodelet(PathPlanner):
    title = "path_planner, nodelet"

    def command(self):
        return [executable("nodelet", "nodelet"), "standalone", "grid_path_planner/path_planner",
                "__name:=path_planner"]


class PathPlannerAStar(PathPlanner):
    """The same with the planner that prepares nothing."""
    title = "path_planner, a_star"

    def parameters(self):
        return dict(super().parameters(), **{"/path_planner/planner": "a_star"})


class MoveBase(Node):
    namespace, service_name = "/move_base", "/move_base/make_plan"
    update_frequency = 100.0

    @classmethod
    def version(cls):
        return package_version("move_base")

    def parameters(self):
        radius = RADIUS if self.inflated else 0.01
        layers = [{"name": "static_layer", "type": "costmap_2d::StaticLayer"},
                  {"name": "inflation_layer", "type": "costmap_2d::InflationLayer"}]
        return {self.namespace: {
            "base_global_planner": self.planner, "recovery_behavior_enabled": False, "recovery_behaviors": [],
            "global_costmap": {
                "global_frame": FRAME, "robot_base_frame": "base_link", "robot_radius": radius, "plugins": layers,
                "update_frequency": self.update_frequency, "publish_frequency": 0.0,
                "static_layer": {"map_topic": "projected_map", "subscribe_to_updates": True},
                "inflation_layer": {"inflation_radius": 1.5 if self.inflated else 0.0, "cost_scaling_factor": DECAY}},
            "local_costmap": {"global_frame": FRAME, "robot_base_frame": "base_link", "rolling_window": True, "width": 2.0,
                              "height": 2.0, "resolution": 0.1, "plugins": [], "update_frequency": 1.0}}}

    def first_map(self):
        """The world itself where that can be: it ends now and then while its costmap is made larger."""
        return super().first_map() if self.grows else self.world

    def command(self):
        return [executable("move_base", "move_base"), "__name:=" + self.namespace[1:]]


class MoveBaseGlobalPlanner(MoveBase):
    title, planner = "move_base, global_planner", "global_planner/GlobalPlanner"


class MoveBaseNavfn(MoveBase):
    title, planner = "move_base, navfn", "navfn/NavfnROS"


class MoveBaseGridPathPlanner(MoveBase):
    title, planner = "move_base, grid_path_planner", "grid_path_planner/GridPathPlanner"


def move_bases_in_environment():
    found = [MoveBaseGlobalPlanner, MoveBaseNavfn] if executable("move_base", "move_base") else []
    if found and executable("", "libgrid_path_planner_ros_move_base.so"):
        found.append(MoveBaseGridPathPlanner)
    return found


def subjects_in_environment():
    found = [PathPlanner, PathPlannerAStar] if executable("grid_path_planner", "path_planner") else []
    if found and executable("nodelet", "nodelet"):
        found.append(PathPlannerNodelet)
    return found + move_bases_in_environment()
