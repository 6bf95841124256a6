"""Every C++ file is as clang-format 14 (Debian 12's) leaves it; other versions differ in details."""
import subprocess

from common import ROOT, files, finish, lacking, version_of

TOOLS = ("clang-format-14", "clang-format")


def main():
    tool = next((t for t in TOOLS if "version 14." in (version_of(t) or "")), None)
    if tool is None:
        lacking("no clang-format 14: apt-get install clang-format-14")
    names = files(("include", "src", "test", "examples"), (".h", ".cpp"))
    answer = subprocess.run([tool, "--dry-run", "-Werror"] + names, cwd=ROOT, capture_output=True,
                            text=True, check=False)
    wrong = sorted({line.split(":")[0] for line in answer.stderr.splitlines()
                    if "-Wclang-format-violations" in line})
    complaints = ["%s: not formatted: %s -i %s" % (name, tool, name) for name in wrong]
    if answer.returncode != 0 and not complaints:
        complaints = [answer.stderr]
    finish(complaints, "%d files" % len(names))


main()
