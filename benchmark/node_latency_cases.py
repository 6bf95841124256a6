"""The cases of node_latency: each a small function (node, generator, effort, result) whose title is its docstring."""
import time

import node_latency_maps as maps
from node_latency_ros import Missed, Service, as_bytes, wait_until


class Result:
    def __init__(self):
        self.times, self.remark = [], ""


class Effort:
    """How much is measured for a row: few rounds where `quick`, at most `most_rounds` (0: no limit), and no new one after
    `seconds`."""

    def __init__(self, quick, most_rounds, seconds):
        self.quick, self.most_rounds, self.seconds = quick, most_rounds, seconds

    def rounds(self, full=20, quick=5):
        count = quick if self.quick else full
        begin = time.monotonic()
        for i in range(min(count, self.most_rounds or count)):
            if i > 0 and time.monotonic() - begin > self.seconds:
                return
            yield i


CASES = []
PLANNERS = ("weighted_jump_point", "a_star", "dijkstra", "incremental_a_star", "lazy_theta_star", "theta_star")


def case(needs_goals=False, grows=False):
    """`needs_goals`: only of nodes that answer goals and plan again by themselves. `grows`: the map changes its size."""
    def add(function):
        function.title, function.needs_goals, function.grows = function.__doc__.split(". ")[0], needs_goals, grows
        CASES.append(function)
        return function
    return add


def first_time(measured, result):
    """What the first plan's time is for: the case about it counts it, the others do not."""
    return result.times.append if measured is first_plan else lambda time_s: None


def a_cell_of_the_path(node, generator, low=0.3, high=0.7):
    """A free cell that the path crosses, far from its ends."""
    for _ in range(100):
        at = int(node.path.count * generator.uniform(low, high))
        cell = node.world.cell_entered(*node.path[at])
        if cell and node.world.at(*cell) == maps.FREE:
            return cell
    raise Missed("the path has no free cell between %.1f and %.1f of it" % (low, high))


@case(grows=True)
def first_plan(node, generator, effort, result):
    """first plan on a new map. Four more on other maps of the same kind."""
    plain = node.world
    for _ in effort.rounds(4, 1):
        plain = plain.grown(8)
        node.world = maps.scattered(plain, 0.0005, generator, [plain.cell(*end) for end in node.ends])
        node.first_plan(result.times.append)


@case()
def make_plan(node, generator, effort, result):
    """`~make_plan` on one connection. Of our node also what it takes above the engine's planning time."""
    places = [node.world.centre(column, row) for column, row in free_places(node, generator, 40)]
    first = len(node.statistics.received) if node.has_goals else 0
    found, goals = 0, []
    for _ in effort.rounds(200, 40):
        start, goal = generator.sample(places, 2)
        goals.append(goal)
        request = node.request(start, goal)
        begin = time.monotonic()
        path = node.plan(request)
        result.times.append(time.monotonic() - begin)
        found += bool(path and path.count > 1)
    result.remark = "%d found" % found
    if node.has_goals:
        time.sleep(0.5)  # for the last statistics
        told = zip(result.times, node.planning_times(first, goals))
        above = sorted(total - planning for total, planning in told if planning is not None)
        if not above:
            raise Missed("no plan statistics came")
        result.remark += "; above `planning_time` (%d told): median %.2f ms, p95 %.2f, max %.2f" % ((len(above),) + tuple(
            1e3 * above[int(share * (len(above) - 1))] for share in (0.5, 0.95, 1.0)))


@case(needs_goals=True)
def many_plans(node, generator, effort, result):
    """`~make_plan` three thousand times. Until searches have paid for landmarks, and with them: `planning_time` by the hundred."""
    places = [node.world.centre(column, row) for column, row in free_places(node, generator, 40)]
    first, goals = len(node.statistics.received), []
    for _ in effort.rounds(3000, 40):
        start, goal = generator.sample(places, 2)
        goals.append(goal)
        begin = time.monotonic()
        node.plan(node.request(start, goal))
        result.times.append(time.monotonic() - begin)
    time.sleep(0.5)  # for the last statistics
    told = [planning for planning in node.planning_times(first, goals) if planning is not None]
    if not told:
        raise Missed("no plan statistics came")
    hundreds = [told[i:i + 100] for i in range(0, len(told), 100)]
    result.remark = "mean of each hundred, ms: " + " ".join("%.2f" % (1e3 * sum(times) / len(times)) for times in hundreds)


def free_places(node, generator, count):
    places = []
    while len(places) < count:
        column, row = generator.randrange(10, node.world.width - 10), generator.randrange(10, node.world.height - 10)
        if not any(node.world.at(column + c, row + r) for c in range(-9, 10, 3) for r in range(-9, 10, 3)):
            places.append((column, row))
    return places


@case()
def one_cell(node, generator, effort, result):
    """one cell changed. It is on the path; until a path avoids it."""
    for _ in effort.rounds():
        cell = a_cell_of_the_path(node, generator)
        result.times.append(node.path_around([cell], lambda: node.update([cell])))


@case()
def one_cell_after_a_rest(node, generator, effort, result):
    """one cell changed, half a second after the one before. What a node does while it is idle is done then, and in its
    processor time."""
    for _ in effort.rounds():
        time.sleep(0.5)
        cell = a_cell_of_the_path(node, generator)
        result.times.append(node.path_around([cell], lambda: node.update([cell])))


@case()
def two_cells(node, generator, effort, result):
    """two cells at opposite corners. Both are on the path, an update each; until a path avoids both."""
    for _ in effort.rounds():
        cells = [a_cell_of_the_path(node, generator, 0.05, 0.15), a_cell_of_the_path(node, generator, 0.85, 0.95)]
        result.times.append(node.path_around(cells, lambda: node.update(cells)))


def publish_blocked(node, generator, share, result):
    cell = a_cell_of_the_path(node, generator)
    ends = [node.world.cell(*end) for end in node.ends]
    node.world = maps.scattered(node.world, share, generator, ends)
    node.world.set(*cell, maps.OCCUPIED)
    result.times.append(node.path_around([cell], lambda: node.publish_map(node.world)))


@case()
def republished_one(node, generator, effort, result):
    """whole map again, one cell changed. What receiving and comparing a map takes is in it."""
    for _ in effort.rounds():
        publish_blocked(node, generator, 0.0, result)


@case()
def republished_scattered(node, generator, effort, result):
    """whole map again, 0.1 % scattered changes. As SLAM and octomap_server publish."""
    before = node.world.copy()
    for _ in effort.rounds():
        node.world = before.copy()
        publish_blocked(node, generator, 0.001, result)


@case(grows=True)
def grown(node, generator, effort, result):
    """map that grows and shifts its origin. By eight cells on each of two sides."""
    for _ in effort.rounds(10):
        cell = a_cell_of_the_path(node, generator)
        node.world = node.world.grown(8)
        cell = (cell[0] + 8, cell[1] + 8)
        node.world.set(*cell, maps.OCCUPIED)
        result.times.append(node.path_around([cell], lambda: node.publish_map(node.world)))


@case(needs_goals=True)
def options_changed(node, generator, effort, result):
    """options changed live, then `~make_plan`. `decay`, so that every weight changes."""
    from dynamic_reconfigure.msg import Config, DoubleParameter
    from dynamic_reconfigure.srv import Reconfigure
    reconfigure = Service(node.namespace + "/set_parameters", Reconfigure)
    for i in effort.rounds():
        config = Config(doubles=[DoubleParameter("decay", 3.0 + 0.1 * (i % 2))])
        request, plan = as_bytes(Reconfigure._request_class(config)), node.request(*node.ends)
        begin = time.monotonic()
        reconfigure.call(request)
        path = node.plan(plan)
        result.times.append(time.monotonic() - begin)
        if not path or path.count == 0:
            raise Missed("no plan after an option changed")


@case(needs_goals=True)
def another_planner(node, generator, effort, result):
    """`~make_plan` after another planner was asked. That was `a_star`, by `~compare_plans`."""
    from grid_path_planner.srv import ComparePlans
    compare = Service(node.namespace + "/compare_plans", ComparePlans)
    start, goal = node.pose(node.ends[0]), node.pose(node.ends[1])
    request = as_bytes(ComparePlans._request_class(start=start, goal=goal, planners=["a_star"], heuristics=[]))
    for _ in effort.rounds():
        compare.call(request)
        plan = node.request(*node.ends)
        begin = time.monotonic()
        node.plan(plan)
        result.times.append(time.monotonic() - begin)


@case(needs_goals=True)
def cancelled(node, generator, effort, result):
    """a goal of `plan_path` cancelled. By planners in turn, at any time within what each takes; from the cancel to the
    result."""
    import rospy
    from actionlib_msgs.msg import GoalID, GoalStatus
    from grid_path_planner.msg import PlanPathActionGoal, PlanPathActionResult
    goals = rospy.Publisher("plan_path/goal", PlanPathActionGoal, queue_size=None, tcp_nodelay=True)
    cancels = rospy.Publisher("plan_path/cancel", GoalID, queue_size=None, tcp_nodelay=True)
    results = node.topic("plan_path/result")
    wait_until(lambda: goals.get_num_connections() > 0 and cancels.get_num_connections() > 0, "plan_path")

    def ask(planner, cancel_after):
        """The status, and when it came after the goal or its cancel."""
        seen, message = len(results.received), PlanPathActionGoal()
        message.header.stamp = message.goal_id.stamp = rospy.Time.now()
        message.goal_id.id = "%s %d" % (planner, seen)
        message.goal.start, message.goal.goal = node.pose(node.ends[0]), node.pose(node.ends[1])
        message.goal.planner = planner
        begin = time.monotonic()
        goals.publish(message)
        if cancel_after is not None:
            time.sleep(cancel_after)
            begin = time.monotonic()
            cancels.publish(GoalID(id=message.goal_id.id))
        ended, data = results.next(seen, "result of plan_path")
        return PlanPathActionResult().deserialize(data).status.status, ended - begin
    whole = {planner: ask(planner, None)[1] for planner in PLANNERS}
    found_first = 0
    for i in effort.rounds(10 * len(PLANNERS), len(PLANNERS)):
        planner = PLANNERS[i % len(PLANNERS)]
        status, seconds = ask(planner, generator.uniform(0.0, whole[planner]))
        result.times.append(max(0.0, seconds))
        found_first += status != GoalStatus.PREEMPTED
    result.remark = "%d were found first" % found_first


@case(needs_goals=True)
def many_goals(node, generator, effort, result):
    """goals at 100 Hz. Of those that are answered; a newer goal cancels the one before."""
    places = [node.world.centre(column, row) for column, row in free_places(node, generator, 60)]
    sent, first = {}, len(node.paths.received)
    count = 100 if effort.quick else 500
    for i in range(count):
        begin = time.monotonic()
        place = places[i % len(places)]
        position = (place[0] + 1e-6 * i, place[1])  # so that each can be told from its path
        sent[position] = begin
        node.goals.publish(node.pose(position))
        time.sleep(max(0.0, 0.01 - (time.monotonic() - begin)))
    last = position

    def answered():
        paths = [(at, maps_end(data)) for at, data in node.paths.received[first:]]
        return {position: at for at, position in paths if position in sent}
    wait_until(lambda: last in answered(), "path to the last goal")
    result.times = [at - sent[position] for position, at in answered().items()]
    result.remark = "%d of %d answered" % (len(result.times), count)


def maps_end(data):
    from node_latency_ros import Positions
    path = Positions(data)
    return path[path.count - 1] if path.count else None


def ask_while_maps_come(node, generator, effort, result, goal):
    """Four clients, each with a connection of its own."""
    from threading import Thread
    ends = [node.world.cell(*end) for end in node.ends]
    versions = [node.map_message(maps.scattered(node.world, 0.001, generator, ends)) for _ in range(3)]
    stop_at = time.monotonic() + (3.0 if effort.quick else 15.0)

    missed = []

    def ask():
        try:
            service = Service(node.service_name, node.GetPlan)
            while time.monotonic() < stop_at:
                request = node.request(node.ends[0], goal)
                begin = time.monotonic()
                service.call(request)
                result.times.append(time.monotonic() - begin)
                time.sleep(0.02)
        except Missed as error:
            missed.append(error)
    clients = [Thread(target=ask) for _ in range(4)]
    for client in clients:
        client.start()
    sent = 0
    while time.monotonic() < stop_at:
        begin = node.send(versions[sent % 3])
        sent += 1
        time.sleep(max(0.0, 0.2 - (time.monotonic() - begin)))
    for client in clients:
        client.join()
    if missed:
        raise missed[0]
    result.remark = "%d maps sent" % sent


@case()
def many_maps(node, generator, effort, result):
    """`~make_plan` of four clients while whole maps come at 5 Hz, across the map. Each map with 0.1 % of its cells changed."""
    ask_while_maps_come(node, generator, effort, result, node.ends[1])


@case()
def many_maps_near(node, generator, effort, result):
    """the same over 20 m. What a plan itself takes is little then."""
    middle = [node.world.cell(*end)[0] for end in node.ends]
    reach = min(middle[1] - middle[0], 283)  # of 0.05 m, in both directions
    at = next(i for i in range(middle[0] + reach, middle[0], -1)
              if not any(node.world.at(i + c, i + r) for c in range(-10, 11) for r in range(-10, 11)))
    ask_while_maps_come(node, generator, effort, result, node.world.centre(at, at))
