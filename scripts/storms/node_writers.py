"""All that nodes write to files: services, a file for each plan, the map that is kept, the log of a flight.

    writers = NodeWriters(folder, plan, see)
    check_written(writers)
    with disk.trouble("full"):
        check_refused(writers, disk, "full")

The nodes are projected_map and path_planner, which save into `folder`; a local_planner is started for its log. `plan()` has
path_planner find a path, `see()` changes what projected_map has mapped.
"""
import os
import signal
import subprocess
import time

from ros_session import SessionFailed, executable

from .small_disk import TEMPORARY, TROUBLES

SECONDS = 30.0  # for an answer, of the wall clock
SERVICES = {  # {row: service, its type, file}
    "save_map": ("/projected_map/save_map", "SaveFile", "map.yaml"),
    "save_octree_bt": ("/projected_map/save_octree", "SaveFile", "map.bt"),
    "save_octree_ot": ("/projected_map/save_octree", "SaveFile", "map.ot"),
    "save_waypoints": ("/path_planner/save_waypoints", "SaveWaypoints", "saved.yaml"),
}
ROWS = tuple(SERVICES) + ("waypoints_file", "autosave", "flight_log")
LOG = "own.flight"
PLANNED = "each_plan.yaml"  # ~waypoints_file of path_planner
NOT_PLANNED, NOT_KEPT = "The waypoints were not saved: ", "the map is not kept: "
LOG_BEGINS, LOG_ENDS = "What the pilot is given and answers is written to", "The flight log ends here: "


class FlightLog:
    """A local_planner that logs; with its topics in a namespace of its own, so that it drives nobody."""

    def __init__(self, folder, output):
        self.output = output
        with open(output, "w") as file:
            self.process = subprocess.Popen(
                [executable("local_planner"), "--save-folder", folder, "_log:=" + LOG, "__ns:=/log_writer",
                 "__name:=local_planner"], stdout=file, stderr=subprocess.STDOUT,
                env=dict(os.environ, ROSCONSOLE_STDOUT_LINE_BUFFERED="1"))

    def said(self):
        with open(self.output, errors="replace") as file:
            return file.read()

    def wait(self, done, what):
        deadline = time.monotonic() + SECONDS
        while not done():
            if time.monotonic() > deadline:
                raise SessionFailed("local_planner: no %s; it says %s" % (what, self.said()))
            time.sleep(0.02)

    def ended(self):
        return self.process.poll() is not None

    def end(self):
        if not self.ended():
            self.process.send_signal(signal.SIGINT)
        return self.process.wait(SECONDS)


class NodeWriters:
    def __init__(self, folder, plan, see):
        import rospy
        from diagnostic_msgs.msg import DiagnosticArray
        from rosgraph_msgs.msg import Log
        self.folder, self.plan, self.see = folder, plan, see
        self.said, self.kept = [], ""
        self.subscribers = [rospy.Subscriber("/rosout", Log, lambda message: self.said.append(message.msg)),
                            rospy.Subscriber("/diagnostics", DiagnosticArray, self.on_diagnostics)]
        self.set_waypoints_file()
        plan()  # for the services to save

    def on_diagnostics(self, message):
        for status in message.status:
            if status.name.endswith("autosave"):
                self.kept = status.message

    def set_waypoints_file(self):
        import rospy
        from dynamic_reconfigure.msg import Config, StrParameter
        from dynamic_reconfigure.srv import Reconfigure
        rospy.wait_for_service("/path_planner/set_parameters", SECONDS)
        config = Config(strs=[StrParameter(name="waypoints_file", value=PLANNED)])
        rospy.ServiceProxy("/path_planner/set_parameters", Reconfigure)(config)

    def ask(self, row, room):
        """Whether it was written, and what was said of it. `room`: that there is, whatever is still said of before."""
        if row in SERVICES:
            return self.call(*SERVICES[row])
        if row == "waypoints_file":
            return self.ask_for_plan()
        return self.ask_for_map(room) if row == "autosave" else self.ask_for_log()

    @staticmethod
    def call(service, kind, name):
        import rospy
        from grid_path_planner import srv
        answer = rospy.ServiceProxy(service, getattr(srv, kind))(name)
        return answer.success, answer.message

    def ask_for_plan(self):
        before, self.said = self.inode(PLANNED), []
        self.plan()
        return self.wait(PLANNED, before, lambda: next((text for text in self.said if NOT_PLANNED in text), ""))

    def ask_for_map(self, room):
        name, self.kept = self.kept_map(), ""
        before = self.inode(name)
        self.see()
        return self.wait(name, before, lambda: self.kept if NOT_KEPT in self.kept and not room else "")

    def ask_for_log(self):
        log = self.flight_log()
        log.wait(lambda: log.ended() or LOG_BEGINS in log.said(), "log")
        return log.end() == 0, log.said()

    def flight_log(self):
        return FlightLog(self.folder, self.folder + ".local_planner")

    def kept_map(self):
        """The file of projected_map, which is named after the master."""
        return next((name for name in os.listdir(self.folder) if name.startswith(".") and name.endswith(".ot")), "")

    def inode(self, name):
        try:
            return os.stat(os.path.join(self.folder, name)).st_ino
        except OSError:
            return None

    def wait(self, name, before, refused):
        """For another file of that name, or what is said instead."""
        deadline = time.monotonic() + SECONDS
        while time.monotonic() < deadline:
            if refused():
                return False, refused()
            now = self.inode(name or self.kept_map())
            if now not in (None, before):
                return True, "written"
            time.sleep(0.02)
        raise SessionFailed("%s is not written; of the kept map is said '%s'" % (name or "the kept map", self.kept))


def check_written(writers):
    for row in ROWS:
        written, sentence = writers.ask(row, room=True)
        if not written:
            raise SessionFailed("%s: not written: %s" % (row, sentence))


def is_compared(name, trouble):
    """A log empties the one before when it begins, and what is being written is no file yet."""
    return not TEMPORARY.match(name) and (trouble != "full" or name != LOG)


def check_refused(writers, disk, trouble):
    """While the disk has it. What was there is whole, and nothing is left beside it."""
    if trouble == "full":
        os.unlink(os.path.join(disk.folder, LOG))
        writers.see()  # by then what was being written is refused, and what it had taken is free again
        disk.fill()
    before = disk.contents()
    for row in ROWS:
        written, sentence = writers.ask(row, room=False)
        if written or TROUBLES[trouble] not in sentence:
            raise SessionFailed("%s, a disk that is %s: written is %s, said is '%s'" % (row, trouble, written, sentence))
    after = disk.contents()
    changed = [name for name in set(before) | set(after)
               if is_compared(name, trouble) and before.get(name) != after.get(name)]
    if changed:
        raise SessionFailed("a disk that is %s has changed %s" % (trouble, ", ".join(sorted(changed))))
    check_no_temporaries(disk)


def check_no_temporaries(disk):
    deadline = time.monotonic() + SECONDS
    while disk.temporaries():
        if time.monotonic() > deadline:
            raise SessionFailed("%s stays" % ", ".join(disk.temporaries()))
        time.sleep(0.02)


def check_log_that_fills(writers, disk):
    """The flight goes on, and what was logged until then can be repeated."""
    log = writers.flight_log()
    try:
        log.wait(lambda: LOG_BEGINS in log.said(), "log")
        with disk.trouble("full"):
            log.wait(lambda: LOG_ENDS + TROUBLES["full"] in log.said(), "word of the log's end")
            if log.ended():
                raise SessionFailed("local_planner has ended with its log: " + log.said())
    finally:
        code = log.end()
    if code != 0:
        raise SessionFailed("local_planner has ended with code %d" % code)
    answer = subprocess.run([executable("grid_path"), "flights", "--log", os.path.join(disk.folder, LOG)],
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    if answer.returncode != 0:
        raise SessionFailed("the log is not repeated: " + answer.stdout)
