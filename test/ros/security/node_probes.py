"""What each node answers to right data: `probe(node)` gives it and tries until the answer came or the deadline is over.

`node` is a RunningNode of running_nodes.py. A probe begins anew: it relies on nothing that was sent before.
"""
import math
import random
import time

from genpy import Duration
from right_messages import (
    ARRIVED, FOUND, SUCCEEDED, camera_info, camera_transforms, cloud, drive_goal, go_to_goal, grid, imu, initial_pose, joystick,
    of, path, picture, plan_goal, pose_stamped, scan, sky)
from roslib.message import get_service_class


def until(node, answered, deadline, send=lambda: None, every=0.2):
    """Sends again and again until it is answered. False after the deadline, or when the node has ended."""
    due = 0.0
    while node.lives():
        if answered():
            return True
        if time.monotonic() > deadline:
            return False
        if time.monotonic() > due:
            send()
            due = time.monotonic() + every
        time.sleep(0.02)
    return False


def moving(twist):
    return twist.linear.x > 0.0


def succeeds(node, action, goal, deadline, done):
    """Sends the goal once, which has to be enough, and waits for `done(goal id)`."""
    node.send(action + "/goal", goal)
    return until(node, lambda: done(goal.goal_id.id), deadline)


def status_of(node, action, identity):
    for result in node.heard(action + "/result"):
        if result.status.goal_id.id == identity:
            return result.status.status
    return None


def plans(node, deadline):
    """By service and by action."""
    request = get_service_class("nav_msgs/GetPlan")._request_class()
    request.start, request.goal = initial_pose(node), pose_stamped(node)
    request.start = pose_stamped(node)
    request.start.pose.position.x = 0.5

    def answered():
        node.send("projected_map", grid(node))
        answer = node.call("~make_plan", request)
        return answer is not None and len(answer.plan.poses) > 1
    return until(node, answered, deadline) and succeeds(
        node, "plan_path", plan_goal(node), deadline,
        lambda identity: status_of(node, "plan_path", identity) == SUCCEEDED)


def drives(node, deadline):
    """A path of the topic, then a goal of the action, which is cancelled at last. A path has time to be driven, on a
    machine that is busy too, before what it is offered with cancels it."""
    def offer():
        node.send("manual_control", of("std_msgs/Bool", data=False))
        node.send("stop", of("std_msgs/Bool", data=False))
        for topic in ("projected_map", "speed_limit"):
            node.send(topic, grid(node))
        # Of the goals until now, by a clock that the node may hear a little later: topics overtake each other, and a cancel
        # of all goals was read after the goal below.
        until_now = node.clock.now() - Duration(0.2)
        node.send("navigate_path/cancel", of("actionlib_msgs/GoalID", stamp={"secs": until_now.secs, "nsecs": until_now.nsecs}))
        node.call("~cancel", get_service_class("std_srvs/Trigger")._request_class())
        node.forget("cmd_vel")
        node.send("path", path(node))

    def is_driven():
        return any(moving(twist) for twist in node.heard("cmd_vel"))
    node.forget("cmd_vel")
    if not until(node, is_driven, deadline, offer, every=2.0):
        return False
    goal = drive_goal(node)
    fed = succeeds(node, "navigate_path", goal, deadline, lambda identity: any(
        feedback.status.goal_id.id == identity and feedback.feedback.state == "driving"
        for feedback in node.heard("navigate_path/feedback")))
    node.send("navigate_path/cancel", of("actionlib_msgs/GoalID", id=goal.goal_id.id))
    return fed and until(node, lambda: status_of(node, "navigate_path", goal.goal_id.id) is not None, deadline)


def goes_to_a_pose(node, deadline):
    """Its planner and its driver are these lines. A hostile cancel may be read after the first goal, and be for it too."""
    goals, due = [], [0.0]

    def answer():
        if time.monotonic() > due[0]:
            due[0] = time.monotonic() + 2.0
            goals.append(go_to_goal(node))
            node.send("move_base/goal", goals[-1])
        for topic, result in (("plan_path", FOUND), ("navigate_path", ARRIVED)):
            for asked in node.heard(topic + "/goal")[-1:]:
                stamp = asked.goal_id.stamp
                node.send(topic + "/result", result(node, {
                    "id": asked.goal_id.id, "stamp": {"secs": stamp.secs, "nsecs": stamp.nsecs}}))

    def succeeded():
        return any(status_of(node, "move_base", goal.goal_id.id) == SUCCEEDED for goal in goals)
    return until(node, succeeded, deadline, answer, every=0.1)


def flies(node, deadline):
    """A goal of the topic makes it command a motion, which it does only where it sees; ~cancel ends it. A status is told when
    it changes: one that a stranger's goal brought about, and that stays with the next goal, is not told again."""
    def see():
        node.send("tf", camera_transforms(node))
        for topic, message in zip(("camera_info", "points"), sky(node)):
            node.send(topic, message)

    def offer():
        node.send("manual_control", of("std_msgs/Bool", data=False))
        node.send("stop", of("std_msgs/Bool", data=False))
        see()
        node.send("goal", pose_stamped(node))

    def cancel():
        node.call("~cancel", get_service_class("std_srvs/Trigger")._request_class())

    def is_commanded():
        return any(moving(twist) for twist in node.heard("cmd_vel"))

    def told(*statuses):
        return any(message.status in statuses for message in node.heard("avoidance_status"))

    def offer_and_cancel():
        offer()
        cancel()
    cancel()
    node.forget("cmd_vel")
    if not until(node, is_commanded, deadline, offer):
        return False
    node.forget("avoidance_status")
    return until(node, lambda: told("CANCELLED"), deadline, offer_and_cancel, every=0.5)


def maps(node, deadline):
    """Who takes the updates gets the first map whole, and then what changes."""
    topics = ("projected_map", "projected_map_updates")
    node.call("~reset", get_service_class("std_srvs/Empty")._request_class())
    for topic in topics:
        node.forget(topic)

    def mapped():
        return any(max(message.data, default=0) == 100 for topic in topics for message in node.heard(topic))
    return until(node, mapped, deadline, lambda: node.send("cloud_in", cloud(node)))


def merges_maps(node, deadline):
    """What the laser sees is in the map. It sees farther each time, so that there is something to publish."""
    topics = ("projected_map", "projected_map_updates")
    for topic in topics:
        node.forget(topic)
    steps = iter(range(10**9))

    def feed():
        for topic in ("static_map", "live_map", "keep_out_mask", "speed_mask"):
            node.send(topic, grid(node))
        node.send("tf", node.transforms(node.clock.now()))  # who feeds it ends with a node that is killed
        node.send("scan", scan(node, 2.0 + next(steps) % 4))

    def merged():
        return any(max(message.data, default=0) == 100 for topic in topics for message in node.heard(topic))
    return until(node, merged, deadline, feed)


def serves_a_map(node, deadline):
    request = get_service_class("nav_msgs/GetMap")._request_class()

    def answered():
        answer = node.call("static_map", request)
        return answer is not None and answer.map.info.width > 0
    return until(node, answered, deadline)


def moves(node, deadline):
    """It stops before walls: the map is free first. It has its own time to catch up with when time jumped."""
    node.send("projected_map", grid(node))
    node.forget("ground_truth")

    def moved():
        truth = node.heard("ground_truth")
        return bool(truth) and any(abs(odometry.twist.twist.linear.x) > 0.05 for odometry in truth)
    there = of("geometry_msgs/Twist", linear={"x": 0.5})
    return until(node, moved, deadline, lambda: node.send("cmd_vel", there), every=0.1)


def takes_over(node, deadline):
    node.send("stop", of("std_msgs/Bool", data=False))
    node.forget("cmd_vel")
    return until(node, lambda: any(moving(twist) for twist in node.heard("cmd_vel")), deadline,
                 lambda: node.send("joy", joystick(node)), every=0.1)


def estimates(node, deadline):
    """An IMU and a pose that is set give a pose in the map."""
    request = get_service_class("grid_path_planner/SetPose")._request_class()
    node.forget("odometry/filtered")
    place = [random.uniform(1.0, 9.0), 0.5]

    def feed():
        node.send("imu/data", imu(node))
        request.pose = initial_pose(node)
        request.pose.pose.pose.position.x, request.pose.pose.pose.position.y = place
        node.call("~set_pose", request)

    def is_there():
        """And not where anything else would have put it."""
        return any(math.hypot(odometry.pose.pose.position.x - place[0], odometry.pose.pose.position.y - place[1]) < 0.1
                   for odometry in node.heard("odometry/filtered"))
    return until(node, is_there, deadline, feed, every=0.05)


def sees_markers(node, deadline):
    """An image of the panel gives the pose of the vehicle before it."""
    node.forget("marker_pose")

    def feed():
        node.send("camera/camera_info", camera_info(node))
        node.send("camera/image_raw", picture(node))
    return until(node, lambda: any(abs(fix.pose.pose.position.z - 0.375) < 0.01 for fix in node.heard("marker_pose")),
                 deadline, feed, every=0.1)
