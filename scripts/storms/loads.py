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
    return rospy.ServiceProxy("/path_planner/make_plan", GetPlan, persistent)


def plan(x, y, ask=None):
    """Seconds that it took, and how many poses the path has."""
    from nav_msgs.srv import GetPlanRequest
    request = GetPlanRequest()
    request.start.header.frame_id = request.goal.header.frame_id = "map"
    request.start.pose.position.x = request.start.pose.position.y = 1.0
    request.goal.pose.position.x, request.goal.pose.position.y = x, y
    request.start.pose.orientation.w = request.goal.pose.orientation.w = 1.0
    begin = time.monotonic()
    answer = (ask or make_plan())(request)
    return time.monotonic() - begin, len(answer.plan.poses)


def ask_for_plans():
    """CLIENTS threads; prints what each answer took, or why there was none. Half of them connect for every question: all
    would use up the machine's ports, of which a closed connection keeps one for a minute."""
    def ask(persistent):
        again = False  # the question is one that had no answer
        while True:
            try:
                proxy = make_plan(persistent)
                while True:
                    tell("%.4f" % plan(5.0, 5.0, proxy)[0])
                    again = False
            except Exception as reason:
                again = not again and any(words in str(reason) for words in CLOSED)
                tell("%s%s: %s" % (AGAIN if again else "", type(reason).__name__, reason))
                time.sleep(0.0 if again else 1.0)

    def tell(text):
        sys.stdout.write(" ".join(text.split()) + "\n")  # at once: print() writes the end of the line apart
        sys.stdout.flush()
    for number in range(CLIENTS):
        threading.Thread(target=ask, args=(number % 2 == 0,), daemon=True).start()
    return lambda: None, 1.0


def never_read():
    """Connections to planning_map that take no byte after the header."""
    import rosgraph
    import xmlrpc.client
    kept = []

    def connect():
        if kept:
            return
        node = xmlrpc.client.ServerProxy(rosgraph.Master("/deaf").lookupNode("/path_planner"))
        _, host, port = node.requestTopic("/deaf", "/planning_map", [["TCPROS"]])[2]
        connection = socket.create_connection((host, port))
        fields = ("callerid=/deaf", "topic=/planning_map", "type=nav_msgs/OccupancyGrid", "md5sum=*")
        header = b"".join(struct.pack("<I", len(field)) + field.encode() for field in fields)
        connection.sendall(struct.pack("<I", len(header)) + header)
        kept.append(connection)
    return connect, 1.0


COUNTED = ("maps", "goals")  # of LOADS: by what path_planner was sent
ANSWERED, AGAIN = "clients", "again: "  # of LOADS: what it prints is read, and what such a line begins with
LOADS = {"maps": publish_maps, "goals": publish_goals, "clients": ask_for_plans, "deaf": never_read}


def keep_tally(name):
    """Of what subscribers were sent, in a file: getBusStats has no room for so many bytes."""
    from rospy.impl.registration import get_topic_manager
    while True:
        links = [link for topic, publisher in list(get_topic_manager().pubs.items()) if topic != "/rosout"
                 for link in publisher.get_stats()[2]]
        with open(name + ".new", "w") as file:
            file.write("%d" % max([number for _, _, number, _ in links] or [0]))
        os.replace(name + ".new", name)
        time.sleep(TALLY_SECONDS)


def put_load(kind, tally, rate=None):
    """In a process of its own, until it is killed."""
    import rospy
    rospy.init_node("load_" + kind, disable_signals=True)
    act, usual = LOADS[kind]()
    threading.Thread(target=keep_tally, args=(tally,), daemon=True).start()
    period = 1.0 / float(rate or usual)
    due = time.monotonic()
    while True:
        act()
        due = max(due + period, time.monotonic() - 1.0)  # what is late is made up for, a second of it
        time.sleep(max(0.0, due - time.monotonic()))


if __name__ == "__main__":
    put_load(*sys.argv[1:])
