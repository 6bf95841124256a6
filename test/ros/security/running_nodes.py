"""A node of node_table.py that runs, as a process or as a nodelet, in a namespace and with a tf topic of its own."""
import os
import re
import resource
import signal
import subprocess
import sys
import threading
import time
import xmlrpc.client

import rosgraph
import roslib.packages
import rospy
from genpy import Time
from roslib.message import get_service_class

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import killed_node
import right_messages
from message_classes import message_class

PACKAGE = "grid_path_planner"
LATCHED = ("projected_map", "path")  # as those who publish them do
LONGEST_END = 60.0  # s, which only one that hangs takes
MEMORY_LIMIT = 4 << 30  # bytes of address space: a length that a message claims is refused, not taken


class Clock:
    """The wall's, or one that is published here and begins where a simulation would."""

    def __init__(self, simulated):
        self.simulated = simulated
        self.begin = time.monotonic()
        if simulated:
            from rosgraph_msgs.msg import Clock as Message
            self.publisher, self.message = rospy.Publisher("/clock", Message, queue_size=10), Message
            threading.Thread(target=self.run, daemon=True).start()

    def now(self):
        if not self.simulated:
            return Time.from_sec(time.time())
        return Time.from_sec(100.0 + time.monotonic() - self.begin)

    def say(self, stamp):
        self.publisher.publish(self.message(clock=stamp))

    def run(self):
        while not rospy.is_shutdown():
            try:
                self.say(self.now())
            except rospy.ROSException:
                return  # shut down meanwhile
            time.sleep(0.02)


def executable(name):
    return os.path.join(os.environ["CMAKE_PREFIX_PATH"].split(":")[0], "lib", PACKAGE, name)


def nodelet_program():
    return roslib.packages.find_node("nodelet", "nodelet")[0]


def is_sanitized(program):
    """A sanitizer needs more addresses than any limit allows."""
    with open(program, "rb") as file:
        return re.search(b"__(asan|tsan|msan)_init", file.read()) is not None


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT, MEMORY_LIMIT))


def threads_of(process):
    """Where they stand, if the machine has gdb and lets it look: what hangs once in many runs is not there to be asked."""
    try:
        return subprocess.run(["gdb", "-p", str(process.pid), "-batch", "-ex", "thread apply all backtrace"], timeout=60,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, universal_newlines=True).stdout
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error)


class RunningNode:
    environment = None  # of its processes; none: this one's

    def __init__(self, name, row, kind, clock, log_folder, space=None):
        self.name, self.row, self.kind, self.clock = name, row, kind, clock
        self.space = space or "/%s_as_%s" % (name, kind)
        self.messages, self.publishers, self.processes = {}, {}, []
        self.ended, self.map_frame = False, "map"
        self.log = open(os.path.join(log_folder, self.space[1:] + ".log"), "w")
        self.lock = threading.Lock()
        # Before the node begins: rospy forgets an older list of publishers for a newer one, and where a topic is advertised while
        # it asks for the list, it may take the answer, without that one, for the newer. Nobody tells it again:
        # 2 of 2,000 were lost where both began within 6 ms; in CI a map was never heard, most likely for this.
        for topic, message_type in self.listened():
            rospy.Subscriber(self.resolved(topic), message_class(message_type) or rospy.AnyMsg, self.keep, topic)
        for topic, message_type in self.fed():
            self.publishers[topic] = rospy.Publisher(self.resolved(topic), message_class(message_type),
                                                     queue_size=1000, latch=topic in LATCHED)
        self.start()
        if "listens" in row.tf:
            threading.Thread(target=self.feed_transforms, daemon=True).start()

    def __str__(self):
        return "%s as %s" % (self.name, self.kind)

    def full_name(self):
        return "%s/%s" % (self.space, self.name)

    def resolved(self, topic):
        return "/".join((self.full_name(), topic[1:]) if topic[0] == "~" else (self.space, topic))

    def fed(self):
        """Topics that it is to hear, with their types."""
        topics = dict(self.row.inputs)
        for action, kind in self.row.actions.items():
            topics[action + "/goal"] = kind + "ActionGoal"
            topics[action + "/cancel"] = "actionlib_msgs/GoalID"
        if "listens" in self.row.tf:
            topics["tf"] = topics["tf_static"] = "tf2_msgs/TFMessage"
        return topics.items()

    def listened(self):
        topics = dict(self.row.outputs)
        for action, kind in self.row.actions.items():
            topics[action + "/feedback"], topics[action + "/result"] = kind + "ActionFeedback", kind + "ActionResult"
        return topics.items()

    def start(self):
        remaps = ["__ns:=" + self.space, "__name:=" + self.name, "/tf:=%s/tf" % self.space,
                  "/tf_static:=%s/tf_static" % self.space] + self.row.arguments
        if self.kind == "process":
            self.run([executable(self.name)] + remaps)
            return
        self.start_manager()
        # A bond that says nothing for 4 s, as where the machine stands still for so long, unloads the nodelet.
        self.run([nodelet_program(), "load", "%s/%s" % (PACKAGE, self.name), "manager", "--no-bond"] + remaps)

    def start_manager(self):
        prefix = os.environ.get("GPP_NODELET_PREFIX", "").split()  # the sanitizer's library, in its runs
        self.run(prefix + [nodelet_program(), "manager", "__ns:=" + self.space, "__name:=manager"])

    def run(self, command):
        limited = not is_sanitized(executable(self.name))
        self.processes.append(subprocess.Popen(command, stdout=self.log, stderr=subprocess.STDOUT, env=self.environment,
                                               preexec_fn=limit_memory if limited else None))

    def lives(self):
        return all(process.poll() is None for process in self.processes)

    def keep(self, message, topic):
        with self.lock:
            self.messages.setdefault(topic, []).append(message)
            del self.messages[topic][:-50]

    def heard(self, topic):
        with self.lock:
            return list(self.messages.get(topic, ()))

    def forget(self, topic):
        with self.lock:
            self.messages.pop(topic, None)

    def send(self, topic, message):
        self.publishers[topic].publish(message)

    def call(self, service, request):
        """None where there is no answer."""
        kind = self.row.services[service]
        try:
            return rospy.ServiceProxy(self.resolved(service), get_service_class(kind))(request)
        except (rospy.ServiceException, rospy.ROSException):
            return None

    def transforms(self, stamp):
        message = message_class("tf2_msgs/TFMessage")()
        transform = message_class("geometry_msgs/TransformStamped")()
        transform.header.frame_id, transform.child_frame_id = "map", "base_link"
        transform.header.stamp = stamp
        transform.transform.translation.x = transform.transform.translation.y = 0.5
        transform.transform.rotation.w = 1.0
        message.transforms = [transform]
        return message

    def feed_transforms(self):
        while not rospy.is_shutdown() and not self.ended:  # nor while it is restarted
            try:
                self.send("tf", self.transforms(self.clock.now()))
            except rospy.ROSException:
                return  # shut down meanwhile
            time.sleep(0.05)

    def is_connected(self):
        return self.lives() and all(publisher.get_num_connections() > 0 for topic, publisher in
                                    self.publishers.items())

    def registered(self):
        """Its topics and services as the master has them: (inputs, outputs, services), without its namespace."""
        names = {self.full_name()} if self.kind == "process" else {self.full_name(), self.space + "/manager"}
        publishers, subscribers, services = rosgraph.Master("/every_node").getSystemState()
        types = dict(rosgraph.Master("/every_node").getTopicTypes())

        def of(entries):
            return {name[len(self.space) + 1:]: types.get(name) for name, nodes in entries
                    if names & set(nodes) and name.startswith(self.space + "/")}
        return of(subscribers), of(publishers), of(services)

    def story(self):
        """For a failure that comes once in many runs: its connections, where they are fewer than one a topic, and what it
        said last."""
        name = self.full_name() if self.kind == "process" else self.space + "/manager"
        try:
            uri = rosgraph.Master("/every_node").lookupNode(name)
            links = {link[4] for link in xmlrpc.client.ServerProxy(uri).getBusInfo("/every_node")[2]}
        except (OSError, rosgraph.MasterException, xmlrpc.client.Error) as error:
            return "%s: %s" % (self, error)
        topics = {self.resolved(topic) for topic, _ in list(self.fed()) + list(self.listened())} | {"/clock"}
        with open(self.log.name, errors="replace") as said:
            lines = said.read().splitlines()[-8:]
        return "%s: not connected: %s; it said last:\n%s" % (self, ", ".join(sorted(topics - links)), "\n".join(lines))

    def right(self, message_type):
        return right_messages.right(message_type, self)

    def restart(self):
        """As after kill -9; what it said before is forgotten."""
        self.end_processes(signal.SIGKILL)
        self.processes = []
        with self.lock:
            self.messages.clear()
        self.start()

    def end(self, number):
        """Ends it for good. As end_processes().

        What was seen before (killed_node.py): with the end of every_commander_start a listener on ports of the dead heard 34
        times that nobody publishes /clock any more; in CI a node of every_node_clock, beside it, lost its clock for good.
        """
        self.ended = True
        seconds = self.end_processes(number)
        for name in self.known_names():
            killed_node.forget(name)
        return seconds

    def known_names(self):
        """Of the nodes in its namespace that the master knows."""
        state = rosgraph.Master("/every_node").getSystemState()
        return sorted({name for kind in state for _, nodes in kind for name in nodes if name.startswith(self.space + "/")})

    def end_processes(self, number):
        """Sends the signal and returns the seconds until all of its processes had ended, None if they did not."""
        begin = time.monotonic()
        for process in reversed(self.processes):
            process.send_signal(number)
        for process in self.processes:
            while process.poll() is None and time.monotonic() < begin + LONGEST_END:
                time.sleep(0.01)
            if process.poll() is None:
                print("%s: %s has not ended; its threads:\n%s" % (self, " ".join(process.args[:2]), threads_of(process)))
                process.kill()
                return None
        self.forget_connections()
        return time.monotonic() - begin

    def forget_connections(self):
        """To what was killed: rospy counts them until it next sends, so that the next node of this name would be taken for
        connected, and a goal that is sent once would go to one of them."""
        for publisher in self.publishers.values():
            for connection in list(publisher.impl.connections):
                publisher.impl.remove_connection(connection)
                connection.close()
