"""Every command of a tutorial does what the page shows.

    check_tutorial.py PAGE

In an indented block a line that begins with `$ ` is typed, with the lines after it up to `END` where it ends with
<<'END'; what follows are lines that it prints, in this order and with others between, `…` standing for any text.
Commands run in an empty folder, with a ROS master of their own. One that ends with ` &` goes on until the page ends; its
nodes print in any order, and a page may show more lines of it later, in a block without commands.
"""
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "scripts"))
from ros_session import free_port  # noqa: E402

SECONDS = 150.0  # for a command, or for a line of one that goes on


def blocks_of(page):
    with open(page, encoding="utf-8") as file:
        text = file.read()
    found = re.findall(r"(?:^    .*\n|^\n(?=    ))+", text, re.M)
    return [[line[4:] for line in block.strip("\n").split("\n")] for block in found]


def steps_of(block):
    """(command, lines that it prints); the command is empty where the lines are of one that goes on."""
    steps, lines = [], list(block)
    while lines:
        command = ""
        if lines[0].startswith("$ "):
            command = lines.pop(0)[2:]
            if command.endswith("<<'END'"):
                end = lines.index("END")
                command, lines = "\n".join([command] + lines[:end + 1]), lines[end + 1:]
        printed = []
        while lines and not lines[0].startswith("$ "):
            printed.append(lines.pop(0))
        steps.append((command, [line for line in printed if line.strip()]))
    return steps


def missing_line(expected, output, in_order):
    """The first expected line that is not printed, or not after those before it; None: all are."""
    at = 0
    for line in expected:
        pattern = ".*".join(re.escape(part) for part in line.strip().split("…"))
        found = re.compile(pattern).search(output, at)
        if not found:
            return line
        at = found.end() if in_order else 0
    return None


class Session:
    """The folder, the master and what goes on in the background."""

    def __init__(self, folder):
        self.port = free_port()
        self.folder = folder
        self.environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % self.port, PWD=folder,
                                ROS_HOSTNAME="localhost", ROS_HOME=os.path.join(folder, ".ros"),
                                ROSCONSOLE_STDOUT_LINE_BUFFERED="1")
        self.environment.pop("ROS_IP", None)
        self.background = None
        self.log = os.path.join(folder, ".background")

    def start(self, command):
        with open(self.log, "w") as log:
            self.background = subprocess.Popen(["bash", "-c", "exec " + command], cwd=self.folder, env=self.environment,
                                               stdout=log, stderr=subprocess.STDOUT, start_new_session=True)

    def wait_for(self, expected):
        end = time.monotonic() + SECONDS
        while True:
            with open(self.log, encoding="utf-8", errors="replace") as file:
                output = file.read()
            missing = missing_line(expected, output, in_order=False)
            if missing is None or time.monotonic() > end or self.background.poll() is not None:
                return missing, output
            time.sleep(0.2)

    def run(self, command, expected):
        answer = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, timeout=SECONDS,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        missing = missing_line(expected, answer.stdout, in_order=True)
        if missing is None and answer.returncode not in (0, 1):
            missing = "exit code %d" % answer.returncode
        return missing, answer.stdout

    def do(self, command, expected):
        if command.endswith(" &"):
            self.start(command[:-2].replace("roslaunch ", "roslaunch -p %d " % self.port, 1))
        if command.endswith(" &") or not command:
            return self.wait_for(expected)
        return self.run(command, expected)

    def end(self):
        if self.background and self.background.poll() is None:
            os.killpg(self.background.pid, signal.SIGINT)
            try:
                self.background.wait(30)
            except subprocess.TimeoutExpired:
                os.killpg(self.background.pid, signal.SIGKILL)


def main():
    steps = [step for block in blocks_of(sys.argv[1]) for step in steps_of(block)]
    if not steps:
        sys.exit("%s has no commands" % sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        session = Session(folder)
        try:
            for command, expected in steps:
                print("$ " + command, flush=True)
                missing, output = session.do(command, expected)
                if missing is not None:
                    sys.exit("%s\n%s does not print: %s" % (output, sys.argv[1], missing))
        finally:
            session.end()
    print("%d commands do what %s shows" % (len(steps), sys.argv[1]))


if __name__ == "__main__":
    main()
