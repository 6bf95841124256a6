"""A minute of the others in one session, for the tests: kills, jumps of time, a master that is gone."""
from ros_session import SessionFailed

from . import clocks, master
from .kills import Kills, check_that_none_is_missing
from .session import Demo
from .silence import Silence

KILLED = ("/projected_map", "/path_planner")
JUMPS = (-2.0, 3600.0)  # s


def storm(rounds, folder, given):
    check_that_none_is_missing()
    with Demo(folder, given) as demo, Silence() as silence:
        kills = Kills(demo, KILLED)
        text = kills.run(int(rounds))
        for seconds in JUMPS:
            clocks.jump(demo, seconds)
        silence.begin()
        slowest, speed = master.lose(demo, master.SHORT)
        silence.end()
        if speed < master.MOVING:
            raise SessionFailed("without a master the vehicle stands")
        return "%s; all names there %.1f s after the master; %s" % (text, slowest, silence.verdict())
