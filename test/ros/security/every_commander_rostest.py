#!/usr/bin/env python3
"""What a vehicle may rely on of whatever commands it: one suite over the table in commanders.py."""
import os
import signal
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rospkg
import rospy
import rostest

import node_probes as probes
from commanders import COMMANDERS, DEADLINE, TICK, TRAJECTORIES, VELOCITIES, CommanderTest
from late_publisher import LatePublisher
from node_table import NODES
from own_master import start_own_master
from running_nodes import PACKAGE

LATE = 0.7        # s, within what a node waits for a publisher that is known
FAR = (1e160, -1e308, 1e7)  # m


def far_transforms(node, x):
    """Of the vehicle; its camera stays where it is."""
    message = probes.camera_transforms(node)
    message.transforms[0].transform.translation.x = x
    return message


def turned_transforms(node, number):
    message = probes.camera_transforms(node)
    turn = message.transforms[0].transform.rotation
    turn.x = turn.y = turn.z = turn.w = number
    return message


class EveryCommander(CommanderTest):
    def test_the_table_has_every_node_that_commands(self):
        kinds = set(VELOCITIES + TRAJECTORIES)
        self.assertEqual({name for name in NODES if set(NODES[name].outputs.values()) & kinds}, set(COMMANDERS))
        for name in COMMANDERS:
            self.assertIn("stop", NODES[name].inputs, name)

    def test_the_locks_of_every_node_that_commands_are_watched(self):
        """By support/lock_watch.cpp, in a test that runs this very node and no copy of another's."""
        tests = os.path.join(rospkg.RosPack().get_path(PACKAGE), "test", "ros")
        for name, row in COMMANDERS.items():
            with open(os.path.join(tests, row.locks)) as file:
                text = file.read()
            self.assertIn("LD_PRELOAD=\" GPP_LOCK_WATCH", text, name)
            self.assertIn("/" + name + "\"", text, name)

    def test_the_storms_kill_every_node(self):
        sys.path.insert(0, os.path.join(rospkg.RosPack().get_path(PACKAGE), "scripts"))
        from storms.kills import KILLED  # pylint: disable=import-outside-toplevel
        self.assertEqual({"/" + name for name in NODES}, set(KILLED))

    def test_the_storms_try_every_node_that_commands(self):
        sys.path.insert(0, os.path.join(rospkg.RosPack().get_path(PACKAGE), "scripts"))
        from storms import load, other_sessions  # pylint: disable=import-outside-toplevel
        self.assertEqual({"/" + name for name in COMMANDERS},
                         {session.COMMANDER for session in other_sessions.COMMANDED.values()})
        self.assertEqual(set(COMMANDERS), {commander.node for commander in load.COMMANDERS.values()})

    def test_stop_zeroes_until_it_is_released(self):
        for name in COMMANDERS:
            node = self.moving(name)
            node.stop(True)
            self.assertTrue(self.stands(node), name)
            self.assertTrue(self.stays(node, lambda: node.table.offer(node)), name)
            node.stop(False)
            self.assertTrue(self.moves(node), name)

    def test_a_stop_from_before_its_start_holds_it(self):
        for name in COMMANDERS:
            node = self.commander(name, stopped=True)
            offered = {"times": 0}

            def offer():
                offered["times"] += 1
                node.table.offer(node)
            self.assertTrue(probes.until(node, lambda: node.is_connected() and offered["times"] > 5,
                                         time.monotonic() + DEADLINE, offer, 0.3), name)
            self.assertTrue(self.stays(node, offer), name)
            node.stop(False)
            self.assertTrue(self.moves(node), "%s: %s" % (name, self.said(node)))

    def test_a_stop_from_before_its_start_that_comes_late_holds_it(self):
        """Over a slow connection; navigate_path, the first that is asked, drove until it was there.

        Again where the machine made what is late later than a node waits, which the node says: only such a one may drive.
        """
        for name in COMMANDERS:
            end = time.monotonic() + DEADLINE
            while not self.is_held_by_a_late_stop(name):
                self.assertLess(time.monotonic(), end, "%s is told too late each time" % name)

    def is_held_by_a_late_stop(self, name):
        """Whether it was waited for."""
        late = LatePublisher("/%s_as_process/stop" % name, True, LATE)
        try:
            node = self.commander(name, stopped=None)
            offer = lambda: node.table.offer(node)
            self.assertTrue(probes.until(node, lambda: node.is_connected() and late.heard > 0,
                                         time.monotonic() + DEADLINE, offer, 0.1), name)
            self.assertTrue(self.stands(node, offer), name)
            node.end(signal.SIGTERM)
            waited_in_vain = self.times_said(node, "stop is not waited for") > 0
            self.assertTrue(waited_in_vain or not node.moved_after(0.0), "%s drove before it was told to stop" % name)
            return not waited_in_vain
        finally:
            late.close()

    def test_what_ceases_stops_it(self):
        for name, row in COMMANDERS.items():
            node = self.moving(name)
            for feed in row.feeds:
                node.cease(feed)
                self.assertTrue(self.stands(node), "%s without %s" % (name, feed))
                node.ceased.clear()
                self.assertTrue(self.moves(node), "%s with %s again" % (name, feed))

    def test_a_pose_that_cannot_be_stops_it(self):
        """One tf of 1e160 m made 20 of 20 velocities NaN. It is fed on, so that none of its inputs is too old."""
        for name, row in COMMANDERS.items():
            if row.far is None:
                continue
            node = self.moving(name)
            for x in FAR:
                node.forget("avoidance_status")
                told = self.times_said(node, row.far)
                node.cease("tf")
                begin = time.monotonic()
                self.assertTrue(self.stands(node, lambda x=x: node.send("tf", far_transforms(node, x)), TICK), name)
                self.assertTrue(node.stood_from_one_on(begin), "%s: a motion after the first zero" % name)
                self.assertTrue(probes.until(node, lambda: self.times_said(node, row.far) > told, time.monotonic() + DEADLINE),
                                "%s of %g m says %s" % (name, x, self.said(node)))
                node.ceased.clear()
                self.assertTrue(self.moves(node), "%s after %g m: %s" % (name, x, self.said(node)))

    def test_a_turn_that_cannot_be_is_none(self):
        """tf2 drops what is no unit quaternion, and its log says so: it goes on by the others."""
        for name, row in COMMANDERS.items():
            if row.far is None:
                continue
            node = self.moving(name)
            for number in (1e160, 0.0, float("nan")):
                for _ in range(10):
                    node.send("tf", turned_transforms(node, number))
                self.assertTrue(self.moves(node), "%s after %g: %s" % (name, number, self.said(node)))

    def test_a_clock_that_stands_still_stops_it(self):
        for name in [name for name, row in COMMANDERS.items() if row.clock]:
            node = self.moving(name)
            self.clock.stop()
            stood = self.stands(node)
            self.clock.go_on()
            self.assertTrue(stood, name)
            self.assertTrue(self.moves(node), name)



if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander")
    rostest.rosrun(PACKAGE, "every_commander", EveryCommander)
