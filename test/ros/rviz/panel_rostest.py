#!/usr/bin/env python3
"""A real rviz on a screen without a monitor is used as people use it: points are set with the tools, Plan is clicked,
the goal is dragged; the planner is stopped and killed meanwhile. What came of it is asked of ROS, and the view is not
blank. The last picture is build/panel_rostest.png."""
import importlib.machinery
import importlib.util
import os
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rospy
import rostest
import yaml
from nav_msgs.msg import OccupancyGrid
from visualization_msgs.msg import InteractiveMarkerFeedback, MarkerArray

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import killed_node
from grid_path_planner.msg import PlanPathActionResult, PlanStatistics
from screen import Screen

PACKAGE = "grid_path_planner"
SOURCES = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
SANITIZER = os.environ.get("GPP_NODELET_PREFIX", "").split()   # rviz is not built here: it loads it first, like nodelet managers
SECONDS = 240.0 if SANITIZER else 60.0  # which only a failure reaches
BACKGROUND = 90, 96, 104      # of the view, in rviz/planning.rviz
FIRST_BUTTON = 11, 95, 165    # Plan, where it may be pressed: src/ros/rviz/panel_widgets.cpp
SIDE = 200                    # cells of 0.05 m


def wait_for(condition, what):
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError("waited %g s in vain for %s" % (SECONDS, what))


def wall_between_free_halves():
    """The wall leaves a way round its upper end."""
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    grid.info.resolution = 0.05
    grid.info.width = grid.info.height = SIDE
    grid.info.origin.orientation.w = 1.0
    grid.data = [100 if abs(x - SIDE // 2) < 4 and y < SIDE * 3 // 4 else 0 for y in range(SIDE) for x in range(SIDE)]
    return grid


class Heard:
    """The messages of a topic so far."""

    def __init__(self, topic, kind):
        self.all = []
        rospy.Subscriber(topic, kind, self.all.append)


def program(name):
    """Of the build that is tested: rosrun asks which, where there is one with a sanitizer too."""
    return os.path.join(os.environ["CMAKE_PREFIX_PATH"].split(":")[0], "lib", PACKAGE, name)


def rviz_environment(screen):
    """What rviz, Ogre and Qt leave behind at the end is theirs."""
    return dict(screen.environment, ASAN_OPTIONS=os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0")


class PanelTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.statistics = Heard("plan_statistics", PlanStatistics)
        cls.answers = Heard("plan_path/result", PlanPathActionResult)
        cls.drawn = Heard("plan_panel/markers", MarkerArray)
        cls.planning_maps = Heard("planning_map", OccupancyGrid)
        cls.dragged = Heard("plan_panel/points/feedback", InteractiveMarkerFeedback)
        cls.map = rospy.Publisher("projected_map", OccupancyGrid, queue_size=1, latch=True)
        cls.map.publish(wall_between_free_halves())
        cls.processes = []
        cls.screen = Screen(1440, 960)
        cls.addClassCleanup(cls.end)
        cls.start_planner()
        cls.rviz = subprocess.Popen(SANITIZER + [program("rviz_on_map"), "--wait", "20"], env=rviz_environment(cls.screen))
        cls.processes.append(cls.rviz)
        cls.view = wait_for(cls.find_view, "the view")

    @classmethod
    def end(cls):
        folder = os.path.dirname(os.environ.get("ROS_HOME", "/tmp/x"))
        cls.screen.look().write_png(os.path.join(folder, "panel_rostest.png"))
        for process in cls.processes:
            process.send_signal(signal.SIGCONT)
            process.terminate()
            process.wait()
        cls.screen.close()

    @classmethod
    def start_planner(cls):
        cls.planner = subprocess.Popen([program("path_planner"), "__name:=path_planner"])
        cls.processes.append(cls.planner)

    @classmethod
    def find_view(cls):
        box = cls.screen.look().box_of(BACKGROUND, least_width=8)
        return box if box and box.right - box.left > 300 else None

    def button(self):
        return self.screen.look().box_of(FIRST_BUTTON, least_width=20)

    def answer_to(self, act, what):
        """What path_planner says after this."""
        seen = len(self.statistics.all)
        act()
        wait_for(lambda: len(self.statistics.all) > seen, what)
        return self.statistics.all[-1]

    def set_point(self, shortcut, pixel):
        self.screen.do("mousemove", *self.view.middle(), "sleep", 0.1, "key", shortcut, "sleep", 0.2)
        self.screen.drag(pixel, (pixel[0] + 40, pixel[1]))

    def test_1_points_are_set_and_plan_is_clicked(self):
        self.set_point("b", self.view.at(0.3, 0.7))
        self.set_point("a", self.view.at(0.7, 0.7))
        button = wait_for(self.button, "a button Plan that may be pressed")
        self.assertEqual(self.statistics.all, [], "nothing is planned unasked")
        answer = self.answer_to(lambda: self.screen.click(button.middle()), "a plan")
        self.assertEqual((answer.status, answer.goal.header.frame_id), ("FOUND", "map"))
        self.assertGreater(answer.length_m, 1.2 * 0.4 * SIDE * 0.05, "the way round the wall")
        wait_for(lambda: any(marker.ns == "path" for marker in self.drawn.all[-1].markers), "the path in the view")

    def test_2_the_plan_follows_a_goal_that_is_dragged(self):
        before = self.statistics.all[-1].goal.pose.position
        self.screen.do("mousemove", *self.view.middle(), "sleep", 0.1, "key", "i", "sleep", 0.2)
        answer = self.answer_to(lambda: self.screen.drag(self.view.at(0.7, 0.7), self.view.at(0.7, 0.5)), "a plan")
        wait_for(lambda: self.statistics.all[-1].goal.pose.position.y > before.y + 0.5, "a plan to the new place")
        self.assertEqual(answer.status, "FOUND")

    def wait_for_plan(self, condition, act, what):
        """The first answer of plan_path after `act` that is as it should be."""
        seen = len(self.answers.all)
        act()
        return wait_for(lambda: next((answer.result for answer in self.answers.all[seen:] if condition(answer.result)),
                                     None), what)

    def passes(self, result, pixel):
        """Whether the path comes within 0.3 m of that place of the view."""
        x, y = self.position_of(pixel)
        return any(abs(pose.pose.position.x - x) < 0.3 and abs(pose.pose.position.y - y) < 0.3 for pose in result.path.poses)

    def position_of(self, pixel):
        """In the map: the view from above is not turned, and where start and goal of the first plan were set is known."""
        first, last = self.answers.all[0].result.path.poses[0], self.answers.all[0].result.path.poses[-1]
        (left, y), (right, _) = self.view.at(0.3, 0.7), self.view.at(0.7, 0.7)
        metres = (last.pose.position.x - first.pose.position.x) / (right - left)
        return (first.pose.position.x + metres * (pixel[0] - left), first.pose.position.y - metres * (pixel[1] - y))

    def test_2b_via_points_are_passed_as_they_are_set_or_in_the_best_order(self):
        """The second one lies before the first. A via-point is dragged by its middle, where the path passes it."""
        far, near = self.view.at(0.45, 0.3), self.view.at(0.33, 0.5)  # both on the near side of the wall
        self.wait_for_plan(lambda result: self.passes(result, far), lambda: self.set_point("v", far), "a plan through it")
        given = self.wait_for_plan(lambda result: len(result.order) == 2, lambda: self.set_point("v", near), "both")
        self.assertEqual(("FOUND", (0, 1)), (given.status, tuple(given.order)))
        self.assertTrue(self.passes(given, far) and self.passes(given, near))
        plan = self.button()
        best = self.wait_for_plan(lambda result: tuple(result.order) == (1, 0),
                                  lambda: self.screen.click((plan.left + 8, plan.top - 16)), "the best order")
        self.assertTrue(best.order_exact)
        self.assertLess(best.statistics.length_m, given.statistics.length_m)
        self.screen.do("mousemove", *self.view.middle(), "sleep", 0.1, "key", "i", "sleep", 0.2)
        moved = self.view.at(0.33, 0.35)
        self.wait_for_plan(lambda result: self.passes(result, moved), lambda: self.screen.drag(near, moved),
                           "the plan through the via-point that was dragged")

    def click_compare(self):
        """Which stands right of Plan."""
        plan = self.button()
        self.screen.click((plan.right + 30, plan.middle()[1]))

    def test_3_planners_are_compared(self):
        def compared():
            self.click_compare()  # again, where the plan for the dragged goal was still being made
            time.sleep(1.0)
            return [marker.ns for marker in self.drawn.all[-1].markers].count("compared") >= 3
        wait_for(compared, "paths in several colours")

    def test_4_rviz_goes_on_while_the_planner_is_stopped(self):
        self.planner.send_signal(signal.SIGSTOP)
        self.click_compare()
        seen = len(self.dragged.all)
        self.screen.drag(self.view.at(0.7, 0.5), self.view.at(0.75, 0.6))
        wait_for(lambda: len(self.dragged.all) > seen, "handles that move")
        answer = self.answer_to(lambda: self.planner.send_signal(signal.SIGCONT), "the plan afterwards")
        self.assertEqual(answer.status, "FOUND")

    def test_5_a_planner_that_is_killed_comes_back(self):
        self.planner.kill()
        self.planner.wait()
        wait_for(lambda: not self.button(), "a button Plan that may not be pressed")
        killed_node.forget("/path_planner")
        maps = len(self.planning_maps.all)
        self.start_planner()
        button = wait_for(self.button, "a button Plan that may be pressed again")
        wait_for(lambda: len(self.planning_maps.all) > maps, "the map in the new one")
        answer = self.answer_to(lambda: self.screen.click(button.middle()), "a plan of the new one")
        self.assertEqual(answer.status, "FOUND")
        self.assertIsNone(self.rviz.poll(), "rviz runs")

    def test_6_the_view_is_not_blank(self):
        self.assertGreater(self.screen.look().colours(self.view), 20)

    def test_7_one_of_several_vehicles_is_shown(self):
        loader = importlib.machinery.SourceFileLoader("rviz_on_map", os.path.join(SOURCES, "scripts", "rviz_on_map"))
        module = importlib.util.module_from_spec(importlib.util.spec_from_loader("rviz_on_map", loader))
        loader.exec_module(module)
        with open(os.path.join(SOURCES, "rviz", "planning.rviz")) as file:
            config = yaml.safe_load(file)
        module.show_vehicle(config, "a")
        manager = config["Visualization Manager"]
        topics = {one["Name"]: one.get("Topic", one.get("Marker Topic")) for one in manager["Displays"]}
        self.assertEqual((topics["Path"], topics["Plan"], topics["Map"]), ("/a/path", "/a/search_markers", "/projected_map"))
        self.assertIn("/a/move_base_simple/goal", [tool.get("Topic") for tool in manager["Tools"]])
        self.assertEqual([panel["Namespace"] for panel in config["Panels"] if "Namespace" in panel], ["/a"])
        self.assertEqual([one["Reference Frame"] for one in manager["Displays"] if one["Name"] == "Vehicle frame"],
                         ["a/base_link"])


if __name__ == "__main__":
    rospy.init_node("panel_rostest")
    rostest.rosrun(PACKAGE, "panel_rostest", PanelTest)
