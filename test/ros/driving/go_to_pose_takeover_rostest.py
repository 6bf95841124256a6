#!/usr/bin/env python3
"""Whoever takes, pauses or stops a vehicle for which go_to_pose plans does not see it set off.

What was seen before: between two drives, while it planned, waited or located a goal, go_to_pose heard neither of a joystick
nor of the driver's ~pause and ~cancel, and sent the next drive; its own cancels ended a pause; and a goal of
move_base_simple/goal was begun after it had been cancelled.
"""
import contextlib
import os
import signal
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rospy
import rostest
from actionlib_msgs.msg import GoalID
from geometry_msgs.msg import PoseStamped
from std_msgs.msg import Bool
from std_srvs.srv import Trigger

from go_to_session import PACKAGE, GoToTest, HeldPlanner, pose, until


class GoToPoseTakeover(GoToTest):
    def ask(self, service):
        name = "/navigate_path/" + service
        rospy.wait_for_service(name, 60.0)
        answer = rospy.ServiceProxy(name, Trigger)()
        self.assertTrue(answer.success, (service, answer.message))

    def tap(self):
        """A joystick takes over and lets go at once."""
        manual = rospy.Publisher("manual_control", Bool, queue_size=10)
        self.wait_for(lambda: manual.get_num_connections() >= 2)  # the driver, and whoever plans for it
        for commands in (True, False):
            manual.publish(commands)
        return manual

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.kill("path_planner")
        cls.planner = HeldPlanner()
        cls.planner.__enter__()
        cls.addClassCleanup(cls.planner.__exit__)
        cls.planner.answers.set()
        ends = cls.planner.server.action_server
        topics = ends.goal_sub, ends.cancel_sub, ends.status_pub, ends.result_pub, ends.feedback_pub
        assert until(lambda: all(topic.get_num_connections() > 0 for topic in topics)), cls.logs()

    @contextlib.contextmanager
    def planning(self):
        """From (2, 1.5) to (4, 1.5); the plan comes when it is told to, or at the end."""
        self.drive_to(2, 1.5)
        self.planner.answers.clear()
        self.planner.asked.clear()
        try:
            self.send(pose(4, 1.5))
            self.wait_for(self.planner.asked.is_set)
            self.forget()
            yield self.planner
        finally:
            self.planner.answers.set()

    def stays(self):
        there = self.at()
        rospy.sleep(4.0)
        self.assertTrue(self.is_at(*there, within=0.05), (there, self.at(), self.logs()))

    def test_a_joystick_that_taps_while_it_plans_ends_the_goal(self):
        with self.planning() as planner:
            self.tap()
            self.assertIn("the joystick commands", self.ends("ABORTED"))
            planner.answers.set()
            self.stays()

    def test_a_cancel_at_the_driver_while_it_plans_ends_the_goal(self):
        with self.planning() as planner:
            self.ask("cancel")
            self.assertIn("~cancel", self.ends("ABORTED"))
            planner.answers.set()
            self.stays()

    def test_a_pause_at_the_driver_while_it_plans_holds_for_the_plan(self):
        with self.planning() as planner:
            self.ask("pause")
            planner.answers.set()
            self.wait_for(lambda: any(status.state == "DRIVING" for status in self.heard()))
            self.stays()
            self.ask("resume")
            self.ends("SUCCEEDED")

    def test_a_pause_outlives_the_goal_that_is_cancelled_or_replaced(self):
        self.drive_to(2, 1.5)
        self.send(pose(2, 4.5))
        self.wait_for(self.moves)
        self.ask("pause")
        self.wait_for(self.stands)
        self.client.cancel_goal()
        self.ends("PREEMPTED")
        for target in (pose(3, 4.5), pose(3.5, 4.5)):
            self.forget()
            self.send(target)
            self.wait_for(lambda: any(status.state == "DRIVING" for status in self.heard()))
            self.stays()
        self.ask("resume")
        self.ends("SUCCEEDED")
        self.wait_for(lambda: self.is_at(3.5, 4.5))

    def test_a_simple_goal_is_ended_by_the_cancel_that_comes_after_it(self):
        self.drive_to(2, 1.5)
        goals = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1)
        cancels = rospy.Publisher("move_base/cancel", GoalID, queue_size=1)
        self.wait_for(lambda: goals.get_num_connections() > 0 and cancels.get_num_connections() > 0)
        for _ in range(5):
            self.forget()
            self.processes["go_to_pose"].send_signal(signal.SIGSTOP)
            goals.publish(pose(4, 1.5))
            rospy.sleep(0.5)  # it lies at the node before the cancel does
            cancels.publish(GoalID())
            rospy.sleep(0.5)
            self.processes["go_to_pose"].send_signal(signal.SIGCONT)
            self.wait_for(lambda: any(status.state == "PLANNING" for status in self.heard()))
            self.wait_for(lambda: self.heard()[-1].state == "IDLE")
            self.stays()


if __name__ == "__main__":
    rospy.init_node("go_to_pose_takeover")
    rostest.rosrun(PACKAGE, "go_to_pose_takeover", GoToPoseTakeover)
