"""Includes only point down the floors of the rooms, and ROS is seen in ros/ and the programs only.

One include/ tree cannot stop a wrong include; this reads every #include instead. What stands below a
room is read from the link lines of CMakeLists.txt, the one place that says it.
"""
import re

from common import files, finish, read

PACKAGE = "grid_path_planner"
OUTERMOST = {"nodes", "option_files", "tools"}  # programs: may use every room
ROS_ROOMS = {"ros"} | OUTERMOST
ROS_HEADER = re.compile(
    r"(ros|tf2\w*|nodelet|pluginlib|rosbag|actionlib|dynamic_reconfigure|diagnostic_updater|topic_tools"
    r"|\w+_msgs|std_srvs|%s/[A-Z]\w*)(/.*|\.h)?$" % PACKAGE)


def floors():
    """Each room with all the rooms below it, itself included."""
    below = {}
    for name, arguments in re.findall(r"gpp_add_room\((\w+)([^)]*)\)", read("CMakeLists.txt")):
        direct = re.search(r"ROOMS((?: +[a-z_]+)+)", arguments)
        below[name] = {name}
        for room in direct.group(1).split() if direct else []:
            below[name] |= below[room]
    return below


def room_of(name):
    parts = name.split("/")
    return parts[2] if parts[0] == "include" else parts[1]


def main():
    below = floors()
    names = files(("include", "src"), (".h", ".cpp"))
    complaints = []
    for name in names:
        room = room_of(name)
        allowed = set(below) if room in OUTERMOST else below.get(room)
        if allowed is None:
            complaints.append("%s: room '%s' is not in CMakeLists.txt" % (name, room))
            continue
        for number, line in enumerate(read(name).splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
            if not match:
                continue
            header = match.group(1)
            if header.startswith("../"):
                complaints.append("%s:%d: reaches into another folder" % (name, number))
            of_room = re.match(PACKAGE + r"/([a-z_]+)/", header)
            if of_room and of_room.group(1) not in allowed:
                complaints.append("%s:%d: room '%s' stands not on '%s'"
                                  % (name, number, room, of_room.group(1)))
            if not of_room and room not in ROS_ROOMS and ROS_HEADER.match(header):
                complaints.append("%s:%d: ROS in room '%s': %s" % (name, number, room, header))
    finish(complaints, "%d files of %d rooms" % (len(names), len(below)) if below else "0 rooms")


main()
