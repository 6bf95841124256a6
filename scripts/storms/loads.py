"""What storms/load.py puts on the nodes: each load is a process of its own, `python3 -m storms.loads KIND TALLY [RATE]`.

Maps of 4000x4000 cells, free but for a wall and a block that is elsewhere in each; goals at 1 kHz; clients of ~make_plan; a
subscriber that never reads.
"""
import itertools
import os
import socket
import struct
import sys
import threading
import time

SIDE, RESOLUTION = 4000, 0.05
BLOCK = 40            # cells
MAP_RATES, GOAL_RATE, CLIENTS = (5.0, 10.0), 1000.0, 50
TALLY_SECONDS = 0.2   # between two counts of what was sent
PLANNER = "/path_planner"
LONGEST_ANSWER = 5.0  # s
ACROSS = (1.0, 40.0, 76.0)  # m: x of a question's two ends, and their y, along the middle of the block's way
CLOSED = ("unable to receive data from sender", "connection closed")  # rospy's words for such a connection
ENDS, END_SECONDS = ((180.0, 180.0), (180.0, 20.0)), 45.0  # m; so long each, in which none drives 100 m
HEIGHT = 1.5  # m; 2-D nodes do not care


def serialized_map():
    """Of bytes: rospy's own message of 16 million cells takes seconds to write."""
    header = struct.pack("<III", 0, 0, 0) + struct.pack("<I", 3) + b"map"
    info = struct.pack("<IIfII7d", 0, 0, RESOLUTION, SIDE, SIDE, 0, 0, 0, 0, 0, 0, 1)
    cells = bytearray(SIDE * SIDE)
    wall = SIDE // 2 * SIDE
    cells[wall:wall + SIDE // 2] = b"\x64" * (SIDE // 2)
    return header + info + struct.pack("<I", len(cells)) + bytes(cells)


def put_block(content, turn, value):
    """What changes from map to map: a block of BLOCK cells a side goes to and fro on the side of the wall where questions are
    asked, and where no path to ENDS leads: upon the vehicle it would end the drive."""
    column = 100 + 5 * abs(turn % 200 - 100)
    for row in range(3 * SIDE // 8, 3 * SIDE // 8 + BLOCK):
        begin = len(content) - SIDE * SIDE + row * SIDE + column
        content[begin:begin + BLOCK] = bytes([value]) * BLOCK


def publish_maps():
    import rospy
    from nav_msgs.msg import OccupancyGrid
    content, number = bytearray(serialized_map()), itertools.count()

    class Whole(OccupancyGrid):
        __slots__ = ()

        def serialize(self, buff):
            now = time.time()
            struct.pack_into("<II", content, 4, int(now), int(now % 1 * 1e9))
            turn = next(number)
            put_block(content, turn - 1, 0)
            put_block(content, turn, 100)
            buff.write(content)
    publisher = rospy.Publisher("projected_map", OccupancyGrid, queue_size=1)
    return lambda: publisher.publish(Whole()), MAP_RATES[0]


def publish_goals():
    import rospy
    from geometry_msgs.msg import PoseStamped
    publisher = rospy.Publisher("goal", PoseStamped, queue_size=100)
    goal = PoseStamped()
    goal.header.frame_id, goal.pose.orientation.w, goal.pose.position.z = "map", 1.0, HEIGHT

    begin = time.monotonic()

    def publish():
        goal.pose.position.x, goal.pose.position.y = ENDS[int((time.monotonic() - begin) / END_SECONDS) % 2]
        publisher.publish(goal)
    return publish, GOAL_RATE


def make_plan(persistent=False):
    import rospy
    from nav_msgs.srv import GetPlan
    return rospy.ServiceProxy(PLANNER + "/make_plan", GetPlan, persistent)


NEAR = ((1.0, 1.0), (5.0, 5.0))  # m: a question's two ends


def plan(ask=None, start=NEAR[0], goal=NEAR[1]):
    """Seconds that it took, and the path's poses."""
    from nav_msgs.srv import GetPlanRequest
    request = GetPlanRequest()
    for end, (x, y) in ((request.start, start), (request.goal, goal)):
        end.header.frame_id, end.pose.orientation.w = "map", 1.0
        end.pose.position.x, end.pose.position.y = x, y
    begin = time.monotonic()
    answer = (ask or make_plan())(request)
    return time.monotonic() - begin, answer.plan.poses


def ask_for_plans():
    """CLIENTS threads; prints what each answer took, or why there was none, also while it is waited for. Half of them
    connect for every question: all would use up the machine's ports, of which a closed connection keeps one for a minute.
    One more asks once a second for a path through what the block crosses, and prints where it was avoided."""
    asked = [None] * (CLIENTS + 1)  # when, of questions without an answer

    def answers(number, proxy, *ends):
        asked[number] = time.monotonic()
        seconds, poses = plan(proxy, *ends)
        asked[number] = None
        if len(poses) < 2:
            raise ValueError("no path")
        return seconds, poses

    def ask(number, persistent):
        again = False  # the question is one that had no answer
        while True:
            try:
                proxy = make_plan(persistent)
                while True:
                    tell("%.4f" % answers(number, proxy)[0])
                    again = False
            except Exception as reason:
                asked[number] = None
                again = not again and any(words in str(reason) for words in CLOSED)
                tell("%s%s: %s" % (AGAIN if again else "", type(reason).__name__, reason))
                time.sleep(0.0 if again else 1.0)

    def look_for_block():
        begin, end, level = ACROSS
        while True:
            try:
                seconds, poses = answers(CLIENTS, None, (begin, level), (end, level))
                beside = [pose.pose.position.x for pose in poses if abs(pose.pose.position.y - level) > BLOCK * RESOLUTION / 2]
                tell("%s%.4f %s" % (SEEN, seconds, "%.2f" % min(beside) if beside else "nowhere"))
            except Exception as reason:
                asked[CLIENTS] = None
                again = any(words in str(reason) for words in CLOSED)
                tell("%s%s: %s" % (AGAIN if again else "", type(reason).__name__, reason))
            time.sleep(1.0)

    def tell(text):
        sys.stdout.write(" ".join(text.split()) + "\n")  # at once: print() writes the end of the line apart
        sys.stdout.flush()

    def tell_late():
        for number, since in enumerate(asked):
            if since is not None and time.monotonic() > since + LONGEST_ANSWER:
                tell("no answer for %.1f s" % (time.monotonic() - since))
    for number in range(CLIENTS):
        threading.Thread(target=ask, args=(number, number % 2 == 0), daemon=True).start()
    threading.Thread(target=look_for_block, daemon=True).start()
    return tell_late, 1.0


def never_read():
    """Connections to planning_map that take no byte after the header."""
    import rosgraph
    import xmlrpc.client
    kept = []

    def connect():
        if kept:
            return
        node = xmlrpc.client.ServerProxy(rosgraph.Master("/deaf").lookupNode(PLANNER))
        _, host, port = node.requestTopic("/deaf", "/planning_map", [["TCPROS"]])[2]
        connection = socket.create_connection((host, port))
        fields = ("callerid=/deaf", "topic=/planning_map", "type=nav_msgs/OccupancyGrid", "md5sum=*")
        header = b"".join(struct.pack("<I", len(field)) + field.encode() for field in fields)
        connection.sendall(struct.pack("<I", len(header)) + header)
        kept.append(connection)
    return connect, 1.0


COUNTED = ("maps", "goals")  # of LOADS: by what path_planner was sent
ANSWERED, AGAIN, SEEN = "clients", "again: ", "block: "  # of LOADS: what it prints is read, and what such lines begin with
LOADS = {"maps": publish_maps, "goals": publish_goals, "clients": ask_for_plans, "deaf": never_read}


def keep_tally(name, acts):
    """What path_planner was sent, over all of its connections, and how often there was something to send, in a file:
    getBusStats has no room for so many bytes."""
    from rospy.impl.registration import get_topic_manager
    sent = {}  # {connection: messages}
    while True:
        for topic, publisher in list(get_topic_manager().pubs.items()):
            if topic != "/rosout":
                sent.update({link.id: link.stat_num_msg for link in publisher.connections if link.endpoint_id == PLANNER})
        with open(name + ".new", "w") as file:
            file.write("%d %d" % (sum(sent.values()), acts[0]))
        os.replace(name + ".new", name)
        time.sleep(TALLY_SECONDS)


def put_load(kind, tally, rate=None):
    """In a process of its own, until it is killed."""
    import rospy
    rospy.init_node("load_" + kind, disable_signals=True)
    act, usual = LOADS[kind]()
    acts = [0]
    threading.Thread(target=keep_tally, args=(tally, acts), daemon=True).start()
    period = 1.0 / float(rate or usual)
    due = time.monotonic()
    while True:
        act()
        acts[0] += 1
        due = max(due + period, time.monotonic() - 1.0)  # what is late is made up for, a second of it
        time.sleep(max(0.0, due - time.monotonic()))


if __name__ == "__main__":
    put_load(*sys.argv[1:])
