"""What the style checks share."""
import os
import subprocess
import sys

# The checks are themselves checked on other folders (check_checks.py).
ROOT = os.environ.get("STYLE_ROOT") or os.path.abspath(
    os.path.join(os.path.dirname(__file__), "..", ".."))
PLANTED = "STYLE_ROOT" in os.environ
SKIPPED = 77


def files(folders, endings):
    """Names, relative to the root, of the files below `folders` with one of the endings, sorted."""
    found = []
    for folder in folders:
        for path, _, names in os.walk(os.path.join(ROOT, folder)):
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


def skip(reason):
    print("skipped: " + reason)
    sys.exit(SKIPPED)


def finish(complaints, checked):
    """Prints the complaints and ends the program. A check of nothing fails: it has lost its files."""
    for complaint in complaints:
        print(complaint)
    print("%s checked, %d complaints" % (checked, len(complaints)))
    sys.exit(1 if complaints or not checked or checked.startswith("0 ") else 0)
