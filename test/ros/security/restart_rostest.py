#!/usr/bin/env python3
"""What a node begins with that was killed and started again, as the table of doc/nodes.md says. That of projected_map
is tested in test/ros/mapping/projected_map_restart_rostest.cpp."""
import os
import signal
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rospkg
import rospy
import rostest
from roslib.message import get_service_class

import node_probes as probes
from node_table import NODES
from own_master import start_own_master
from running_nodes import PACKAGE, Clock, RunningNode

DEADLINE = 60.0  # s
QUIET = 1.5      # s, in which nothing is to come


class Restart(unittest.TestCase):
    def start(self, name):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.environ["GRID_PATH_PLANNER_LOAD_FOLDER"] = os.path.join(rospkg.RosPack().get_path(PACKAGE), "test", "data")
        self.node = RunningNode(name, NODES[name], "process", Clock(False), folder.name)
        self.addCleanup(self.node.end, signal.SIGKILL)
        self.comes_up()

    def comes_up(self):
        self.until(lambda: all(publisher.get_num_connections() > 0 for publisher in self.node.publishers.values()))

    def until(self, done):
        self.assertTrue(probes.until(self.node, done, time.monotonic() + DEADLINE))

    def kill(self):
        self.node.restart()
        self.until(self.is_there)

    def forget(self, *topics):
        """What came before the kill and was handled after it."""
        for topic in topics:
            self.node.forget(topic)

    def is_there(self):
        """Its publishers and subscribers are those of the new process: all that it hears was connected anew."""
        import rosgraph
        import xmlrpc.client
        try:
            uri = rosgraph.Master("/restart").lookupNode(self.node.full_name())
            return xmlrpc.client.ServerProxy(uri).getPid("/restart")[2] == self.node.processes[0].pid
        except (rosgraph.MasterError, OSError):
            return False

    def holds(self):
        """It does what it is for."""
        self.assertTrue(self.node.row.probe(self.node, time.monotonic() + DEADLINE))

    def test_path_planner_forgets_its_goal_and_gets_a_map(self):
        self.start("path_planner")
        self.holds()
        self.node.forget("path")
        self.until_answered(lambda: self.node.send("goal", probes.pose_stamped(self.node)), "path")
        self.kill()
        self.comes_up()
        request = get_service_class("nav_msgs/GetPlan")._request_class()
        request.start, request.goal = probes.pose_stamped(self.node), probes.pose_stamped(self.node)
        request.start.pose.position.x = 0.5

        def plans():
            answer = self.node.call("~make_plan", request)
            return answer is not None and len(answer.plan.poses) > 1
        self.until(plans)  # on the map that is latched
        self.node.forget("path")
        time.sleep(QUIET)
        self.assertEqual([], self.node.heard("path"), "the goal from before was planned for")
        self.holds()

    def until_answered(self, send, topic):
        self.assertTrue(probes.until(self.node, lambda: self.node.heard(topic), time.monotonic() + DEADLINE, send))

    def test_navigate_path_drives_nothing_from_before(self):
        self.start("navigate_path")
        self.holds()
        self.node.send("path", probes.path(self.node))  # latched
        goal = probes.drive_goal(self.node)
        self.node.send("navigate_path/goal", goal)
        self.until(lambda: self.node.heard("navigate_path/feedback"))
        self.kill()
        self.comes_up()
        self.forget("cmd_vel", "navigate_path/feedback")
        time.sleep(QUIET)
        self.assertEqual([], [twist for twist in self.node.heard("cmd_vel") if probes.moving(twist)])
        self.assertEqual([], self.node.heard("navigate_path/feedback"), "the goal from before")
        self.holds()

    def test_go_to_pose_forgets_its_goal(self):
        self.start("go_to_pose")
        self.holds()
        self.node.forget("plan_path/goal")
        self.node.send("move_base/goal", probes.go_to_goal(self.node))
        self.until(lambda: self.node.heard("plan_path/goal"))
        self.kill()
        self.comes_up()
        time.sleep(QUIET)
        self.assertEqual([], self.node.heard("plan_path/goal"), "the goal from before")
        self.holds()

    def test_map_publisher_has_its_file(self):
        self.start("map_publisher")
        request = get_service_class("nav_msgs/GetMap")._request_class()
        self.holds()
        before = self.node.call("static_map", request).map
        self.kill()
        self.holds()
        after = self.node.call("static_map", request).map
        self.assertEqual((before.info.width, before.data), (after.info.width, after.data))

    def test_map_layers_merges_what_its_sources_say_again(self):
        self.start("map_layers")
        self.holds()
        self.kill()
        self.comes_up()
        self.holds()

    def test_simulator_is_where_it_began(self):
        self.start("simulator")
        self.holds()
        self.until(lambda: self.position() > 0.2 or self.node.send("cmd_vel", probes.of(
            "geometry_msgs/Twist", linear={"x": 0.5})))
        self.kill()
        self.forget("ground_truth")
        self.until(lambda: self.node.heard("ground_truth") and self.node.heard("contacts"))
        self.assertEqual(self.position(0), 0.0)
        self.assertEqual(self.node.heard("contacts")[0].data, 0)
        self.holds()

    def position(self, which=-1):
        return self.node.heard("ground_truth")[which].pose.pose.position.x

    def test_teleop_joy_commands_when_the_joystick_does(self):
        self.start("teleop_joy")
        self.holds()
        self.kill()
        self.comes_up()
        self.forget("cmd_vel")
        time.sleep(QUIET)
        self.assertEqual([], [twist for twist in self.node.heard("cmd_vel") if probes.moving(twist)])
        self.holds()

    def test_vehicle_localizer_knows_no_pose_until_it_is_set_again(self):
        self.start("vehicle_localizer")
        self.holds()
        self.kill()
        self.comes_up()
        self.node.forget("odometry/filtered")
        self.node.send("imu/data", probes.imu(self.node))
        time.sleep(QUIET)
        self.assertEqual([], self.node.heard("odometry/filtered"))
        self.holds()

    def test_marker_localizer_has_its_layout_and_its_panel_again(self):
        self.start("marker_localizer")
        self.holds()
        self.kill()
        self.comes_up()
        self.holds()

    def test_local_planner_forgets_its_goal_and_flies_nothing_from_before(self):
        self.start("local_planner")
        self.holds()
        self.node.send("path", probes.path(self.node))  # latched
        self.until(lambda: self.node.heard("cmd_vel"))
        self.kill()
        self.comes_up()
        self.node.forget("cmd_vel")
        time.sleep(QUIET)
        self.assertEqual([], self.node.heard("cmd_vel"), "without a route nobody commands")
        self.assertEqual("IDLE", self.node.heard("avoidance_status")[-1].status)
        self.holds()

    def test_every_node_is_tested(self):
        tested = " ".join(name for name in dir(self) if name.startswith("test_"))
        self.assertEqual([], [name for name in NODES if name != "projected_map" and "test_" + name not in tested])


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("restart")
    rostest.rosrun(PACKAGE, "restart", Restart)
