#!/usr/bin/env python3
"""Goals of other programs, to every node that takes one.

`expect` has
    place    [x, y, yaw] that is planned or driven to, in the map
    length   m of the path
    refused  what the answer or the log says
    silent   it is not a goal of now: nothing follows
    only     the receivers that it concerns
`ask` has frames, start (changes of a start) and tolerance.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rooms
import rospy
import rostest
import table
from foreign_nodes import ForeignTest, Row, re, wait_until
from node_table import DRIVER, PLANNER
from right_messages import of
from roslib.message import get_service_class

YAW = 0.5
PATH_PLANNER = Row(
    inputs={"projected_map": "nav_msgs/OccupancyGrid", "goal": "geometry_msgs/PoseStamped"},
    outputs={"path": "nav_msgs/Path", "plan_statistics": "grid_path_planner/PlanStatistics"},
    services={"~make_plan": "nav_msgs/GetPlan"}, actions={"plan_path": "grid_path_planner/PlanPath"},
    arguments=["_outside:=free", "_tf_timeout:=0.5"], tf="listens", probe=None)
GO_TO = Row(inputs=dict(PLANNER[0], **DRIVER[0], **{"move_base_simple/goal": "geometry_msgs/PoseStamped"}),
            outputs=dict(PLANNER[1], **DRIVER[1]), services={}, actions={"move_base": "move_base_msgs/MoveBase"},
            arguments=["_tf_timeout:=0.5"], tf="listens", probe=None)


def goal_of(row, now):
    goal = of("geometry_msgs/PoseStamped", header={"frame_id": "map", "stamp": {"secs": now.secs, "nsecs": now.nsecs}},
              pose={"position": {"x": rooms.GOAL[0], "y": rooms.GOAL[1]},
                    "orientation": {"z": math.sin(YAW / 2), "w": math.cos(YAW / 2)}})
    return table.change(goal, row.get("set"), now)


def start_of(row, now):
    start = of("geometry_msgs/PoseStamped", header={"frame_id": "map", "stamp": {"secs": now.secs, "nsecs": now.nsecs}},
               pose={"position": {"x": rooms.START[0], "y": rooms.START[1]}, "orientation": {"w": 1.0}})
    return table.change(start, row.get("ask", {}).get("start"), now)


def yaw_of(q):
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z)


def wrong_place(pose, expect):
    found = (pose.position.x, pose.position.y, yaw_of(pose.orientation))
    within = expect.get("within", 1e-9)
    return "" if max(abs(a - b) for a, b in zip(found, expect["place"])) < within else "at %r, not %r" % (found, expect["place"])


def wrong_path(poses, expect):
    if not poses:
        return "no path"
    points = [pose.pose.position for pose in poses]
    length = sum(math.hypot(b.x - a.x, b.y - a.y) for a, b in zip(points, points[1:]))
    if "length" in expect and abs(length - expect["length"]) > 1e-6:
        return "%.6f m" % length
    return wrong_place(poses[-1].pose, expect)


class Poses(ForeignTest):
    kind = "poses"
    rounds = 0

    def rows_of(self, taker):
        return [row for row in table.rows(self.kind) if taker in row["expect"].get("only", [taker])]

    def goal_id(self):
        type(self).rounds += 1
        return {"id": "goal %d" % self.rounds}

    def said_or(self, node, text, expect):
        """The answer of a service may come before the line of the log that tells its reason."""
        told = wait_until(lambda: re.search(expect["refused"], text + node.said(node.marked)), 20.0)
        return "" if told else "it says: " + text

    def test_path_planner(self):
        node = self.node("path_planner", PATH_PLANNER)
        free = rooms.before(self.now())
        node.send("projected_map", free)
        for taker, ask in (("goal", self.by_topic), ("make_plan", self.by_service), ("plan_path", self.by_action)):
            def placed(row, expect, ask=ask):
                node.place(*rooms.START, others=row.get("ask", {}).get("frames"))
                node.mark()
                return self.settled(node, row) or ask(node, row, expect)
            self.each(taker, placed, self.rows_of(taker))

    def settled(self, node, row):
        """The plain goal is planned for: the row's frames are there, and the goal before is over."""
        plain = dict(row, set={}, ask={})
        expect = {"place": [rooms.GOAL[0], rooms.GOAL[1], YAW]}
        last = []

        def planned():
            last[:] = [self.by_action(node, plain, expect)]
            return not last[0]
        return "" if wait_until(planned) else "the plain goal: " + last[0]

    def by_topic(self, node, row, expect):
        for topic in ("path", "plan_statistics"):
            node.forget(topic)
        node.send("goal", goal_of(row, self.now()))
        if "refused" in expect:
            heard = wait_until(lambda: any(s.status != "FOUND" for s in node.heard("plan_statistics")) or
                               node.says(expect["refused"]), 20.0)
            text = " ".join(s.status + " " + s.message for s in node.heard("plan_statistics"))
            return self.said_or(node, text, expect) if heard else "no answer"
        if not wait_until(lambda: node.heard("path") and node.heard("plan_statistics"), 20.0):
            return "no answer: " + node.said(node.marked)[-400:]
        statistics = node.heard("plan_statistics")[-1]
        return wrong_path(node.heard("path")[-1].poses, expect) and statistics.message

    def by_service(self, node, row, expect):
        request = get_service_class("nav_msgs/GetPlan")._request_class()
        now = self.now()
        request.start, request.goal = start_of(row, now), goal_of(row, now)
        request.tolerance = row.get("ask", {}).get("tolerance", 0.0)
        answer = node.call("~make_plan", request)
        if answer is None:
            return "no answer"
        if "refused" in expect:
            return "it is answered" if answer.plan.poses else self.said_or(node, "", expect)
        return wrong_path(answer.plan.poses, expect) and node.said(node.marked)[-400:] + wrong_path(answer.plan.poses, expect)

    def by_action(self, node, row, expect):
        now = self.now()
        goal = of("grid_path_planner/PlanPathActionGoal", goal_id=self.goal_id())
        goal.goal.start, goal.goal.goal = start_of(row, now), goal_of(row, now)
        goal.goal.tolerance_m = row.get("ask", {}).get("tolerance", 0.0)
        node.send("plan_path/goal", goal)

        def result():
            return [r for r in node.heard("plan_path/result") if r.status.goal_id.id == goal.goal_id.id]
        if not wait_until(result, 20.0):
            return "no result"
        answer = result()[0].result
        if "refused" in expect:
            return self.said_or(node, answer.status + " " + answer.message, expect)
        return wrong_path(answer.path.poses, expect) and answer.status + " " + answer.message

    def test_go_to_pose(self):
        node = self.node("go_to_pose", GO_TO)
        for taker in ("move_base", "move_base_simple/goal"):
            self.each(taker, lambda row, expect, taker=taker: self.goes(node, taker, row, expect), self.rows_of(taker))

    def goes(self, node, taker, row, expect):
        """What it asks the planner for, which is this test."""
        node.place(*rooms.START, others=row.get("ask", {}).get("frames"))
        plain = dict(row, set={})
        last = []

        def plain_goes():
            last[:] = [self.asks(node, "move_base", plain, {"place": [rooms.GOAL[0], rooms.GOAL[1], YAW]})]
            return not last[0]
        if not wait_until(plain_goes):
            return "the plain goal: " + last[0]
        node.mark()
        return self.asks(node, taker, row, expect)

    def asks(self, node, taker, row, expect):
        node.forget("plan_path/goal")
        pose = goal_of(row, self.now())
        identity = self.goal_id()
        if taker == "move_base":
            goal = of("move_base_msgs/MoveBaseActionGoal", goal_id=identity)
            goal.goal.target_pose = pose
            node.send("move_base/goal", goal)
        else:
            node.send("move_base_simple/goal", pose)
        if "silent" in expect:
            return "it is gone to" if wait_until(lambda: node.heard("plan_path/goal"), 1.0) else ""

        def text():
            return " ".join(r.status.text for r in node.heard("move_base/result") if r.status.goal_id.id == identity["id"])
        if "refused" in expect:
            wait_until(lambda: text() or node.says(expect["refused"]), 20.0)
            return self.said_or(node, text(), expect)
        if not wait_until(lambda: node.heard("plan_path/goal") or text(), 20.0):
            return "no plan is asked for: " + node.said(node.marked)[-400:]
        asked = node.heard("plan_path/goal")
        return wrong_place(asked[-1].goal.goal.pose, expect) if asked else text()


if __name__ == "__main__":
    rospy.init_node("foreign_poses", disable_signals=True)
    rostest.rosrun("grid_path_planner", "foreign_poses", Poses)
