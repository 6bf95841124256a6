#!/usr/bin/env python3
"""Programs written for move_base drive our vehicle unchanged: a client of actionlib, `rostopic pub`, a patrol."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "security"))
import actionlib
import rospy
import rostest
from actionlib_msgs.msg import GoalID
from dynamic_reconfigure.msg import Config, StrParameter
from dynamic_reconfigure.srv import Reconfigure
from move_base_msgs.msg import MoveBaseAction, MoveBaseActionResult, MoveBaseGoal
from std_msgs.msg import Empty

from go_to_session import DEADLINE, PACKAGE, GoToTest, executable, pose
from message_classes import message_class

ATTEMPTS = 5


def set_recovery_steps(steps):
    answer = rospy.ServiceProxy("go_to_pose/set_parameters", Reconfigure)(
        Config(strs=[StrParameter("recovery_steps", steps)]))
    assert [each.value for each in answer.config.strs if each.name == "recovery_steps"] == [steps], answer


class GoToPose(GoToTest):
    def test_a_client_of_actionlib_is_driven_to_its_goal(self):
        """Where the machine keeps the session waiting to the end of a drive, nothing was heard of it: another one."""
        for _ in range(ATTEMPTS):
            if self.is_told_to_the_end():
                return
        self.fail("feedback and status end before the drive does: " + self.logs())

    def is_told_to_the_end(self):
        self.forget()
        feedback, result = [], []
        self.send(pose(8, 1.5, 1.0), feedback_cb=feedback.append, done_cb=lambda state, _: result.append(state))
        text = self.ends("SUCCEEDED")
        self.assertTrue(text.startswith("ARRIVED"), text)
        self.wait_for(lambda: self.is_at(8, 1.5))
        self.wait_for(lambda: result == [actionlib.GoalStatus.SUCCEEDED])
        xs = [message.base_position.pose.position.x for message in feedback]
        self.assertTrue(xs and feedback[-1].base_position.header.frame_id == "map", xs)
        times = [status.time_remaining_s for status in self.heard() if status.state == "DRIVING"]
        known = [time for time in times if time < 1e3]
        self.assertTrue(known, times)
        arrivals = [status.arrival.to_sec() for status in self.heard() if status.time_remaining_s < 1e3]
        self.assertLess(abs(arrivals[0] - rospy.get_time()), 60.0, "foretold in time of the simulation")
        self.drive_to(2, 1.5)
        return max(xs) > 6.0 and known[-1] < 0.5 * known[0]

    def test_a_goal_of_rviz_or_rostopic_is_driven_to_and_its_result_told(self):
        results = []
        subscriber = rospy.Subscriber("move_base/result", MoveBaseActionResult, results.append)
        subprocess.check_output(["rostopic", "pub", "-1", "/move_base_simple/goal", "geometry_msgs/PoseStamped",
                                 "{header: {frame_id: map}, pose: {position: {x: 3.5, y: 1.5}, orientation: {w: 1}}}"])
        self.wait_for(lambda: results)
        self.assertEqual(3, results[0].status.status, results)
        self.wait_for(lambda: self.is_at(3.5, 1.5))
        subscriber.unregister()

    def test_a_patrol_as_scripts_of_move_base_do_it(self):
        client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        client.wait_for_server()
        for x, y, yaw in ((2, 4, 1.57), (4, 4.5, 0), (2, 1.5, -1.57)):
            goal = MoveBaseGoal()
            goal.target_pose.header.frame_id = "map"
            goal.target_pose.header.stamp = rospy.Time.now()
            goal.target_pose.pose = pose(x, y, yaw).pose
            client.send_goal(goal)
            self.assertTrue(client.wait_for_result(rospy.Duration(DEADLINE * 8)), self.logs())
            self.assertEqual(actionlib.GoalStatus.SUCCEEDED, client.get_state(), self.logs())
            self.wait_for(lambda: self.is_at(x, y))

    def test_a_cancel_stops_the_vehicle_before_it_is_answered(self):
        self.send(pose(8, 1.5))
        self.wait_for(self.moves)
        self.client.cancel_goal()
        self.assertEqual("the goal was cancelled", self.ends("PREEMPTED"))
        self.wait_for(self.stands)
        there = self.at()
        rospy.sleep(4.0)
        self.assertTrue(self.is_at(*there, within=0.01), (there, self.at()))

    def test_another_goal_replaces_the_first(self):
        first = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        first.wait_for_server()
        first.send_goal(MoveBaseGoal(target_pose=pose(8, 1.5)))
        self.wait_for(self.moves)
        self.drive_to(2, 4)
        self.assertEqual(actionlib.GoalStatus.PREEMPTED, first.get_state())

    def test_what_cannot_be_used_is_rejected_and_the_drive_goes_on(self):
        """NaN, and a quaternion of zeros, which clients forget most often."""
        self.send(pose(2, 4))
        self.wait_for(lambda: any(status.state == "DRIVING" for status in self.heard()))
        nan, zeros = pose(float("nan"), 1.5), pose(8, 1.5)
        zeros.pose.orientation.w = 0.0
        for bad in (nan, zeros):
            other = actionlib.SimpleActionClient("move_base", MoveBaseAction)
            other.wait_for_server()
            other.send_goal(MoveBaseGoal(target_pose=bad))
            self.assertTrue(other.wait_for_result(rospy.Duration(DEADLINE * 8)), self.logs())
            self.assertEqual(actionlib.GoalStatus.REJECTED, other.get_state())
            self.assertTrue(other.get_goal_status_text().startswith("INVALID_REQUEST"), other.get_goal_status_text())
        self.ends("SUCCEEDED")
        self.wait_for(lambda: self.is_at(2, 4))

    def test_a_goal_without_a_frame_is_in_the_map(self):
        self.send(pose(2, 3, frame=""))
        self.ends("SUCCEEDED")
        self.wait_for(lambda: self.is_at(2, 3))

    def test_a_goal_in_the_vehicles_frame_is_where_it_was_when_it_came(self):
        self.drive_to(2, 1.5, 1.5708)
        self.send(pose(1.5, 0, frame="base_link"))  # ahead, that is to the north
        self.ends("SUCCEEDED")
        self.wait_for(lambda: self.is_at(2, 3, within=0.3))

    def test_a_goal_in_a_frame_that_tf_does_not_know_is_aborted_with_the_reason(self):
        self.send(pose(1, 1, frame="the_moon"))
        text = self.ends("ABORTED")
        self.assertTrue(text.startswith("TRANSFORM_ERROR") and "the_moon" in text, text)

    def test_a_goal_in_a_frame_that_has_ceased_is_aborted_with_the_age(self):
        """What was seen: the dock had not been seen for 40 s, and the vehicle set off to where it had been."""
        transforms = message_class("tf2_msgs/TFMessage")
        dock = message_class("geometry_msgs/TransformStamped")()
        dock.header.frame_id, dock.header.stamp, dock.child_frame_id = "map", rospy.Time.now(), "dock"
        dock.transform.translation.x, dock.transform.rotation.w = 1.0, 1.0
        broadcaster = rospy.Publisher("/tf", transforms, queue_size=1)
        self.wait_for(lambda: broadcaster.get_num_connections() >= 3)
        broadcaster.publish([dock])
        self.wait_for(lambda: rospy.Time.now() - dock.header.stamp > rospy.Duration(5))
        self.send(pose(1, 1, frame="dock"))
        text = self.ends("ABORTED")
        self.assertTrue(text.startswith("TRANSFORM_ERROR: the transform from dock to map is"), text)

    def test_a_cancel_stamped_in_2106_cancels_no_later_goal(self):
        publisher = rospy.Publisher("move_base/cancel", GoalID, queue_size=1)
        self.wait_for(lambda: publisher.get_num_connections() > 0)
        publisher.publish(GoalID(stamp=rospy.Time((1 << 32) - 1, 0)))
        rospy.sleep(1.0)
        self.drive_to(3, 3)

    def test_a_goal_out_of_reach_is_aborted_with_the_planners_sentence_and_recovery_is_told(self):
        self.publish_room(door=False)
        self.send(pose(8, 1.5))
        text = self.ends("ABORTED")
        self.assertTrue(text.startswith("UNREACHABLE: "), text)
        steps = [status.step for status in self.heard()]
        self.assertTrue("wait" in steps and "turn_and_look" in steps, steps)
        self.assertIn("UNREACHABLE", self.heard()[-1].sentence)

    def test_the_step_clear_scan_asks_for_it_and_plans_on_the_map_without(self):
        """What dust marked in the door is in nobody's way once it is cleared."""
        asked = rospy.Subscriber("clear_scan", Empty, lambda _: self.publish_room(door=True))
        self.addCleanup(asked.unregister)
        self.addCleanup(set_recovery_steps, "wait, back_off, turn_and_look")
        set_recovery_steps("clear_scan")
        self.publish_room(door=False)
        self.wait_for(lambda: asked.get_num_connections() > 0)
        self.send(pose(8, 1.5))
        self.ends("SUCCEEDED")
        self.assertIn("clear_scan", [status.step for status in self.heard()])

    def test_a_cancel_during_recovery_ends_it(self):
        self.publish_room(door=False)
        self.send(pose(8, 1.5))
        self.wait_for(lambda: any(status.step == "turn_and_look" for status in self.heard()))
        self.client.cancel_goal()
        self.ends("PREEMPTED")
        self.wait_for(self.stands)

    def test_a_second_node_that_offers_the_action_refuses_to_start_and_names_the_first(self):
        second = subprocess.run([executable("go_to_pose"), "__name:=second"], stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, universal_newlines=True, timeout=DEADLINE)
        self.assertEqual(1, second.returncode)
        self.assertIn("/go_to_pose", second.stdout)


if __name__ == "__main__":
    rospy.init_node("go_to_pose_clients")
    rostest.rosrun(PACKAGE, "go_to_pose", GoToPose)
