"""kill -9 of every node of nodelet_plugins.xml during drives; roslaunch starts each again after a second.

KILLED says in which of SESSIONS a node is killed and what holds then. In every second round those of a session are
killed one after the other, in any order; in the others first those without which the vehicle goes on by itself, then, when
they are back, those that forget the drive. Holds if what KILLED says holds, every node comes back, no more cells are free in the first
map of a map's node than the sensor clears that were occupied in the seconds before its end, no plan crosses such a cell, the vehicle
drives on after every round and touches nothing.
"""
import collections
import os
import random
import signal
import time
import xml.etree.ElementTree

from ros_session import SessionFailed, share_file

from .other_sessions import Flight, Localization, Manual, Site
from .seen_map import SeenMap
from .session import BACK_SECONDS, Demo, process_id

SIMULATOR_EVERY = 5     # rounds, where others are killed, too: it takes the vehicle back to where it began
CMD_VEL_TIMEOUT = 0.5   # s; of the simulator
TF_TIMEOUT = 0.5        # s; of navigate_path
STANDS = 0.02           # m/s and rad/s


class Kills:
    def __init__(self, session, nodes, seed=1):
        self.session, self.nodes, self.vehicle, self.drive = session, session.nodes, session.vehicle, session.drive
        self.map = SeenMap()
        self.random = random.Random(seed)
        self.counts = dict.fromkeys(nodes, 0)
        self.moving = dict(self.counts)  # of these while the vehicle moved
        self.crossed = 0
        self.asked_without = 0  # plans while there was no mapping
        self.longest_stop = 0.0
        self.unasked = 0        # times it went on by itself

    def kill(self, node):
        """Kills it and returns what was occupied before."""
        self.nodes.wait_until(lambda: process_id(node), BACK_SECONDS, node)
        self.vehicle.check_untouched()
        squares = self.map.occupied_before()
        pid = process_id(node)
        os.kill(pid, signal.SIGKILL)
        self.counts[node] += 1
        self.moving[node] += self.vehicle.speed() > STANDS
        if node == self.session.MAP_NODE:
            self.map.expect(squares)
            self.ask_without_a_map(squares)
        KILLED[node].at_once(self)
        return squares, node, pid

    def ask_without_a_map(self, squares):
        """A plan before the first map of the node that comes back, where the planner is there to make one."""
        planner, deadline = process_id("/path_planner"), time.monotonic() + BACK_SECONDS
        path = self.drive.ask_once(lambda: self.map.expected is None or planner is None or time.monotonic() > deadline)
        if path is not None:
            self.asked_without += 1
            self.crossed += self.map.crossed(path, squares)

    def stands_within(self, seconds):
        """And its braking, in simulated time, which stands still where the machine does."""
        begin = self.vehicle.now()
        while self.vehicle.speed() > STANDS:
            taken = self.vehicle.now() - begin
            self.longest_stop = max(self.longest_stop, taken)
            if taken > seconds + self.session.BRAKING:
                raise SessionFailed("%.2f s after the end of what it moves by the vehicle moves at %.2f" % (
                    taken, self.vehicle.speed()))
            time.sleep(0.01)

    def stands_without_commands(self):
        self.stands_within(CMD_VEL_TIMEOUT)

    def stands_without_a_pose(self):
        self.stands_within(TF_TIMEOUT)

    def is_told_to_stand(self):
        """By a go_to_pose that is back: it cancels what it had begun."""
        self.nodes.wait_until(lambda: self.vehicle.speed() < STANDS, BACK_SECONDS, "stop of the drive of before")

    def stands_where_it_began(self):
        """What was driven before time went back is not driven any more. Not where others are killed, too: a goal has come meanwhile."""
        if len(self.counts) > 1:
            return
        self.vehicle.stamp, began = None, self.drive.ends[0]
        self.nodes.wait_until(lambda: self.vehicle.now() > 3.0, BACK_SECONDS, "/clock")
        if self.vehicle.distance(began) > 0.1:
            raise SessionFailed("%.2f m from where it began without a new goal" % self.vehicle.distance(began))

    def forget_fixes(self):
        self.session.fixes = 0

    def sees_the_panel(self):
        """Sent before it until a pose comes by its markers."""
        self.drive.end = 0
        self.drive.publish_goal()
        self.nodes.wait_until(lambda: self.session.fixes > 0, BACK_SECONDS, "pose by markers")

    def knows_where_it_is(self):
        self.nodes.wait_until(lambda: self.session.estimate.status.startswith("OK"), BACK_SECONDS,
                              "localization_status OK")
        self.session.estimate.check()

    def nothing(self):
        """More than what holds after all kills."""

    def groups(self, number):
        """Of nodes that are killed together, in their order."""
        order = [node for node in self.counts if node != "/simulator" or len(self.counts) == 1]
        self.random.shuffle(order)
        if "/simulator" in self.counts and number % SIMULATOR_EVERY == SIMULATOR_EVERY - 1 and len(self.counts) > 1:
            order.insert(0, "/simulator")
        if number % 2 == 0:
            return [order]
        return [group for group in ([node for node in order if not KILLED[node].forgets],
                                    [node for node in order if KILLED[node].forgets]) if group]

    def kill_together(self, order):
        killed = []
        for node in order:
            time.sleep(self.random.uniform(0.0, 0.7))
            killed.append(self.kill(node))
        for _, node, pid in killed:
            self.nodes.wait_until(lambda: process_id(node) not in (None, pid), BACK_SECONDS, node)
        self.nodes.wait_until(lambda: self.map.expected is None, BACK_SECONDS, "map")
        for node in order:
            KILLED[node].back(self)
        if not any(KILLED[node].forgets for node in order):
            self.unasked += self.drive.goes_on_unasked()
        # What all the kills agree upon: the map goes on changing between them.
        squares = frozenset.intersection(*(squares for squares, _, _ in killed))
        self.crossed += self.map.crossed(self.drive.ask(), squares)
        for node in order:
            KILLED[node].at_last(self)
        self.drive.goes_on()

    def run(self, rounds):
        self.drive.goes_on()
        self.nodes.wait_until(lambda: len(self.map.occupied_before()) > self.session.FIRST_CELLS, BACK_SECONDS,
                              "obstacles")
        for number in range(rounds):
            for group in self.groups(number):
                self.kill_together(group)
            print("storm: round %d of %d, %d kills, %d cells erased, %d points in walls, %.0f m" % (
                number + 1, rounds, sum(self.counts.values()), self.map.erased, self.crossed, self.vehicle.driven_m),
                flush=True)
        if self.crossed or self.map.most_erased > self.session.ERASED + 2 * self.map.most_freed:
            raise SessionFailed("%d cells were erased, plans have %d points in walls" % (
                self.map.erased, self.crossed))
        return "%s; %d plans found, %d of them without a mapping, none through what was occupied, nothing touched; at most %d cells " \
            "free after a kill, %d without one; stood at most %.2f s after the end of what it moves by; went on by itself %d times" % (
                ", ".join("%d of %s (%d while it moved)" % (count, node, self.moving[node])
                          for node, count in self.counts.items()), self.drive.found,
                self.asked_without, self.map.most_erased, self.map.most_freed, self.longest_stop, self.unasked)


#   sessions   of SESSIONS
#   forgets    the drive, which has to be asked for anew; else the vehicle goes on by itself
#   at_once    what holds when it has been killed
#   back       what holds when it is there again, before anything is asked
#   at_last    what holds when the vehicle has been sent on
Killed = collections.namedtuple("Killed", "sessions forgets at_once back at_last", defaults=[Kills.nothing] * 3)

KILLED = {
    "/simulator": Killed(("demo", "simulator"), True, back=Kills.stands_where_it_began),
    "/projected_map": Killed(("demo",), False),
    "/path_planner": Killed(("demo",), False),
    "/navigate_path": Killed(("demo",), True, at_once=Kills.stands_without_commands),
    "/teleop_joy": Killed(("manual",), False, at_once=Kills.stands_without_commands),
    "/map_publisher": Killed(("localization", "site"), False),
    "/map_layers": Killed(("site",), False),
    "/go_to_pose": Killed(("site",), True, back=Kills.is_told_to_stand),
    "/local_planner": Killed(("flight",), True, at_once=Kills.stands_without_commands),
    "/marker_localizer": Killed(("localization",), False, back=Kills.forget_fixes, at_last=Kills.sees_the_panel),
    "/vehicle_localizer": Killed(("localization",), False, at_once=Kills.stands_without_a_pose,
                                 back=Kills.knows_where_it_is),
}


def surveyed(folder, given):
    return Demo(folder, given, survey=True)


SESSIONS = {"demo": surveyed, "simulator": surveyed, "manual": Manual, "flight": Flight, "localization": Localization,
            "site": Site}


def check_that_none_is_missing():
    """Whoever adds a node to nodelet_plugins.xml adds a row to KILLED."""
    classes = xml.etree.ElementTree.parse(share_file("nodelet_plugins.xml")).iter("class")
    names = {"/" + each.get("name").split("/")[1] for each in classes}
    if names != set(KILLED) or any(set(row.sessions) - set(SESSIONS) or not row.sessions for row in KILLED.values()):
        raise SessionFailed("killed are %s, of the nodes %s" % (", ".join(sorted(KILLED)), ", ".join(sorted(names))))


def storm(rounds, folder, given, name):
    check_that_none_is_missing()
    with SESSIONS[name](folder, given) as session:
        return Kills(session, [node for node, row in KILLED.items() if name in row.sessions]).run(int(rounds))
