"""What the style checks share."""
import json
import os
import re
import shlex
import subprocess
import sys

# The checks are themselves checked on other folders (check_checks.py).
ROOT = os.environ.get("STYLE_ROOT") or os.path.abspath(
    os.path.join(os.path.dirname(__file__), "..", ".."))
PLANTED = "STYLE_ROOT" in os.environ
FLAG = re.compile(r"-(I|isystem|D|std=)")


def files(folders, endings):
    """Names, relative to the root, of the files below `folders` with one of the endings, sorted. What Python compiles them
    to, which comes while a program beside runs, is none."""
    found = []
    for folder in folders:
        for path, below, names in os.walk(os.path.join(ROOT, folder)):
            below[:] = [name for name in below if name != "__pycache__"]
            found += [os.path.relpath(os.path.join(path, name), ROOT)
                      for name in names if name.endswith(endings)]
    return sorted(found)


def read(name):
    with open(os.path.join(ROOT, name), encoding="utf-8") as file:
        return file.read()


def version_of(tool):
    """The first line of `tool --version`; None where there is no such tool."""
    try:
        answer = subprocess.run([tool, "--version"], capture_output=True, text=True, check=True)
    except FileNotFoundError:
        return None
    return answer.stdout.strip()


def lacking(sentence):
    """Ends the program of a check that lacks a tool: a check that is passed over finds nothing."""
    sys.exit("not checked: %s; scripts/install_dependencies --tests installs it" % sentence)


def need(tool, package):
    """Ends the program where there is no such tool."""
    if version_of(tool) is None:
        lacking("no %s: apt-get install %s" % (tool, package))


def compilations(build):
    """The entries of the build's compile_commands.json."""
    path = os.path.join(ROOT, build, "compile_commands.json")
    if not os.path.exists(path):
        sys.exit("not checked: no %s: scripts/build makes it" % path)
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def compiler_and_flags(build, more=()):
    """The compiler of the build, and all folders and definitions that any of its files gets, after `more`."""
    flags = {"-I" + ROOT: None, "-I" + os.path.join(ROOT, "src"): None}
    commands = [shlex.split(entry["command"]) for entry in compilations(build)]
    for words in commands:
        for i, word in enumerate(words):
            if FLAG.match(word):
                flags[" ".join(words[i:i + 2]) if word in ("-I", "-isystem", "-D") else word] = None
    compiler = next(word for word in commands[0] if "ccache" not in word)
    return compiler, [part for flag in flags for part in flag.split(" ", 1)]


def finish(complaints, checked):
    """Prints the complaints and ends the program. A check of nothing fails: it has lost its files."""
    for complaint in complaints:
        print(complaint)
    print("%s checked, %d complaints" % (checked, len(complaints)))
    sys.exit(1 if complaints or not checked or checked.startswith("0 ") else 0)
