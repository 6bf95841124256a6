"""README.md keeps up with the code: its table of launch arguments is made from launch/, and it names every
status, every topic type of ours and every script. (The tables of parameters are made by option_files.)

    check_readme.py --write    makes the table anew
"""
import os
import re
import sys
import xml.etree.ElementTree

from common import ROOT, files, finish, read


def row(*cells):
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def launch_table():
    rows = [row("launch file", "argument", "default", ""), "|---|---|---|---|"]
    for name in files(("launch",), (".launch",)):
        for argument in xml.etree.ElementTree.fromstring(read(name)).findall("arg"):
            default = argument.get("default")
            rows.append(row("`%s`" % os.path.basename(name), "`%s`" % argument.get("name"),
                            "required" if default is None else "`%s`" % default if default else "",
                            argument.get("doc", "")))
    return "\n".join(rows)


def with_table(text):
    def launch(match):
        return "%s\n%s\n<!-- end -->" % (match.group(1), launch_table())
    return re.sub(r"(<!-- launch files -->).*?<!-- end -->", launch, text, flags=re.S)


def promised_names():
    """What the README must name, and where that comes from."""
    for node in [name[len("src/nodes/"):-len(".cpp")] for name in files(("src/nodes",), (".cpp",))]:
        yield "<!-- parameters: %s -->" % node, "src/nodes"
    statuses = re.search(r"enum class Status \{(.*?)\}", read("include/grid_path_planner/base/status.h"), re.S)
    for status in statuses.group(1).replace(",", " ").split():
        yield "`%s`" % status, "status.h"
    for name in files(("msg", "srv", "action"), (".msg", ".srv", ".action")):
        stem, ending = os.path.splitext(os.path.basename(name))
        yield "grid_path_planner/" + stem + ("Action" if ending == ".action" else ""), name


def missing_paths(text):
    """Files that the README links to or calls."""
    for path in re.findall(r"\]\((?!http)([^)]+)\)", text) + re.findall(r"\./(scripts/\w+)", text):
        if not os.path.exists(os.path.join(ROOT, path)):
            yield path


def unknown_options(text):
    """Options of our scripts that are named but not in the script's own help."""
    for script, option in re.findall(r"\./(scripts/\w+) (--[\w-]+)", text):
        if option not in read(script):
            yield "%s %s" % (script, option)


def main():
    text = read("README.md")
    made = with_table(text)
    if "--write" in sys.argv:
        with open(os.path.join(ROOT, "README.md"), "w", encoding="utf-8") as file:
            file.write(made)
        text = made
    complaints = []
    if made != text:
        complaints.append("README.md: the table of launch files is out of date: test/style/check_readme.py --write")
    names = list(promised_names())
    complaints += ["README.md: %s of %s is missing" % pair for pair in names if pair[0] not in text]
    complaints += ["README.md: there is no %s" % path for path in missing_paths(text)]
    complaints += ["README.md: there is no %s" % option for option in unknown_options(text)]
    finish(complaints, "%d names" % len(names))


main()
