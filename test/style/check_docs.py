"""README.md and the pages of doc/ keep up with the code.

The table of launch arguments is made from launch/; option_files makes those of parameters. Some page names
every node, status, message type, script and dependency. doc/architecture.md names every folder of src/, and
no file that is not there. doc/nav2.md names nothing of ours that is not in the sources. Links resolve, to files and to headings, and every page can be reached from
README.md, which stays short.

    check_docs.py --write    makes the table anew
"""
import os
import re
import sys
import urllib.parse
import xml.etree.ElementTree

from common import ROOT, files, finish, read

README_LINES = 165
COMPARISON = "doc/nav2.md"
LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE_BLOCK = re.compile(r"^(?: {4,}[^\n]*\n|```.*?^```\n)", re.M | re.S)


def row(*cells):
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def launch_table():
    rows = [row("launch file", "argument", "default", ""), "|---|---|---|---|"]
    for name in files(("launch",), (".launch",)):
        for argument in xml.etree.ElementTree.fromstring(read(name)).findall("arg"):
            if argument.get("value") is not None:  # nobody can set it
                continue
            default = argument.get("default")
            rows.append(row("`%s`" % os.path.basename(name), "`%s`" % argument.get("name"),
                            "required" if default is None else "`%s`" % default if default else "",
                            argument.get("doc", "")))
    return "\n".join(rows)


def with_table(text):
    return re.sub(r"(<!-- launch files -->).*?<!-- end -->",
                  lambda match: "%s\n%s\n<!-- end -->" % (match.group(1), launch_table()), text, flags=re.S)


def promised_names():
    """What some page must name, and where that comes from."""
    for node in [name[len("src/nodes/"):-len(".cpp")] for name in files(("src/nodes",), (".cpp",)) if name.count("/") == 2]:
        yield "<!-- parameters: %s -->" % node, "src/nodes"
    if files(("launch",), (".launch",)):
        yield "<!-- launch files -->", "launch"
    statuses = re.search(r"enum class Status \{(.*?)\}", read("include/grid_path_planner/base/status.h"), re.S).group(1)
    for name in files(("action",), (".action",)):
        statuses += ",".join(re.findall(r"^string status\s*#(.*)", read(name), re.M))
    for status in sorted(set(re.findall(r"[A-Z_]+", statuses))):
        yield "`%s`" % status, "status.h or action/"
    for name in files(("msg", "srv", "action"), (".msg", ".srv", ".action")):
        stem, ending = os.path.splitext(os.path.basename(name))
        yield "grid_path_planner/" + stem + ("Action" if ending == ".action" else ""), name
    for name in files(("scripts",), ("",)):
        if re.fullmatch(r"scripts/\w+", name):
            yield name, "scripts"


def unexplained_dependencies():
    """Dependencies of package.xml without a reason in doc/dependencies.md."""
    text = read("doc/dependencies.md").lower()
    for element in xml.etree.ElementTree.fromstring(read("package.xml")):
        if not element.tag.endswith("depend"):
            continue
        # The distribution's name, or the project's: libboost-dev is Boost.
        name = element.text
        project = re.sub(r"^lib(?=[a-z])|-dev$|-turbo.*$|-program-options(-dev)?$", "", name)
        if name.lower() not in text and project.lower() not in text:
            yield "doc/dependencies.md: %s of package.xml is missing" % name


def anchors(text):
    """The anchors of a page's headings, as GitHub makes them."""
    found = set()
    for heading in re.findall(r"^#+ +(.*?)\s*$", CODE_BLOCK.sub("\n", text), re.M):
        heading = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        found.add(re.sub(r"[^\w\- ]", "", heading).replace(" ", "-"))
    return found


def linked(page, link):
    """The file that a link of a page leads to, relative to the root, and the anchor in it."""
    path, _, anchor = urllib.parse.unquote(link).partition("#")
    return os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page, anchor


def broken_links(page, text):
    for link in LINK.findall(text):
        if re.match(r"[a-z]+:", link):
            continue
        target, anchor = linked(page, link)
        if not os.path.exists(os.path.join(ROOT, target)):
            yield "%s: there is no %s" % (page, link)
        elif anchor and (not target.endswith(".md") or anchor not in anchors(read(target))):
            yield "%s: %s has no heading #%s" % (page, target, anchor)


def unreachable(pages):
    """Pages that no sequence of links leads to from README.md."""
    seen, waiting = set(), ["README.md"]
    while waiting:
        page = waiting.pop()
        if page in pages and page not in seen:
            seen.add(page)
            waiting += [linked(page, link)[0] for link in LINK.findall(pages[page])]
    return ["%s: no link leads here from README.md" % page for page in sorted(set(pages) - seen)]


def unknown_scripts(page, text):
    """Scripts, and options of scripts, that a page names and that do not exist."""
    for script in sorted(set(re.findall(r"(?<![\w/.-])(?:\./)?(scripts/\w+)(?![\w/.])", text))):
        if not os.path.exists(os.path.join(ROOT, script)):
            yield "%s: there is no %s" % (page, script)
    for script, option in re.findall(r"\./(scripts/\w+) (--?[\w-]+)", text):
        if os.path.exists(os.path.join(ROOT, script)) and option not in read(script):
            yield "%s: there is no %s %s" % (page, script, option)


def uninstalled_programs(page, text):
    """Programs of ROS that a page asks to type and that scripts/install_dependencies does not bring."""
    if not os.path.exists(os.path.join(ROOT, "scripts/install_dependencies")):
        return
    installed = read("scripts/install_dependencies")
    for program in sorted(set(re.findall(r"(?<![\w-])(ros(?:topic|service|node|param|bag|msg|srv)) +[a-z-]", text))):
        for package in ("python3-" + program, "ros-noetic-" + program):
            if package not in installed:
                yield "%s: %s is typed, but scripts/install_dependencies does not bring %s" % (page, program, package)


def wrong_places():
    """Files and folders that doc/architecture.md names and that do not exist (x stands for any name), and folders
    of src/ that it leaves out."""
    text = read("doc/architecture.md")
    code = ["/" + name for name in files(("include", "src", "test", "cmake", "benchmark", "doc", "srv", "action"), ("",))]
    for name in sorted(set(re.findall(r"`((?:\w+/)*\w+\.(?:h|cpp|cmake)|(?:\w+/)+)`", text))):
        if not re.match(r"x[._]", name.rsplit("/", 1)[-1]) and not any(
                "/" + name in path if name.endswith("/") else path.endswith("/" + name) for path in code):
            yield "doc/architecture.md: there is no %s" % name
    for folder in sorted({os.path.dirname(name) for name in files(("src",), (".cpp",))}):
        if "`%s/`" % folder[len("src/"):].rsplit("/", 1)[-1] not in text:
            yield "doc/architecture.md: %s is missing" % folder


def names_of_the_package():
    """What stands in the sources between quotes (options and their values, topics, services, planners, ...), and the
    names of nodes, launch files, scripts, messages, their fields and statuses."""
    names = set()
    for name in files(("src", "include"), (".h", ".cpp")):
        names |= set(re.findall(r'"~?([\w./]+)"', read(name)))
    for name in files(("msg", "srv", "action"), (".msg", ".srv", ".action")):
        names |= set(re.findall(r"^[\w/]+(?:\[\])? +(\w+)", read(name), re.M)) | set(re.findall(r"\b[A-Z_]{2,}\b", read(name)))
    names |= set(re.findall(r"\b[A-Z_]{3,}\b", read("include/grid_path_planner/base/status.h")))
    for name in files(("src/nodes", "launch", "scripts", "benchmark", "test/style"), ("",)):
        names |= {name, os.path.basename(name), os.path.splitext(os.path.basename(name))[0]}
    for name in files((".",), ("_plugins.xml",)):
        names |= set(re.findall(r'name="([\w/]+)"', read(name)))
    return names


def unknown_counterparts(page, text, names):
    """Rows of a page that compares features without a word on what is here, and names in backquotes on that side
    which are nowhere in the sources. `a: b` names an option and one of its values."""
    for theirs, ours in re.findall(r"^\| (?!\*\*|-)(.+?) \|(.*)\|$", text, re.M):
        if not ours.strip():
            yield "%s: what is here for '%s'?" % (page, theirs)
        for quoted in re.findall(r"`([^`]+)`", ours):
            for name in re.split(r": | ", quoted):
                if name.strip("~/-") not in names and not re.fullmatch(r"[\d.]+", name):
                    yield "%s: there is no `%s`, which stands for '%s'" % (page, name, theirs)


def main():
    pages = {name: read(name) for name in ["README.md"] + files(("doc",), (".md",))}
    made = {name: with_table(text) for name, text in pages.items()}
    if "--write" in sys.argv:
        for name in [name for name in pages if made[name] != pages[name]]:
            with open(os.path.join(ROOT, name), "w", encoding="utf-8") as file:
                file.write(made[name])
        pages = made
    complaints = ["%s: the table of launch files is out of date: test/style/check_docs.py --write" % name
                  for name in pages if made[name] != pages[name]]
    lines = pages["README.md"].count("\n")
    if lines > README_LINES:
        complaints.append("README.md: %d lines are more than %d" % (lines, README_LINES))
    complaints += unexplained_dependencies()
    complaints += unreachable(pages)
    complaints += wrong_places()
    if COMPARISON in pages:
        complaints += unknown_counterparts(COMPARISON, pages[COMPARISON], names_of_the_package())
    guides = dict(pages, **{name: read(name) for name in ("CONTRIBUTING.md", "maps/README.md", "benchmark/README.md")
                            if os.path.exists(os.path.join(ROOT, name))})
    everything = "\n".join(guides.values())
    names = list(promised_names())
    complaints += ["doc: no page names %s of %s" % pair for pair in names if pair[0] not in everything]
    for name, text in sorted(guides.items()):
        complaints += broken_links(name, text)
        complaints += unknown_scripts(name, text)
        complaints += uninstalled_programs(name, text)
    finish(complaints, "%d pages, %d names" % (len(guides), len(names)))


main()
