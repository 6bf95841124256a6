"""scripts/storm does not say that a storm held which did not blow: one whose process was killed, of no rounds, under a load
that has ended, without the answers that were asked for, or with commands that ceased for good."""
import importlib.machinery
import importlib.util
import os
import subprocess
import sys
import tempfile
import types

from common import ROOT, finish

STORM = os.path.join(ROOT, "scripts", "storm")
NO_STORMS = ("--disk=0.5", "--kills=0", "--links=-1", "--load=0", "--hours=nan", "--sensors=inf")


def storm_module():
    loader = importlib.machinery.SourceFileLoader("storm", STORM)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("storm", loader))
    loader.exec_module(module)
    return module


def problems_of_amounts():
    for asked in NO_STORMS:
        done = subprocess.run([sys.executable, STORM, asked], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True)
        if done.returncode != 2:
            yield "scripts/storm %s: exit code %d, expected 2: %s" % (asked, done.returncode, done.stdout[-300:])


def problems_of_codes(storm):
    for script, expected in (("exit 0", 0), ("exit 3", 3), ("kill -9 $$", 1)):
        code = storm.call(["sh", "-c", script])
        if code != expected:
            yield "scripts/storm: a storm that ended by '%s' counts as %d, expected %d" % (script, code, expected)


def problems_of_loads():
    from ros_session import SessionFailed
    from storms import load
    with tempfile.TemporaryDirectory() as folder:
        nodes = load.Nodes(folder, [], types.SimpleNamespace(programs=lambda _: {}))
        try:
            nodes.check()
            nodes.loads["maps"] = nodes.start(["false"])
            nodes.loads["maps"].wait()
            nodes.check()
            yield "storms/load.py: no word of a load that has ended"
        except SessionFailed as reason:
            if "the load of maps" not in str(reason):
                yield "storms/load.py: not the load is named that has ended, but: %s" % reason
        finally:
            nodes.stop()


def answers_of(number, **changes):
    """What clients were told in a run that holds, but for `changes`."""
    from storms import load
    answers = load.Answers(types.SimpleNamespace(stdout=[]))
    answers.seconds, answers.across, answers.seen = [0.2] * number, [0.4] * 10, ["%d" % place for place in range(10)]
    answers.rates = {"maps": [5.0, 5.0], "goals": [1000.0, 1000.0]}
    vars(answers).update(changes)
    return answers


def problems_of_verdicts():
    """Of the load storm: what nodes are told to have held under, which they may not have."""
    from ros_session import SessionFailed
    from storms import load
    held, failed, not_run = "held", "failed", "not run"
    for expected, changes, *silent in (
            (held, {}), (failed, {}, False), (failed, {"seconds": [0.2] * 90 + [0.6] * 10}), (failed, {"seconds": [0.2] * 99 + [5.1]}),
            (failed, {"failures": ["no answer for 5.1 s"]}), (failed, {"seen": ["7.5"] * 10}), (failed, {"seen": ["nowhere"] * 10}),
            (failed, {"across": [5.1]}), (failed, {"seconds": []}), (failed, {"across": []}),
            (failed, {"rates": {"maps": [3.0, 5.0], "goals": [1000.0, 1000.0]}}),
            (not_run, {"rates": {"maps": [3.0, 3.0], "goals": [1000.0, 1000.0]}})):
        try:
            load.verdict({5.0: answers_of(100, **changes)}, 100.0, 0.1, "", *silent)
            told = held
        except SessionFailed:
            told = failed
        except load.NotRun:
            told = not_run
        if told != expected:
            yield "storms/load.py: %s is told as %s" % ((changes, *silent), told)


def problems_of_gaps():
    """What was seen before: commands that cease for good were no silence, which began and ended with a command."""
    from storms.silence import Gaps
    for heard, expected in (((1.1, 1.3), [0.2, 0.7]), ((), [1.0]), ((0.5, 1.5, 2.5), [0.5])):
        gaps = Gaps()
        for now, act in sorted([(1.0, gaps.begin), (2.0, gaps.end)] + [(at, gaps.heard) for at in heard], key=lambda item: item[0]):
            act(now)
        if [round(seconds, 6) for seconds in gaps.seconds] != expected:
            yield "storms/silence.py: gaps of %s are %s, expected %s" % (heard, gaps.seconds, expected)


def main():
    sys.dont_write_bytecode = True
    sys.path.insert(0, os.path.join(ROOT, "scripts"))
    finish([*problems_of_amounts(), *problems_of_codes(storm_module()), *problems_of_loads(),
            *problems_of_verdicts(), *problems_of_gaps()],
           "%d amounts, the codes, the loads and their verdicts" % len(NO_STORMS))


main()
