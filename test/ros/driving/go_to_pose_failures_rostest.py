#!/usr/bin/env python3
"""What go_to_pose does when a door closes ahead, and when a node dies: the vehicle stops rather than guesses."""
import os
import signal
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rosnode
import rospy
import rostest

from go_to_session import PACKAGE, GoToTest, HeldPlanner, pose


class GoToPoseFailures(GoToTest):
    def test_a_door_that_closes_stops_it_and_one_that_opens_lets_it_go_on(self):
        self.drive_to(2, 1.5)
        self.send(pose(8, 1.5))
        self.wait_for(lambda: self.moves() and self.at()[0] > 2.5)
        self.publish_room(door=False)
        self.wait_for(lambda: any(status.step == "wait" for status in self.heard()))
        self.assertLess(self.at()[0], 5.0)
        self.publish_room(door=True)
        self.ends("SUCCEEDED")
        self.wait_for(lambda: self.is_at(8, 1.5))
        self.drive_to(2, 1.5)

    def test_a_driver_that_dies_is_given_a_path_again_when_it_is_back(self):
        self.drive_to(2, 1.5)
        self.send(pose(8, 1.5))
        self.wait_for(self.moves)
        self.kill("navigate_path")
        self.wait_for(self.stands)
        self.wait_for(lambda: any(status.state == "RECOVERING" for status in self.heard()))
        self.start("navigate_path")
        self.ends("SUCCEEDED")
        self.wait_for(lambda: self.is_at(8, 1.5))

    def test_without_a_planner_a_goal_is_aborted_in_time_and_says_so(self):
        self.kill("path_planner")
        self.send(pose(2, 1.5))
        text = self.ends("ABORTED")
        self.assertIn("plan_path", text)
        self.start_planner()
        self.drive_to(2, 1.5)

    def test_a_planner_that_dies_during_a_drive_is_not_missed(self):
        self.drive_to(2, 1.5)
        self.send(pose(2, 4.5))
        self.wait_for(self.moves)
        self.kill("path_planner")
        self.ends("SUCCEEDED")
        self.start_planner()

    def test_started_again_it_stops_what_was_driven_for_it(self):
        self.drive_to(2, 1.5)
        self.send(pose(8, 1.5))
        self.wait_for(self.moves)
        self.kill("go_to_pose")
        with self.time_standing_still():  # or it has arrived before a busy machine has started the node
            self.start("go_to_pose")
            self.wait_for(lambda: self.serves("go_to_pose", "move_base"))
        self.wait_for(self.stands)
        self.assertFalse(self.is_at(8, 1.5, within=1.0), self.at())
        self.connect()
        there = self.at()
        rospy.sleep(4.0)
        self.assertTrue(self.is_at(*there, within=0.05), (there, self.at()))
        self.drive_to(2, 1.5)

    def test_an_orderly_end_stops_the_vehicle(self):
        self.drive_to(2, 1.5)
        self.send(pose(8, 1.5))
        self.wait_for(self.moves)
        self.processes["go_to_pose"].terminate()
        self.processes["go_to_pose"].wait(20)
        self.ends("ABORTED")
        self.wait_for(self.stands)
        self.start("go_to_pose")
        self.connect()

    def test_a_manager_that_is_ended_stops_the_vehicle(self):
        """roscpp closes the connections at SIGINT and `rosnode kill` before a nodelet hears of it, and SIGTERM ends a manager
        at once."""
        ends = [lambda manager: manager.send_signal(signal.SIGINT), lambda manager: manager.send_signal(signal.SIGTERM),
                lambda _: rosnode.kill_nodes(["/go_to_pose"])]
        for end in ends:
            self.kill("go_to_pose")
            self.start("go_to_pose", as_nodelet=True)
            self.connect()
            self.drive_to(2, 1.5)
            self.send(pose(8, 1.5))
            self.wait_for(self.moves)
            end(self.processes["go_to_pose"])
            self.processes["go_to_pose"].wait(20)
            self.ends("ABORTED")
            self.wait_for(self.stands)
            self.assertFalse(self.is_at(8, 1.5, within=1.0), self.at())
        self.start("go_to_pose")
        self.connect()

    def test_a_manager_that_is_signalled_while_it_plans_begins_no_drive(self):
        """The plan came while the node gave up its goal, and was driven: nobody was left to stop it."""
        self.drive_to(2, 1.5)
        self.kill("path_planner")
        try:
            for seconds in (0.07, 0.08, 0.09, 0.1):  # giving up takes a tenth of a second
                self.plan_after_a_signal(seconds)
        finally:
            self.start_planner()
            self.start("go_to_pose")
            self.connect()

    def plan_after_a_signal(self, seconds):
        self.kill("go_to_pose")
        with HeldPlanner() as planner:
            self.start("go_to_pose", as_nodelet=True)
            self.connect()
            self.send(pose(2, 4.5))
            self.wait_for(planner.asked.is_set)
            self.processes["go_to_pose"].send_signal(signal.SIGINT)
            time.sleep(seconds)
            planner.answers.set()
            self.assertEqual(self.processes["go_to_pose"].wait(20), 0)
            rospy.sleep(4.0)
            self.assertTrue(self.is_at(2, 1.5), self.at())


if __name__ == "__main__":
    rospy.init_node("go_to_pose_failures")
    rostest.rosrun(PACKAGE, "go_to_pose_failures", GoToPoseFailures)
