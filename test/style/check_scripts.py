"""Shell scripts pass shellcheck, Python ones compile and pass pyflakes, the worlds are what their
script makes, and everything is built below build/."""
import os
import re
import subprocess
import sys
import tempfile

from common import ROOT, files, finish, need, read


def run(command):
    answer = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, check=False)
    return [] if answer.returncode == 0 else [answer.stdout.strip() or " ".join(command) + " failed"]


# What scripts make, and where it is committed.
MADE = {"make_worlds": ("worlds", ("dexrov_site.sdf", "forest_maze.sdf", "office.sdf", "panel_site.sdf", "meshes"))}


def contents(folder, names):
    """The bytes of every file of these names, folders with all that is in them."""
    found = {}
    for name in names:
        path = os.path.join(folder, name)
        if os.path.isdir(path):
            inside = contents(path, sorted(os.listdir(path)))
            found.update({os.path.join(name, key): value for key, value in inside.items()})
        else:
            with open(path, "rb") as file:
                found[name] = file.read()
    return found


def made_file_complaints(script):
    place, names = MADE[script]
    with tempfile.TemporaryDirectory() as folder:
        complaints = run([sys.executable, "scripts/" + script, folder])
        if complaints:
            return complaints
        made, committed = contents(folder, names), contents(os.path.join(ROOT, place), names)
    return ["%s/%s is not what scripts/%s makes" % (place, name, script)
            for name in sorted(set(made) | set(committed)) if made.get(name) != committed.get(name)]


BUILD_FOLDER = re.compile(r"^\s*folder=\"?([^\s\"]+)|^BUILD = ROOT / \"([^\"]+)\"", re.MULTILINE)


def build_folder_complaints():
    """Programs of a second build elsewhere in the package: rosrun, which overlooks build/, asks which one is meant."""
    complaints = []
    for name in ("scripts/build", "scripts/test", "scripts/fuzz"):
        folders = [shell or python for shell, python in BUILD_FOLDER.findall(read(name))]
        complaints += ["%s: builds into %s, not below build/" % (name, folder) for folder in folders
                       if folder.split("/")[0] != "build"] if folders else ["%s: names no build folder" % name]
    return complaints


def main():
    need("shellcheck", "shellcheck")
    need("pyflakes3", "pyflakes3")
    names = files(("scripts", ".ci", "test/style"), ("",))
    names += [name for name in files(("benchmark",), ("",)) if "." not in name.split("/")[-1]]
    names = [name for name in names if "__pycache__" not in name and not name.endswith(".txt")]
    python = [name for name in names if name.endswith(".py") or "python" in read(name).split("\n")[0]]
    shell = [name for name in names if name not in python]
    complaints = [text for script in sorted(MADE) for text in made_file_complaints(script)]
    for name in python:
        try:
            compile(read(name), name, "exec")
        except SyntaxError as error:
            complaints.append("%s: %s" % (name, error))
    complaints += build_folder_complaints()
    complaints += run(["shellcheck", "-x"] + shell)
    complaints += run(["pyflakes3"] + python)
    finish(complaints, "%d scripts" % len(names))


main()
