"""The disk that nodes write to is full, then read-only, then there again.

A small file system in memory, which one must be allowed to mount: the row says *not run* elsewhere. Holds if no node ends
and the vehicle drives on, everything that a node writes (node_writers.py) is refused with a sentence, what was written
before is whole, nothing is left beside it, and all is written when there is room.
"""
import os

from ros_session import SessionFailed

from .node_writers import ROWS, NodeWriters, check_log_that_fills, check_refused, check_written
from .session import Demo
from .small_disk import TROUBLES, SmallDisk


def suffer(demo, writers, disk):
    """Each trouble once; and every time there again."""
    check_written(writers)
    for trouble in TROUBLES:
        with disk.trouble(trouble):
            demo.drive.goes_on()
            check_refused(writers, disk, trouble)
            demo.drive.goes_on()
        check_written(writers)
    check_log_that_fills(writers, disk)


def storm(rounds, folder, given):
    with SmallDisk(os.path.join(folder, "kept")) as disk, Demo(folder, given) as demo:
        demo.drive.goes_on()
        before = demo.pids()
        writers = NodeWriters(disk.folder, plan=demo.drive.ask, see=demo.drive.goes_on)
        for _ in range(int(rounds)):
            suffer(demo, writers, disk)
        if demo.pids() != before:
            raise SessionFailed("a node has ended")
    return "%d times full and read-only, %d kinds of writing refused with a sentence, what was written before is whole" % (
        rounds, len(ROWS))
