"""The disk that maps and paths are written to is full, then read-only, then there again.

A small file system in memory, which only root can mount: the row says *not run* elsewhere. Holds if no node ends and
the vehicle drives on, every file service says that it failed, what was written before is whole, and the services
succeed when there is room.
"""
import os
import subprocess

from ros_session import SessionFailed

from .session import Demo, NotRun

KILOBYTES = 8192


def mount(*words):
    answer = subprocess.run(["mount", *words], capture_output=True, text=True)
    if answer.returncode != 0:
        raise NotRun("mount: " + answer.stderr.strip())


def saved():
    """Calls every service that writes, and returns which succeeded."""
    import rospy
    from grid_path_planner.srv import SaveFile, SaveWaypoints
    kinds = {"/projected_map/save_map": (SaveFile, "map.yaml"), "/projected_map/save_octree": (SaveFile, "map.bt"),
             "/path_planner/save_waypoints": (SaveWaypoints, "path.yaml")}
    answers = {}
    for service, (kind, name) in kinds.items():
        answer = rospy.ServiceProxy(service, kind)(name)
        answers[service] = answer.success
        if not answer.success and not answer.message:
            raise SessionFailed(service + " fails without a word")
    return answers


def contents(folder):
    found = {}
    for name in ("map.yaml", "map.bt", "path.yaml"):
        with open(os.path.join(folder, name), "rb") as file:
            found[name] = file.read()
    return found


def expect(answers, success):
    wrong = [service for service, done in answers.items() if done != success]
    if wrong:
        raise SessionFailed("%s: success is %s" % (", ".join(wrong), not success))


def fill(filler):
    """What room there is, or has become free again: a map that was being kept while the disk became full is removed."""
    with open(filler, "ab") as file:
        subprocess.run(["dd", "if=/dev/zero", "bs=1024"], stdout=file, stderr=subprocess.DEVNULL)


def suffer(demo, folder):
    """Full, then read-only; and every time there again."""
    expect(saved(), True)
    before = contents(folder)
    for trouble in ("full", "read-only"):
        filler = os.path.join(folder, "filler")
        if trouble == "full":
            fill(filler)
        else:
            mount("-o", "remount,ro", folder)
        demo.drive.goes_on()
        if trouble == "full":
            fill(filler)
        expect(saved(), False)
        if contents(folder) != before:
            raise SessionFailed("a disk that is %s has changed what was saved" % trouble)
        demo.drive.goes_on()
        if trouble == "full":
            os.unlink(filler)
        else:
            mount("-o", "remount,rw", folder)
        expect(saved(), True)
        before = contents(folder)


def storm(rounds, folder, given):
    kept = os.path.join(folder, "kept")
    os.mkdir(kept)
    mount("-t", "tmpfs", "-o", "size=%dk" % KILOBYTES, "tmpfs", kept)
    try:
        with Demo(folder, given) as demo:
            demo.drive.goes_on()
            before = demo.pids()
            for _ in range(int(rounds)):
                suffer(demo, kept)
            if demo.pids() != before:
                raise SessionFailed("a node has ended")
    finally:
        subprocess.run(["umount", "-l", kept])
    return "%d times full and read-only, every write refused with a sentence, what was written before is whole" % rounds
