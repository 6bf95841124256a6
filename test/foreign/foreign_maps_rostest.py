#!/usr/bin/env python3
"""Maps of other programs, to every node and command that takes one.

`expect` has
    sees      room: around the wall, stopped before it, its cells; nothing: the way is as it was without the wall
    length    m of the path from ask.start to ask.goal instead
    told      what the log says of it, once however often such a map comes
    first     of the messages, which the node serves; else the last
    refused   what the log says; the map before stays
`ask` has frame, frames, start, goal, shift, turn, unknown_is_passable.
"""
import json
import math
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import foreign_nodes
import rooms
import rosbag
import rospy
import rostest
import table
from foreign_nodes import ForeignTest, Row, wait_until
from genpy.message import strify_message
from right_messages import of
from roslib.message import get_service_class
from running_nodes import executable

TINY = 1e-9
PLANNING = ["_smooth:=false", "_outside:=free", "_unknown_is_passable:=false"]
MAPS = {"projected_map": "nav_msgs/OccupancyGrid", "projected_map_updates": "map_msgs/OccupancyGridUpdate"}
PLANNER = Row(inputs=MAPS, outputs={}, services={"~make_plan": "nav_msgs/GetPlan"}, actions={}, arguments=PLANNING,
              tf="listens", probe=None)
DRIVER = Row(inputs=MAPS, outputs={"cmd_vel": "geometry_msgs/Twist"}, services={},
             actions={"navigate_path": "grid_path_planner/NavigatePath"},
             # Each row puts the vehicle elsewhere, which is no jump to end a drive for.
             arguments=["_no_progress_timeout:=0", "_lookahead:=8", "_pose_jump:=0"], tf="listens", probe=None)
LAYERED = {"projected_map": "nav_msgs/OccupancyGrid"}
LAYERS = Row(inputs={"static_map": "nav_msgs/OccupancyGrid"}, outputs=LAYERED, services={}, actions={}, arguments=[],
             tf="listens", probe=None)
LIVE = Row(inputs={"static_map": "nav_msgs/OccupancyGrid", "live_map": "nav_msgs/OccupancyGrid"}, outputs=LAYERED,
           services={}, actions={}, arguments=["_use_live_map:=true", "_source_timeout:=60"], tf="listens", probe=None)


def length_of(poses):
    points = [pose.pose.position for pose in poses]
    return sum(math.hypot(b.x - a.x, b.y - a.y) for a, b in zip(points, points[1:]))


def moved(row, point):
    """Where the row's map has that point of the room."""
    ask = row.get("ask", {})
    x, y = rooms.rotated(point, ask.get("turn", 0.0))
    east, north = ask.get("shift", (0.0, 0.0))
    return x + east, y + north


def ends(row):
    ask = row.get("ask", {})
    return moved(row, ask.get("start", rooms.START)), moved(row, ask.get("goal", rooms.GOAL))


def expected_length(row, expect):
    if "length" in expect:
        return expect["length"]
    return rooms.AROUND if expect.get("sees") == "room" else rooms.STRAIGHT


def differs(length, wanted, expect):
    return not abs(length - wanted) < expect.get("within", TINY)


class Maps(ForeignTest):
    kind = "maps"
    goals = 0

    def messages(self, row):
        """Stamped now, each a little later than the one before unless the row says how."""
        now = self.now()
        messages = rooms.messages_of(row, now)
        table.change(messages[-1], row.get("set"), now)
        return messages

    def give(self, node, topic, row):
        messages = self.messages(row)
        if row.get("make") != "by_another_node":
            for message in messages:
                node.send(topic, message)
            return
        bag = self.bag(row, messages, node.resolved(topic))
        subprocess.run(["rosbag", "play", "--immediate", "--quiet", "--wait-for-subscribers", bag], check=True,
                       stdout=subprocess.DEVNULL)

    def bag(self, row, messages, topic):
        name = os.path.join(self.folder.name, row["id"] + ".bag")
        with rosbag.Bag(name, "w") as bag:
            for index, message in enumerate(messages):
                bag.write(topic, message, table.time_of("now + %f" % (0.1 * index), self.now()))
        return name

    def test_path_planner(self):
        node = self.node("path_planner", PLANNER)
        self.each("path_planner", lambda row, expect: self.planned(node, row, expect))

    def planned(self, node, row, expect):
        ask = row.get("ask", {})
        node.place(*rooms.START, others=ask.get("frames"))
        request = get_service_class("nav_msgs/GetPlan")._request_class()

        def plan(start, goal, frame):
            for pose, place in ((request.start, start), (request.goal, goal)):
                pose.header.frame_id = frame
                pose.pose.position.x, pose.pose.position.y, pose.pose.orientation.w = place[0], place[1], 1.0
            answer = node.call("~make_plan", request)
            return length_of(answer.plan.poses) if answer and len(answer.plan.poses) > 1 else math.nan
        node.send("projected_map", rooms.before(self.now()))
        if not wait_until(lambda: abs(plan(rooms.START, rooms.GOAL, "map") - rooms.STRAIGHT) < TINY):
            return "the room without a wall is not planned on"
        node.mark()
        self.give(node, "projected_map", row)
        if "refused" in expect and not wait_until(lambda: node.says(expect["refused"])):
            return "it is not refused: " + node.said(node.marked)
        wanted = expected_length(row, expect)
        lengths = []

        def answered():
            lengths.append(plan(*ends(row), ask.get("frame", "map")))
            return not differs(lengths[-1], wanted, expect)
        if expect.get("sees") != "nothing" and not wait_until(answered, 3.0 if row.get("open") else 20.0):
            return "%.9f m, not %.9f; it said: %s" % (lengths[-1], wanted, node.said(node.marked)[-400:])
        return self.told(node, "projected_map", row, expect)

    def told(self, node, topic, row, expect):
        """Once, though such a map comes again."""
        if "told" not in expect:
            return ""
        if not wait_until(lambda: node.says(expect["told"]), 3.0 if row.get("open") else 20.0):
            return "it does not say %s" % expect["told"]
        self.give(node, topic, row)
        return "" if node.times_said(expect["told"]) == 1 else "it says %s more than once" % expect["told"]

    def test_navigate_path(self):
        node = self.node("navigate_path", DRIVER)
        self.each("navigate_path", lambda row, expect: self.driven(node, row, expect))

    def driven(self, node, row, expect):
        """Sent straight through the wall, the vehicle, which here never moves, drives until there is one."""
        if "length" in expect or expect.get("sees") == "nothing":
            return ""
        ask, (start, goal) = row.get("ask", {}), ends(row)
        frames = dict(ask.get("frames", {}))
        frame = ask.get("frame", "map")
        inside = frames.get(frame, {})
        node.place(start[0] + inside.get("x", 0.0), start[1] + inside.get("y", 0.0), others=frames)
        plain = rooms.before(self.now())
        shift = ask.get("shift", (0.0, 0.0))
        plain.info.origin.position.x += shift[0]
        plain.info.origin.position.y += shift[1]
        if ask.get("turn") or inside:  # room for what is turned
            plain.info.origin.position.x, plain.info.origin.position.y, plain.info.resolution = -10.0, -10.0, 2.0
        node.send("projected_map", plain)
        message, goals = of("grid_path_planner/NavigatePathActionGoal"), []
        message.goal.path = of("nav_msgs/Path", header={"frame_id": frame}, poses=[
            {"pose": {"position": {"x": x, "y": y}, "orientation": {"w": 1.0}}} for x, y in (start, goal)])

        def send():
            """Again, since tf may come later than the goal."""
            type(self).goals += 1
            goals.append("goal %d" % self.goals)
            message.goal_id.id = goals[-1]
            node.send("navigate_path/goal", message)

        def state():
            heard = [f for f in node.heard("navigate_path/feedback") if f.status.goal_id.id == goals[-1]]
            ended = [r for r in node.heard("navigate_path/result") if r.status.goal_id.id == goals[-1]]
            if ended:
                return "ended", ended[-1].result.message
            return (heard[-1].feedback.state, heard[-1].feedback.message) if heard else ("", "")
        send()
        if not wait_until(lambda: state()[0] == "driving", 20.0, lambda: state()[0] in ("ended", "blocked") and send(), 1.0):
            return "without a wall it does not drive: %s %s" % state()
        node.mark()
        self.give(node, "projected_map", row)
        if "refused" in expect:
            refused = wait_until(lambda: node.says(expect["refused"]))
            return "" if refused and state()[0] == "driving" else "%s: %s" % (state(), node.said(node.marked))
        if not wait_until(lambda: state()[0] == "blocked" and "occupied" in state()[1], 3.0 if row.get("open") else 20.0):
            return "it does not stop: %s %s" % state()
        return self.told(node, "projected_map", row, expect)

    def test_map_layers(self):
        node = self.node("map_layers", LAYERS)
        self.each("map_layers", lambda row, expect: self.merged(node, "static_map", row, expect))

    def test_map_layers_live(self):
        node = self.node("map_layers", LIVE, space="/live_layers")
        node.send("static_map", rooms.before(self.now()))
        self.each("map_layers live", lambda row, expect: self.merged(node, "live_map", row, expect))

    def merged(self, node, topic, row, expect):
        """The cells that it publishes are those of the map."""
        def cells():
            heard = node.heard("projected_map")
            return list(heard[-1].data) if heard else None
        if not wait_until(lambda: cells() == rooms.cells(0), send=lambda: node.send(topic, rooms.before(self.now())), every=1.0):
            return "the room without a wall does not come"
        node.mark()
        self.give(node, topic, row)
        if "refused" in expect:
            refused = wait_until(lambda: node.says(expect["refused"]))
            return "" if refused else "it is not refused: " + node.said(node.marked)
        wanted = list(self.messages(row)[-1].data)
        if expect.get("overlays"):
            met = wait_until(lambda: 100 in cells())
        else:
            met = wait_until(lambda: cells() == wanted, 3.0 if row.get("open") else 20.0)
        if not met:
            return "other cells; it said: " + node.said(node.marked)[-400:]
        return self.told(node, topic, row, dict(expect, told=expect["told"]) if expect.get("sees") == "room" and "told" in expect else {})

    def test_commands(self):
        """grid_path plan, of a bag and of what rostopic echo prints."""
        self.each("plan", lambda row, expect: self.commanded(row, expect, self.bag(row, self.messages(row), "/projected_map")))
        self.each("dump", lambda row, expect: self.commanded(row, expect, self.dump(row)))

    def dump(self, row):
        name = os.path.join(self.folder.name, row["id"] + ".yaml")
        with open(name, "w") as file:
            file.write(strify_message(self.messages(row)[-1]) + "\n---\n")
        return name

    def commanded(self, row, expect, file):
        start, goal = ((x + east, y + north) for (x, y), (east, north) in
                       zip(ends(row), [expect.get("shifted", (0.0, 0.0))] * 2))
        passable = row.get("ask", {}).get("unknown_is_passable", False)
        command = [executable("grid_path"), "plan", "--map", file, "--json", "--smooth", "false", "--outside", "free",
                   "--unknown-is-passable", str(passable).lower(), "--start", "%r,%r" % start, "--goal", "%r,%r" % goal]
        run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
        if "refused" in expect:
            return "" if run.returncode == 2 and self.has(run.stderr, expect["refused"]) else run.stderr or run.stdout
        if run.returncode != 0:
            return run.stderr or run.stdout
        if not self.has(run.stderr + run.stdout, expect.get("told", "")):
            return "it does not say %s: %s" % (expect["told"], run.stderr)
        wanted = rooms.AROUND if "shifted" in expect else expected_length(row, expect)
        length = json.loads(run.stdout)["length_m"]
        return "%.9f m, not %.9f" % (length, wanted) if differs(length, wanted, expect) else ""

    @staticmethod
    def has(text, sentence):
        return foreign_nodes.re.search(sentence, text, foreign_nodes.re.DOTALL) is not None

    def update(self, row):
        now = self.now()
        update = of("map_msgs/OccupancyGridUpdate", header={"frame_id": "map", "stamp": {"secs": now.secs, "nsecs": now.nsecs}},
                    x=rooms.WALL, y=0, width=1, height=rooms.HEIGHT - rooms.GAP, data=[100] * (rooms.HEIGHT - rooms.GAP))
        if row.get("set", {}).get("x"):
            update.width, update.data = 10, [100] * 10 * update.height
        return table.change(update, row.get("set"), now)

    def test_updates(self):
        """Maps and updates have connections of their own: the map is there before the update is sent."""
        rows = table.rows("updates")
        for name, row in (("path_planner", PLANNER), ("navigate_path", DRIVER), ("map_layers", LAYERS)):
            topic = "static_map" if name == "map_layers" else "projected_map"
            node = self.node(name, row._replace(inputs=dict(row.inputs, **{topic + "_updates": "map_msgs/OccupancyGridUpdate"})),
                             space="/updates_of_" + name)
            self.each(name, lambda row, expect, node=node, topic=topic, name=name: self.updated(node, name, topic, row, expect), rows)

    def updated(self, node, name, topic, row, expect):
        seen = {"path_planner": self.planned, "navigate_path": self.driven, "map_layers": lambda n, r, e: self.merged(n, topic, r, e)}[name]
        give = self.give
        self.give = lambda n, t, r: n.send(topic + "_updates", self.update(row))
        try:
            return seen(node, {"id": row["id"], "expect": expect}, expect)
        finally:
            self.give = give

    def test_map_publisher(self):
        self.each("map_publisher", self.published)

    def published(self, row, expect):
        """The static_map that it serves has the cells of the map in the bag."""
        file = self.bag(row, self.messages(row), "/projected_map")
        node = foreign_nodes.ForeignNode("map_publisher", Row(
            inputs={}, outputs={"projected_map": "nav_msgs/OccupancyGrid"}, services={"static_map": "nav_msgs/GetMap"}, actions={},
            arguments=[file], tf="", probe=None), self.folder.name, space="/" + row["id"])
        try:
            if "refused" in expect:
                return "" if wait_until(lambda: node.says(expect["refused"], 0)) else node.said()
            heard = wait_until(lambda: node.heard("projected_map") or not node.lives())
            if heard is True or not heard:
                return "no map: " + node.said()
            return "" if list(heard[-1].data) == list(self.messages(row)[expect.get("first", -1)].data) else "other cells"
        finally:
            node.end(9)


if __name__ == "__main__":
    rospy.init_node("foreign_maps", disable_signals=True)
    rostest.rosrun("grid_path_planner", "foreign_maps", Maps)
