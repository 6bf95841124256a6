"""scripts/storm does not say that a storm held which did not blow: one whose process was killed, of no rounds, or under
a load that has ended."""
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


def main():
    sys.dont_write_bytecode = True
    sys.path.insert(0, os.path.join(ROOT, "scripts"))
    finish([*problems_of_amounts(), *problems_of_codes(storm_module()), *problems_of_loads()],
           "%d amounts, the codes and the loads" % len(NO_STORMS))


main()
