"""Shell scripts pass shellcheck, Python ones compile (and pass pyflakes), and the demo map is the one
that scripts/make_demo_map makes."""
import os
import subprocess
import sys
import tempfile

from common import ROOT, files, finish, read, version_of


def run(command):
    answer = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, check=False)
    return [] if answer.returncode == 0 else [answer.stdout.strip() or " ".join(command) + " failed"]


def demo_map_complaints():
    with tempfile.TemporaryDirectory() as folder:
        complaints = run([sys.executable, "scripts/make_demo_map", folder])
        for name in ("demo_site.pgm", "demo_site.yaml"):
            with open(os.path.join(ROOT, "maps", name), "rb") as committed:
                with open(os.path.join(folder, name), "rb") as made:
                    if committed.read() != made.read():
                        complaints.append("maps/%s is not what scripts/make_demo_map makes" % name)
    return complaints


def main():
    names = files(("scripts", ".ci", "test/style"), ("",))
    names = [name for name in names if "__pycache__" not in name and not name.endswith(".txt")]
    python = [name for name in names if name.endswith(".py") or "python" in read(name).split("\n")[0]]
    shell = [name for name in names if name not in python]
    complaints = demo_map_complaints()
    for name in python:
        try:
            compile(read(name), name, "exec")
        except SyntaxError as error:
            complaints.append("%s: %s" % (name, error))
    if version_of("shellcheck"):
        complaints += run(["shellcheck", "-x"] + shell)
    if version_of("pyflakes3"):
        complaints += run(["pyflakes3"] + python)
    finish(complaints, "%d scripts" % len(names))


main()
