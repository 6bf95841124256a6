"""More is asked of the nodes than they can do: maps of 4000x4000 cells, goals at 1 kHz, service clients, and a
subscriber that never reads.

On path_planner and one of COMMANDERS with a simulated vehicle; the map is free but for a wall and a block that is
elsewhere in each map. navigate_path and teleop_joy have no world; local_planner sees that of SKY, in which it is
alone. Half of the time maps come at 5 Hz, half at 10 Hz. Holds if no node ends, resident memory ends up below MOST_MB,
every question of ~make_plan is answered, 95 % of them within PROMPT seconds and all within LONGEST_ANSWER, once the
load is over within CALM, the answers to a question that the block stands in the way of avoid it where it has moved to,
and cmd_vel is silent no longer than silence.py allows. A drive that ends, where path_planner finds no path, is silent
too: the row says how often that was. The goals lie at two ends in turn, so that no drive is over: who has arrived
commands nothing. The row says how many maps and goals a second path_planner was sent; it is *not run* where there were
fewer than ENOUGH of them, and fails where path_planner took fewer. A question whose connection was closed without an
answer is asked once more, which roscpp's server needs now and then (security_results.md): the row counts these,
MOST_AGAIN of the answers at most.
"""
import os
import subprocess
import sys
import threading
import time

from ros_session import START_SECONDS, SessionFailed, executable, share_file

from .loads import AGAIN, ANSWERED, COUNTED, GOAL_RATE, HEIGHT, LOADS, LONGEST_ANSWER, MAP_RATES, SEEN, plan
from .other_sessions import Flight, Manual, hold
from .session import Demo, Master, NotRun, process_id, resident_mb
from .silence import Silence, quantile

MOST_MB = 2500.0
PROMPT = 0.5          # s that 95 % of the answers take at most
CALM = 1.0            # s, once the load is over
ENOUGH = 0.8          # of the rates of maps and goals, and of the answers past the block
MOST_AGAIN = 1e-3     # of the answers
SKY = """<sdf version="1.6"><world name="sky"><model name="far"><static>true</static><pose>0 -500 0 0 0 0</pose><link name="box">
<collision name="box"><geometry><box><size>1 1 1</size></box></geometry></collision></link></model></world></sdf>"""


class Commander:
    """One that is put under load: its node, what starts it and the simulator, and what it needs to move."""

    def __init__(self, session, arguments, parameters=(), is_held=False, world=None):
        self.node, self.tick, self.is_held, self.world = session.COMMANDER[1:], session.TICK, is_held, world
        self.arguments, self.parameters = arguments, dict(parameters)

    def programs(self, folder):
        """{node: arguments} of all that runs."""
        simulator = ["_initial_x:=1", "_initial_y:=1"]
        if self.world:
            name = os.path.join(folder, "world.sdf")
            with open(name, "w") as file:
                file.write(self.world)
            simulator += ["--world", name, "_initial_z:=%g" % HEIGHT]
        return {"simulator": simulator, "path_planner": ["_unknown_is_passable:=true"], self.node: self.arguments}

    def set_parameters(self):
        import rospy
        import yaml
        for node, config in self.parameters.items():
            with open(share_file("config", config)) as file:
                rospy.set_param(node, yaml.safe_load(file))


COMMANDERS = {
    "demo": Commander(Demo, ["_check_map:=false", "_loop:=true", "_no_progress_timeout:=0"]),
    "manual": Commander(Manual, [], is_held=True),
    "flight": Commander(Flight, ["points:=depth_camera/points", "camera_info:=depth_camera/camera_info", "goal:=local_goal"],
                        {"/simulator": "multirotor.yaml", "/local_planner": "flight_local.yaml"}, world=SKY),
}


class Nodes:
    def __init__(self, folder, given, commander):
        self.folder, self.log = folder, open(os.path.join(folder, "log"), "w")
        extra = {}
        for text in given:
            node, _, parameter = text.partition("/")
            extra.setdefault(node, []).append("_" + parameter.replace("=", ":=", 1))
        self.processes = {name: self.start([executable(name)] + arguments + extra.get(name, []))
                          for name, arguments in commander.programs(folder).items()}
        self.loads = {}  # {kind: process}

    def start(self, command, **more):
        return subprocess.Popen(command, **dict(dict(stdout=self.log, stderr=subprocess.STDOUT), **more))

    def load(self, kind, *rate):
        more = {"stdout": subprocess.PIPE} if kind == ANSWERED else {}
        self.loads[kind] = self.start([sys.executable, "-m", "storms.loads", kind, self.tally(kind), *map(str, rate)], text=True,
                                      cwd=os.path.dirname(os.path.dirname(os.path.abspath(__file__))), **more)

    def tally(self, kind):
        return os.path.join(self.folder, "sent_by_" + kind)

    def sent_by(self, kind):
        """How many messages path_planner has been sent by this load, and how many there were, as far as it has said."""
        with open(self.tally(kind)) as file:
            return tuple(map(int, file.read().split()))

    def end_loads(self):
        for kind, process in self.loads.items():
            process.kill()
            process.wait()
            if os.path.exists(self.tally(kind)):
                os.remove(self.tally(kind))
        self.loads = {}

    def check(self):
        """That all nodes and all loads live: without one of these it is another storm."""
        running = dict(self.processes, **{"the load of " + kind: process for kind, process in self.loads.items()})
        ended = [name for name, process in running.items() if process.poll() is not None]
        if ended:
            raise SessionFailed("these have ended: " + ", ".join(ended))

    def drives_ended(self):
        with open(self.log.name, errors="replace") as log:
            return sum("the path is empty" in line for line in log)

    def resident(self):
        return {name: resident_mb(process.pid) for name, process in self.processes.items()}

    def stop(self):
        self.end_loads()
        for process in self.processes.values():
            process.kill()
        for process in self.processes.values():
            process.wait()
        self.log.close()


def drive_a_line(nodes):
    """A path over free space, which navigate_path drives again and again."""
    import rospy
    from geometry_msgs.msg import PoseStamped
    from nav_msgs.msg import Path
    publisher = rospy.Publisher("path", Path, queue_size=1)
    wait(nodes, lambda: publisher.get_num_connections() > 0, "subscriber of path")
    path = Path()
    path.header.frame_id, path.header.stamp = "map", rospy.Time.now()
    for x in (1.0, 10.0, 1.1):
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z, pose.pose.orientation.w = x, 1.0, HEIGHT, 1.0
        path.poses.append(pose)
    publisher.publish(path)


def wait(nodes, done, what):
    deadline = time.monotonic() + START_SECONDS
    while not done():
        nodes.check()
        if time.monotonic() > deadline:
            raise SessionFailed("no " + what)
        time.sleep(0.1)


class Answers:
    """To the clients' questions, as they print them."""

    def __init__(self, clients):
        self.seconds, self.failures, self.again = [], [], 0
        self.across, self.seen = [], []  # seconds, and where, of questions that the block stands in the way of
        self.rates = {}  # (messages that path_planner was sent, that there were) a second, by the kind of load
        threading.Thread(target=self.read, args=(clients.stdout,), daemon=True).start()

    def read(self, lines):
        for line in lines:
            try:
                self.seconds.append(float(line))
            except ValueError:
                if line.startswith(AGAIN):
                    self.again += 1
                elif line.startswith(SEEN):
                    seconds, place = line[len(SEEN):].split()
                    self.across.append(float(seconds))
                    self.seen.append(place)
                else:
                    self.failures.append(line.strip())


def prompt_plan():
    """As plan(), and no answer is a failure."""
    answers = []
    thread = threading.Thread(target=lambda: answers.append(plan()), daemon=True)
    thread.start()
    thread.join(LONGEST_ANSWER)
    if not answers:
        raise SessionFailed("no answer within %g s" % LONGEST_ANSWER)
    return answers[0]


def suffer(nodes, seconds, silence, map_rate):
    """The answers, and the most megabytes of a node."""
    nodes.load("maps", map_rate)
    wait(nodes, lambda: len(prompt_plan()[1]) > 1, "plan")
    for kind in list(LOADS)[1:]:
        nodes.load(kind)
    answers = Answers(nodes.loads[ANSWERED])
    silence.begin()
    wait(nodes, lambda: all(os.path.exists(nodes.tally(kind)) for kind in COUNTED), "loads")
    begin, most = time.monotonic(), 0.0
    before = {kind: nodes.sent_by(kind) for kind in COUNTED}
    while time.monotonic() < begin + seconds:
        nodes.check()
        most = max(most, *nodes.resident().values())
        time.sleep(0.2)
    passed = time.monotonic() - begin
    answers.rates = {kind: [(now - then) / passed for now, then in zip(nodes.sent_by(kind), numbers)]
                     for kind, numbers in before.items()}
    silence.end()
    nodes.check()
    nodes.end_loads()
    return answers, most


def told(rate, answers):
    text = "maps at %g Hz (%.1f sent, %.0f goals): %d answers, p95 %.2f s, longest %.1f s, %d asked again" % (
        rate, answers.rates["maps"][0], answers.rates["goals"][0], len(answers.seconds), quantile(answers.seconds, 0.95),
        max(answers.seconds), answers.again)
    text += ", past the block %d, p95 %.2f s, it had moved in %.0f %%" % (
        len(answers.across), quantile(answers.across, 0.95), 100.0 * moved(answers.seen))
    if answers.failures:
        text += ", %d failed, the first: %s" % (len(answers.failures), answers.failures[0])
    return text


def moved(places):
    """In which share of the answers the block is elsewhere than in the one before."""
    return sum(now not in (then, "nowhere") for then, now in zip(places, places[1:])) / max(1, len(places) - 1)


def verdict(answers, most, calm, silent, held=True):
    """`answers`: by the rate of the maps. `silent`: of cmd_vel, in words, and whether its laws held."""
    if not all(each.seconds and each.across for each in answers.values()):
        raise SessionFailed("no answer under load")
    text = "; ".join(told(rate, each) for rate, each in answers.items())
    text += "; after it %.2f s; at most %.0f MB; %s" % (calm, most, silent)
    late = any(quantile(each.seconds, 0.95) > PROMPT or max(each.seconds) > LONGEST_ANSWER for each in answers.values())
    late = late or any(max(each.across) > LONGEST_ANSWER for each in answers.values())
    stale = any(moved(each.seen) < ENOUGH for each in answers.values())
    again = any(each.again > max(1.0, MOST_AGAIN * len(each.seconds)) for each in answers.values())
    if not held or late or stale or again or any(each.failures for each in answers.values()) or calm > CALM or most > MOST_MB:
        raise SessionFailed(text)
    for rate, each in answers.items():
        for kind, asked in (("maps", rate), ("goals", GOAL_RATE)):
            sent, made = each.rates[kind]
            if made < ENOUGH * asked:
                raise NotRun("the machine was too busy for so much: " + text)
            if sent < ENOUGH * asked:
                raise SessionFailed("path_planner took %.1f %s of %.1f a second: %s" % (sent, kind, made, text))
    return text


def judged(silence, nodes):
    """In words, and whether it held."""
    ended = ", %d drives ended meanwhile" % nodes.drives_ended()
    try:
        return silence.verdict() + ended, True
    except SessionFailed as reason:
        return "failed: %s%s" % (reason, ended), False


def storm(minutes, folder, given, name):
    import rospy
    commander = COMMANDERS[name]
    with Master():
        rospy.init_node("storm", anonymous=True, disable_signals=True)
        rospy.set_param("/use_sim_time", False)
        commander.set_parameters()
        rospy.set_param("/simulator/publish_clock", False)
        nodes = Nodes(folder, given, commander)
        try:
            wait(nodes, lambda: all(process_id("/" + node) for node in nodes.processes), "nodes")
            if commander.is_held:
                threading.Thread(target=hold, args=(Manual.AXES, Manual.BUTTONS), daemon=True).start()
            else:
                drive_a_line(nodes)
            with Silence(commander.tick, stops=True) as silence:
                answers, most = {}, 0.0
                for rate in MAP_RATES:
                    answers[rate], megabytes = suffer(nodes, 60.0 * minutes / len(MAP_RATES), silence, rate)
                    most = max(most, megabytes)
                time.sleep(2.0)
                calm, _ = prompt_plan()
                return verdict(answers, most, calm, *judged(silence, nodes))
        finally:
            nodes.stop()
