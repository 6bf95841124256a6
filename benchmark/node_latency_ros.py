"""What node_latency measures with: a roscore of its own, a node under measurement, and messages that cost the
measuring side next to nothing, since whole maps and paths are handled as bytes."""
import os
import signal
import socket
import struct
import subprocess
import sys
import time
import warnings

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "scripts"))
from ros_session import free_port  # noqa: E402

FRAME = "map"
DEADLINE = 60.0  # s, for anything
warnings.filterwarnings("ignore", message=".*queue_size")  # none: messages are sent by the thread that publishes


class Missed(Exception):
    """Nothing came in time, or something else than what must; the message says what."""


class HungUp(Missed):
    """The node ended."""


class Core:
    """A roscore on a free port, for this process and those that it starts."""

    def __init__(self, log_folder):
        import rosgraph
        self.log_folder = log_folder
        os.environ.update({"ROS_MASTER_URI": "http://localhost:%d" % free_port(), "ROS_HOSTNAME": "localhost",
                           "ROS_LOG_DIR": log_folder, "ROS_HOME": log_folder})
        port = os.environ["ROS_MASTER_URI"].rsplit(":", 1)[1]
        self.process = start(["roscore", "-p", port], os.path.join(log_folder, "roscore.log"))
        wait_until(rosgraph.is_master_online, "roscore", 3 * DEADLINE)
        import rospy
        rospy.init_node("node_latency", disable_signals=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        import rospy
        rospy.signal_shutdown("done")
        end(self.process)


def start(command, log):
    with open(log, "w", encoding="utf-8") as out:
        # A process group of its own, so that Ctrl-C reaches this program alone; in a session of its own it would have
        # another share of the processor.
        return subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, preexec_fn=os.setpgrp)


def end(process):
    for number, seconds in ((signal.SIGINT, 15), (signal.SIGKILL, 5)):
        if process.poll() is None:
            process.send_signal(number)
            try:
                process.wait(seconds)
            except subprocess.TimeoutExpired:
                pass


def wait_until(done, what, seconds=DEADLINE):
    deadline = time.monotonic() + seconds
    while not done():
        if time.monotonic() > deadline:
            raise Missed("no %s within %.0f s" % (what, seconds))
        time.sleep(0.002)


class Usage:
    """Processor time and resident memory of a process."""

    def __init__(self, pid):
        self.pid = pid

    def cpu_s(self):
        with open("/proc/%d/stat" % self.pid, encoding="ascii") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def resident_mb(self):
        with open("/proc/%d/statm" % self.pid, encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


class Service:
    """A persistent connection to a service whose answers stay bytes."""

    def __init__(self, name, service_class):
        import rosgraph
        self.name = name
        self.socket = None
        wait_until(self.connect, name)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        fields = ("callerid=/node_latency", "service=" + name, "md5sum=" + service_class._md5sum,
                  "type=" + service_class._type, "persistent=1")
        header = b"".join(struct.pack("<I", len(field)) + field.encode() for field in fields)
        self.told(lambda: self.socket.sendall(struct.pack("<I", len(header)) + header))
        answer = self.receive(struct.unpack("<I", self.receive(4))[0])
        if b"error=" in answer:
            raise Missed("%s: %r" % (name, answer))

    def connect(self):
        """Whether it is there. A node that died is still registered, until one of its name starts."""
        import rosgraph
        try:
            host, port = rosgraph.Master("/node_latency").lookupService(self.name)[len("rosrpc://"):].split(":")
            self.socket = socket.create_connection((host, int(port)), DEADLINE)
        except (rosgraph.MasterError, ConnectionError):
            return False
        return True

    def told(self, talk):
        """What talk() returns; a node that ended or does not answer is an exception that says so."""
        try:
            return talk()
        except ConnectionError as error:
            raise HungUp(self.name + " hung up") from error
        except socket.timeout as error:
            raise Missed("no answer of %s within %.0f s" % (self.name, DEADLINE)) from error

    def receive(self, count):
        parts = []
        while count > 0:
            part = self.told(lambda: self.socket.recv(min(count, 1 << 20)))
            if not part:
                raise HungUp(self.name + " hung up")
            parts.append(part)
            count -= len(part)
        return b"".join(parts)

    def call(self, request):
        """The answer's bytes; b"" where the service refuses. `request`: as bytes."""
        self.told(lambda: self.socket.sendall(struct.pack("<I", len(request)) + request))
        ok = self.receive(1) == b"\x01"
        answer = self.receive(struct.unpack("<I", self.receive(4))[0])
        return answer if ok else b""


def as_bytes(message):
    import io
    out = io.BytesIO()
    message.serialize(out)
    return out.getvalue()


class Positions:
    """x and y of a nav_msgs/Path that is left as bytes."""

    def __init__(self, data):
        at = 12
        at += 4 + struct.unpack_from("<I", data, at)[0]
        self.count = struct.unpack_from("<I", data, at)[0]
        self.data, self.first = data, at + 4
        # All poses have the header of the path, so all take the same room.
        frame = struct.unpack_from("<I", data, self.first + 12)[0] if self.count else 0
        self.stride, self.at = 12 + 4 + frame + 56, 16 + frame

    def __getitem__(self, i):
        return struct.unpack_from("<dd", self.data, self.first + i % self.count * self.stride + self.at)


class Topic:
    """The messages of a topic as (time, bytes), as they come."""

    def __init__(self, name):
        import rospy
        self.received = []
        self.subscriber = rospy.Subscriber(
            name, rospy.AnyMsg, lambda message: self.received.append((time.monotonic(), message._buff)),
            tcp_nodelay=True)

    def next(self, seen, what, seconds=DEADLINE):
        """The first message after `seen` of them."""
        wait_until(lambda: len(self.received) > seen, what, seconds)
        return self.received[seen]

    def connected(self):
        return self.subscriber.get_num_connections() > 0

    def close(self):
        self.subscriber.unregister()


def whole_map_class():
    """An OccupancyGrid whose cells are bytes (of signed numbers) and are sent as they are."""
    from nav_msgs.msg import OccupancyGrid

    class WholeMap(OccupancyGrid):
        def serialize(self, buff):
            cells, self.data = self.data, []
            head = as_bytes_of(OccupancyGrid, self)
            self.data = cells
            buff.write(head[:-4])
            buff.write(struct.pack("<I", len(cells)))
            buff.write(cells)
    return WholeMap


def update_class():
    """map_msgs/OccupancyGridUpdate, whose Python package need not be installed."""
    from genpy.dynamic import generate_dynamic
    header = "std_msgs/Header header\nint32 x\nint32 y\nuint32 width\nuint32 height\nint8[] data\n"
    return generate_dynamic("map_msgs/OccupancyGridUpdate", header + "=" * 80 + """
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
""")["map_msgs/OccupancyGridUpdate"]


def transforms_class():
    """tf2_msgs/TFMessage, likewise; of transforms that are messages already."""
    import genpy

    class Transforms(genpy.Message):
        _type, _md5sum, _has_header = "tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec", False
        _full_text, __slots__, _slot_types = "geometry_msgs/TransformStamped[] transforms", ["transforms"], ["byte[]"]

        def serialize(self, buff):
            buff.write(struct.pack("<I", len(self.transforms)) + b"".join(map(as_bytes, self.transforms)))
    return Transforms


def as_bytes_of(message_class, message):
    import io
    out = io.BytesIO()
    message_class.serialize(message, out)
    return out.getvalue()
