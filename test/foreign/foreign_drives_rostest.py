#!/usr/bin/env python3
"""What other programs give to those who drive: paths, files of waypoints, goals and cancels of actions, joysticks, parameters,
and what their vehicles do.

`expect` has
    remaining  m that are left of the path, by the feedback of the action or by the diagnostics
    waypoints  both or utm: those of a file, of which 2 m are left
    refused    what the result or the log says
    taken      the goal becomes active; results: how many it has by then
    cancelled  the goal that was active ends
    commands   none, ahead, or `then zero`
    told       what the log says
    a parameter's name: its value then
`ask` has frames, and parameters that are set while the node runs.
"""
import copy
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import foreign_files
import foreign_nodes
import rospy
import rostest
import table
from dynamic_reconfigure.client import Client
from foreign_nodes import ForeignTest, Row, re, wait_until
from message_classes import message_class
from right_messages import joystick, of, pose
from roslib.message import get_service_class

PLACE = (1.25, 1.25)
EAST, NORTH = 500000.0, 4500000.0  # of utm
STATUS = "actionlib_msgs/GoalStatusArray"
NAVIGATE = "grid_path_planner/NavigatePath"
ACTIVE, PREEMPTED, RECALLED = 1, 2, 8
FEW = 1.5  # s, in which nothing comes
ENOUGH = float(os.environ.get("ENOUGH", "20"))  # s, for what has to come
DRIVER = Row(inputs={"path": "nav_msgs/Path"},
             outputs={"cmd_vel": "geometry_msgs/Twist", "navigate_path/status": STATUS}, services={"~cancel": "std_srvs/Trigger"},
             actions={"navigate_path": NAVIGATE}, arguments=["_check_map:=false", "_no_progress_timeout:=0"], tf="listens", probe=None)
WHEELS = DRIVER._replace(arguments=DRIVER.arguments + [
    "_vehicle/drive:=differential", "_vehicle/radius:=0.2", "_vehicle/max_speed:=0.5", "_vehicle/max_yaw_rate:=1.0",
    "_vehicle/max_acceleration:=0.8", "_vehicle/max_yaw_acceleration:=2.0"])
FLYER = DRIVER._replace(arguments=["_recover:=false", "_stuck_timeout:=1e6"])
GO_TO = Row(inputs={}, outputs={"plan_path/goal": "grid_path_planner/PlanPathActionGoal", "move_base/status": STATUS}, services={},
            actions={"move_base": "move_base_msgs/MoveBase"}, arguments=[], tf="listens", probe=None)
JOYSTICK = Row(inputs={"joy": "sensor_msgs/Joy"}, outputs={"cmd_vel": "geometry_msgs/Twist"}, services={}, actions={}, arguments=[],
               tf="", probe=None)
NOTHING = Row(inputs={}, outputs={}, services={}, actions={}, arguments=[], tf="", probe=None)
# Who has such parameters: a length, a speed or a time, and a choice among numbers.
NUMBERS = {"path_planner": "radius", "navigate_path": "max_speed", "go_to_pose": "back_off_distance", "teleop_joy": "joy_timeout"}
CHOICES = {"path_planner": "connectivity"}


def header(now, frame="map"):
    return {"frame_id": frame, "stamp": {"secs": now.secs, "nsecs": now.nsecs}}


def path_of(row, now):
    places = [(PLACE[0] + way, PLACE[1]) for way in (0.0, 2.5, 5.0)]
    make = row.get("make")
    if make == "repeated":
        places = [place for place in places for _ in range(3)]
    if make == "dense":
        places = [(PLACE[0] + 0.025 * i, PLACE[1]) for i in range(201)]
    if make == "goal_alone":
        places = places[-1:]
    if make == "in_utm":
        places = [(x + EAST, y + NORTH) for x, y in places]
    frame = "utm" if make == "in_utm" else "map"
    path = of("nav_msgs/Path", header=header(now, frame), poses=[{"header": header(now, frame), "pose": pose(*place)} for place in places])
    return table.change(path, row.get("set"), now)


def is_zero(twist):
    return not any(getattr(part, axis) for part in (twist.linear, twist.angular) for axis in "xyz")


class Drives(ForeignTest):
    kind = "paths"
    goals = 0

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.diagnostics = {}
        rospy.Subscriber("/diagnostics", message_class("diagnostic_msgs/DiagnosticArray"), cls.note)

    @classmethod
    def note(cls, array):
        for status in array.status:
            cls.diagnostics[status.name.split("/")[-1]] = status

    @classmethod
    def next_id(cls):
        cls.goals += 1
        return "goal %d" % cls.goals

    def rows_of(self, kind, taker):
        return [row for row in table.rows(kind) if taker in row["expect"].get("only", [taker])]

    def frames(self, node, row):
        node.frames = dict({"base_link": {"parent": "map", "x": PLACE[0], "y": PLACE[1]}}, **row.get("ask", {}).get("frames", {}))
        for name, value in row.get("ask", {}).get("parameters", {}).items():
            self.set(node, name, value)
            self.addCleanup(self.reset, node, name)

    @staticmethod
    def set(node, name, value):
        client = Client(node.full_name(), timeout=30)
        try:
            return client.update_configuration({name: value})
        finally:
            client.close()

    # Paths and files, by the action

    def ended(self, node, action, identity):
        results = [r for r in node.heard(action + "/result") if r.status.goal_id.id == identity]
        return results[-1] if results else None

    def followed(self, node, row, expect, change, remaining):
        """`change` fills in the goal. It is given again and again, since tf may come later than the goal."""
        ids = []

        def send():
            goal = of(NAVIGATE + "ActionGoal", goal_id={"id": self.next_id()})
            change(goal.goal)
            ids.append(goal.goal_id.id)
            node.send("navigate_path/goal", goal)

        def answer():
            """Of the newest."""
            result = self.ended(node, "navigate_path", ids[-1])
            if result:
                return result.result.status + ": " + result.result.message
            heard = [f for f in node.heard("navigate_path/feedback") if f.status.goal_id.id == ids[-1]]
            return heard[-1].feedback.distance_remaining_m if heard else None

        def is_right():
            found = answer()
            if "refused" in expect:
                return isinstance(found, str) and found.startswith("INVALID_REQUEST") and re.search(expect["refused"], found)
            return isinstance(found, float) and abs(found - remaining) < expect.get("within", 1e-3)
        seconds = 5.0 if row.get("open") else ENOUGH
        return "" if wait_until(is_right, seconds, send, 1.0) else repr(answer())

    def test_paths_and_files(self):
        for name, row in (("navigate_path", DRIVER), ("local_planner", FLYER)):
            node = self.node(name, row)
            with self.subTest(paths=name):
                self.each(name, lambda row, expect, node=node: self.by_path(node, row, expect), self.rows_of("paths", name))
            with self.subTest(files=name):
                self.each(name, lambda row, expect, node=node: self.by_file(node, row, expect), self.rows_of("waypoint_files", name))

    def by_path(self, node, row, expect):
        self.frames(node, row)

        def change(goal):
            goal.path = path_of(row, self.now())
        try:
            return self.followed(node, row, expect, change, expect.get("remaining"))
        finally:
            self.restore(node, row)

    def restore(self, node, row):
        for name in row.get("ask", {}).get("parameters", {}):
            self.set(node, name, "refused")

    def by_file(self, node, row, expect):
        """Of a file of the world or of utm, tf leads into it."""
        node.frames = {"base_link": {"parent": "map", "x": foreign_files.PLACES[0][0], "y": foreign_files.PLACES[0][1]},
                       "utm": {"parent": "map", "x": -EAST, "y": -NORTH}, "world": {"parent": "map"}}
        folder = os.path.join(self.folder.name, self.next_id())  # whose name is in no sentence that is expected
        os.makedirs(folder, exist_ok=True)
        file = foreign_files.waypoint_file(row, folder)

        def change(goal):
            goal.filename = file
        return self.followed(node, row, expect, change, 2.0)

    # Paths by the topic

    def test_paths_of_the_topic(self):
        node = self.node("navigate_path", DRIVER, space="/topic")
        self.each("path", lambda row, expect: self.by_topic(node, row, expect), self.rows_of("paths", "path"))

    def by_topic(self, node, row, expect):
        """After a path of another length."""
        self.frames(node, row)
        short = path_of({}, self.now())
        del short.poses[2]

        def restamped():
            now = self.now()
            short.header.stamp = type(now)(now.secs, now.nsecs)
            return short
        try:
            if not wait_until(lambda: self.remains(2.5), send=lambda: node.send("path", restamped()), every=1.0):
                return "the plain path is not driven: " + node.said()[-600:]
            node.mark()
            if "refused" in expect:
                said = wait_until(lambda: node.says(expect["refused"]), ENOUGH, lambda: node.send("path", path_of(row, self.now())), 1.0)
                return "" if said and self.remains(2.5) else "it says: " + node.said(node.marked)
            driven = wait_until(lambda: self.remains(expect["remaining"], expect.get("within", 1e-3)), ENOUGH, lambda: node.send("path", path_of(row, self.now())), 1.5)
            return "" if driven else node.said(node.marked)
        finally:
            self.restore(node, row)

    def remains(self, length, within=1e-3):
        status = self.diagnostics.get("navigate_path: path following")
        if not status or not status.message.startswith("driving"):
            return False
        left = {entry.key: entry.value for entry in status.values}["distance remaining (m)"]
        return abs(float(left) - length) < within

    # Actions

    def test_actions(self):
        for name, row, action in (("navigate_path", DRIVER, "navigate_path"), ("local_planner", FLYER, "navigate_path"),
                                  ("go_to_pose", GO_TO, "move_base")):
            node = self.node(name, row, space="/actions_of_" + name, at=PLACE)
            if not wait_until(lambda: self.statuses(node, action) is not None):
                self.fail("%s publishes no status: %s" % (name, node.said()))
            with self.subTest(actions=name):
                self.each(name, lambda row, expect, node=node, action=action: self.acted(node, action, row, expect),
                          self.rows_of("actions", name))

    @staticmethod
    def statuses(node, action):
        """Of the newest message: id, status."""
        heard = node.heard(action + "/status")
        return {status.goal_id.id: status.status for status in heard[-1].status_list} if heard else None

    def goal_of(self, action, identity, stamp=None):
        now = self.now()
        stamp = stamp or now
        if action == "move_base":
            goal = of("move_base_msgs/MoveBaseActionGoal")
            goal.goal.target_pose = of("geometry_msgs/PoseStamped", header=header(now), pose=pose(6.25, 1.25))
        else:
            goal = of(NAVIGATE + "ActionGoal")
            goal.goal.path = path_of({}, now)
        goal.goal_id.id, goal.goal_id.stamp = identity, stamp
        return goal

    def acted(self, node, action, row, expect):
        make, first, second = row["make"], self.next_id(), self.next_id()
        no_time = type(self.now())()

        def active(identity):
            return (self.statuses(node, action) or {}).get(identity) == ACTIVE

        def send(identity, stamp=None):
            node.send(action + "/goal", self.goal_of(action, identity, stamp))

        def cancel(identity="", stamp=None):
            node.send(action + "/cancel", message_class("actionlib_msgs/GoalID")(stamp or no_time, identity))
        send(first)
        if not wait_until(lambda: active(first), ENOUGH):
            return "the plain goal is not taken: %r" % self.ended(node, action, first)
        if "cancelled" in expect:
            cancel(*{"cancelled_by_id": (first,), "cancelled_all": (), "cancelled_until_now": ("", self.now())}[make])
            ended = wait_until(lambda: self.ended(node, action, first), ENOUGH)
            return "" if ended and ended.status.status in (PREEMPTED, RECALLED) else repr(ended and ended.status)
        if make.startswith("behind"):
            cancel("", self.now() if make == "behind_a_stamp" else None)
            if not wait_until(lambda: self.ended(node, action, first), ENOUGH):
                return "the cancel is not taken"
        identity = {"without_id": "", "of_roslibjs": "goal_0.7366798%d_1795995519491" % self.goals}.get(make, second)
        known = set(self.statuses(node, action))
        send(identity, self.now() - rospy.Duration(3600) if make.startswith("behind") else self.now() if make == "twice" else no_time)

        def taken():
            return active(identity) if identity else any(
                name not in known and status == ACTIVE for name, status in self.statuses(node, action).items())
        if not wait_until(taken, 5.0 if row.get("open") else ENOUGH):
            return "it is not taken: %r" % self.statuses(node, action)
        if make == "twice":
            send(identity)
            came = len(node.heard(action + "/status"))
            node.forget(action + "/status")
            wait_until(lambda: len(node.heard(action + "/status")) > 5 or not came)
            if not active(identity):
                return "the second ends the first"
        count = len([r for r in node.heard(action + "/result") if identity and r.status.goal_id.id == identity])
        return "" if count == expect.get("results", 0) else "%d results" % count

    # Joysticks

    def test_joysticks(self):
        node = self.node("teleop_joy", JOYSTICK)
        self.each("teleop_joy", lambda row, expect: self.steered(node, row, expect), table.rows("joysticks"))

    def steered(self, node, row, expect):
        plain = joystick(None)
        released = copy.deepcopy(plain)
        released.buttons = [0] * len(plain.buttons)
        message = table.change(joystick(None), row.get("set"), self.now())

        def commands():
            return [twist for twist in node.heard("cmd_vel") if not is_zero(twist)]

        def feed(what):
            node.send("joy", what)
        if not wait_until(commands, send=lambda: feed(plain), every=0.1):
            return "the plain one does not command"
        ahead = commands()[-1].linear.x
        feed(released)
        if not wait_until(lambda: is_zero(node.heard("cmd_vel")[-1])):
            return "it does not let go"
        node.forget("cmd_vel")
        node.mark()
        if expect["commands"] == "none":
            moved = wait_until(commands, FEW, lambda: feed(message), 0.05)
            if moved:
                return "it commands %r" % moved[-1]
            return "" if wait_until(lambda: node.says(expect.get("told", "")), ENOUGH) else node.said(node.marked)
        every = 100.0 if row.get("make") == "once" else 0.1
        if not wait_until(commands, ENOUGH, lambda: feed(message), every):
            return "nothing is commanded: " + node.said(node.marked)
        found = commands()[-1].linear.x
        if expect["commands"] == "then zero" and not wait_until(lambda: is_zero(node.heard("cmd_vel")[-1]), ENOUGH):
            return "it is not stopped"
        node.forget("cmd_vel")
        return "" if found == ahead else "%g m/s, not %g" % (found, ahead)

    # Parameters

    def test_parameters(self):
        for name in NUMBERS:
            self.each(name, lambda row, expect, name=name: self.begun(name, row, expect), self.rows_of("parameters", name))

    def begun(self, name, row, expect):
        """At the start. A name of the table is the number or the choice of this node."""
        names = {"radius": NUMBERS[name], "connectivity": CHOICES.get(name)}
        space = "/%s_of_%s" % (row["id"], name)
        for key, value in row["make"].items():
            if names.get(key, key) is None:
                return ""
            rospy.set_param("%s/%s/%s" % (space, name, names.get(key, key)), value)
        node = foreign_nodes.ForeignNode(name, NOTHING, self.folder.name, space=space)
        try:
            if "refused" in expect:
                wanted = names.get(expect["refused"], expect["refused"])
                ended = wait_until(lambda: not node.lives())
                return "" if ended and node.processes[0].returncode == 1 and node.says(wanted, 0) else node.said()
            if "told" in expect:
                return "" if wait_until(lambda: node.says(expect["told"], 0)) and node.lives() else node.said()
            key = next(key for key in expect if key in names)

            def value():
                return rospy.get_param("%s/%s/%s" % (space, name, names[key]), None)
            # A value of the wrong type is set to the one that it was taken for.
            right = wait_until(lambda: value() == expect[key] and isinstance(value(), type(expect[key])))
            return "" if right and node.lives() else "%r: %s" % (value(), node.said())
        finally:
            node.end(9)

    # What vehicles and operators do while a goal stands

    def test_vehicles(self):
        node = self.node("navigate_path", DRIVER, space="/vehicles")
        wheels = self.node("navigate_path", WHEELS, space="/wheels")
        self.each("navigate_path", lambda row, expect: self.driven(wheels if row["make"] == "sideways" else node, row, expect),
                  table.rows("vehicles"))

    def driven(self, node, row, expect):
        identity = self.next_id()
        node.frames = copy.deepcopy(row.get("frames", {"base_link": {"parent": "map", "x": PLACE[0], "y": PLACE[1]}}))
        goal = self.goal_of("navigate_path", identity)
        node.settle()

        def moves():
            return [twist for twist in node.heard("cmd_vel") if not is_zero(twist)]
        node.forget("cmd_vel")
        if not wait_until(moves, send=lambda: node.send("navigate_path/goal", goal), every=100.0):
            return "it does not drive: " + node.said()[-600:]
        node.forget("cmd_vel")
        try:
            return getattr(self, row["make"])(node, identity, expect)
        finally:
            node.call("~cancel", get_service_class("std_srvs/Trigger")._request_class())
            wait_until(lambda: self.ended(node, "navigate_path", identity))

    def sideways(self, node, _, expect):
        if not wait_until(lambda: len(node.heard("cmd_vel")) > 20):
            return "no commands"
        fastest = max(abs(twist.linear.y) for twist in node.heard("cmd_vel"))
        return "" if fastest <= expect["linear_y"] else "%g m/s to the side" % fastest

    def pose_jumps(self, node, identity, expect):
        node.frames["odom"]["y"] = expect["jump"]
        if not wait_until(lambda: self.ended(node, "navigate_path", identity), ENOUGH):
            return "it drives on: %r" % node.heard("cmd_vel")[-1].linear
        result = self.ended(node, "navigate_path", identity).result
        return "" if result.status == "POSE_JUMP" and is_zero(node.heard("cmd_vel")[-1]) else result.status

    def slowed(self, node, identity, expect):
        """The drive goes on with the new value."""
        self.set(node, "max_speed", expect["speed"])
        try:
            slow = wait_until(lambda: node.heard("cmd_vel") and abs(node.heard("cmd_vel")[-1].linear.x - expect["speed"]) < 1e-6, ENOUGH)
            if not slow:
                return "%r" % node.heard("cmd_vel")[-1].linear
            return "the goal ended" if self.ended(node, "navigate_path", identity) else ""
        finally:
            self.set(node, "max_speed", 0.8)


if __name__ == "__main__":
    rospy.init_node("foreign_drives", disable_signals=True)
    rostest.rosrun("grid_path_planner", "foreign_drives", Drives)
