"""kill -9 of the demo's nodes during drives; roslaunch starts each again after a second.

In every round the nodes are killed one after the other, in any order; the simulator, which takes the vehicle back to
where it began and time to its start, in every fifth. Holds if no more cells are free in the first map after a kill of
projected_map that were occupied in the seconds before it than the sensor clears, no plan crosses such a cell, the vehicle stands
within cmd_vel_timeout of navigate_path's end, every node comes back, the vehicle drives on after every round and
touches nothing.
"""
import os
import random
import signal
import time

from ros_session import SessionFailed

from .seen_map import SeenMap
from .session import BACK_SECONDS, Demo, patience, process_id

FIRST_CELLS = 300       # occupied ones before the first kill
ERASED = 10             # cells, and twice of what one map frees without a kill; an empty map erases hundreds
SIMULATOR_EVERY = 5     # rounds
CMD_VEL_TIMEOUT = 0.5   # s; of the simulator
BRAKING = 1.2           # s: from 0.8 m/s, and what a message takes


class Kills:
    def __init__(self, demo, seed=1, nodes=None):
        self.demo, self.nodes, self.vehicle, self.drive = demo, demo.nodes, demo.vehicle, demo.drive
        self.map = SeenMap()
        self.random = random.Random(seed)
        self.counts = dict.fromkeys(nodes or demo.NODES, 0)
        self.crossed = 0
        self.asked_without = 0  # plans while there was no mapping
        self.longest_stop = 0.0

    def kill(self, node):
        """Kills it and returns what was occupied before."""
        self.nodes.wait_until(lambda: process_id(node), patience(BACK_SECONDS), node)
        self.vehicle.check_untouched()
        squares = self.map.occupied_before()
        pid = process_id(node)
        os.kill(pid, signal.SIGKILL)
        if node == "/projected_map":
            self.map.expect(squares)
            self.ask_without_a_mapping(squares)
        self.counts[node] += 1
        if node == "/navigate_path":
            self.wait_until_it_stands()
        return squares, node, pid

    def ask_without_a_mapping(self, squares):
        """A plan before the first map of the mapping that comes back, where the planner is there to make one."""
        planner, deadline = process_id("/path_planner"), time.monotonic() + patience(BACK_SECONDS)
        path = self.drive.ask_once(lambda: self.map.expected is None or planner is None or time.monotonic() > deadline)
        if path is not None:
            self.asked_without += 1
            self.crossed += self.map.crossed(path, squares)

    def wait_until_it_stands(self):
        """In simulated time, which stands still where the machine does."""
        begin = self.vehicle.now()
        while self.vehicle.speed() > 0.02:
            taken = self.vehicle.now() - begin
            self.longest_stop = max(self.longest_stop, taken)
            if taken > CMD_VEL_TIMEOUT + BRAKING:
                raise SessionFailed("%.2f s after navigate_path's end the vehicle moves at %.2f" % (
                    taken, self.vehicle.speed()))
            time.sleep(0.01)

    def round(self, number):
        order = [node for node in self.counts if node != "/simulator"]
        self.random.shuffle(order)
        if "/simulator" in self.counts and number % SIMULATOR_EVERY == SIMULATOR_EVERY - 1:
            order.insert(0, "/simulator")
        killed = []
        for node in order:
            time.sleep(self.random.uniform(0.0, 0.7))
            killed.append(self.kill(node))
        for _, node, pid in killed:
            self.nodes.wait_until(lambda: process_id(node) not in (None, pid), patience(BACK_SECONDS), node)
        self.nodes.wait_until(lambda: self.map.expected is None, patience(BACK_SECONDS), "map")
        # What all the kills agree upon: the map goes on changing between them.
        squares = frozenset.intersection(*(squares for squares, _, _ in killed))
        self.crossed += self.map.crossed(self.drive.ask(), squares)
        self.drive.goes_on()

    def run(self, rounds):
        self.drive.ask()
        self.nodes.wait_until(lambda: len(self.map.occupied_before()) > FIRST_CELLS, patience(BACK_SECONDS), "obstacles")
        for number in range(rounds):
            self.round(number)
            print("storm: round %d of %d, %d kills, %d cells erased, %d points in walls, %.0f m" % (
                number + 1, rounds, sum(self.counts.values()), self.map.erased, self.crossed, self.vehicle.driven_m),
                flush=True)
        if self.crossed or self.map.most_erased > ERASED + 2 * self.map.most_freed:
            raise SessionFailed("%d cells were erased, plans have %d points in walls" % (
                self.map.erased, self.crossed))
        return "%s; %d plans found, %d of them without a mapping, none through what was occupied, nothing touched; at most %d cells " \
            "free after a kill, %d without one; stood at most %.2f s after the driver's end" % (
                ", ".join("%d of %s" % (count, node) for node, count in self.counts.items()), self.drive.found,
                self.asked_without, self.map.most_erased, self.map.most_freed, self.longest_stop)


def storm(rounds, folder, given):
    with Demo(folder, given, survey=True) as demo:
        return Kills(demo).run(int(rounds))
