"""libFuzzer on every reader and message handler for so many hours each: scripts/fuzz, whose verdict this is."""
import os
import subprocess

from ros_session import SessionFailed

from .session import NotRun

PROGRAM = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "fuzz")


def storm(hours, _folder, _given):
    if not os.path.exists(PROGRAM):
        raise NotRun("there is no scripts/fuzz")
    code = subprocess.call([PROGRAM, "--seconds", str(int(3600 * hours))])
    if code != 0:
        raise SessionFailed("scripts/fuzz has ended with code %d" % code)
    return "%g hours of scripts/fuzz for each target" % hours
