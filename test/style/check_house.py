"""The house in numbers: how many public headers there are, how long functions and opening comments, how large classes of
the nodes, how small folders, and that no type has two definitions in one namespace.

    check_house.py --list     also prints the largest of each kind
    check_house.py --counts   instead: the size of src/ros; STYLE_ROOT=FOLDER of another checkout
"""
import collections
import os
import re
import subprocess
import sys

from common import PLANTED, ROOT, files, finish, lacking, read, version_of
from house_exceptions import HOT_LOOPS, LARGE_CLASSES, LONG_ESSAYS, SMALL_FOLDERS

# What is counted, and its limit. A limit is lowered in the commit that makes it possible, and never raised in one that
# breaks it.
LIMITS = {
    "public headers": 85,
    "functions of 20 lines and more, in a thousand": 50,
}
LONGEST_FUNCTION = 60  # lines
LARGEST_CLASS = 18     # members that are data, below NODES
LONGEST_ESSAY = 25     # lines of a header's opening comment
SMALLEST_FOLDER = 4    # files, with those of the folders below

CODE = ("include", "src")
NODES = "src/ros/"
FOLDERS = CODE + ("test", "benchmark", "examples")
TESTS_OF_NODES = ("test/ros", "test/foreign")
ENDINGS = (".h", ".cpp", ".py")
TYPES = ("class", "struct", "union", "enum", "typedef")


def tags():
    """Every definition that universal-ctags finds: a dict of its fields."""
    command = ["ctags", "--languages=C++", "--c++-kinds=fcsgutm", "--fields=+neKZ", "--fields-C++=+{properties}", "-L", "-", "-o", "-"]
    answer = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True,
                            input="\n".join(files(CODE, (".h", ".cpp"))))
    for line in answer.stdout.splitlines():
        name, file, rest = line.split("\t", 2)
        fields = rest.rsplit(';"\t', 1)[1].split("\t")
        tag = dict(field.split(":", 1) for field in fields[1:])
        tag.update(name=name, file=file, kind=fields[0].replace("kind:", ""))
        yield tag


def functions(found):
    """(lines, name with its class, place) of every function, longest first; comments inside count."""
    lengths = []
    for tag in found:
        if tag["kind"] == "function" and "end" in tag:
            kind, _, scope = tag.get("scope", "").partition(":")
            owner = scope.split("::")[-1] + "::" if kind in ("class", "struct") else ""
            lengths.append((int(tag["end"]) - int(tag["line"]) + 1, owner + tag["name"],
                            "%s:%s" % (tag["file"], tag["line"])))
    return sorted(lengths, reverse=True)


def types_twice(found):
    """Types that two files define in one namespace or class. Anonymous namespaces are one a file."""
    places = collections.defaultdict(set)
    for tag in found:
        if tag["kind"] in TYPES and not tag["name"].startswith("__anon"):
            scope = tag.get("scope", "").split(":", 1)[-1]
            places["%s::%s" % (scope, tag["name"])].add(tag["file"])
    return {name: sorted(where) for name, where in places.items() if len(where) > 1}


def classes(found):
    """(members that are data, name, file) of every class and struct of the nodes, largest first."""
    members = collections.Counter()
    for tag in found:
        if tag["kind"] == "member" and tag["file"].startswith(NODES) and "static" not in tag.get("properties", ""):
            scope = re.sub(r"__anon\w+", "", tag.get("scope", "")).split(":", 1)[-1]
            members["::".join(part for part in scope.split("::")[1:] if part not in ("", "nodes")), tag["file"]] += 1
    return sorted(((count, name, file) for (name, file), count in members.items()), reverse=True)


def is_options(name):
    """A line an option, each with its description: as long as what is offered."""
    return name.endswith("Options")


def essays():
    """(lines of the opening comment, header), longest first."""
    lengths = []
    for name in files(CODE, (".h",)):
        lines = read(name).splitlines()
        first = next((i for i, line in enumerate(lines) if not line.startswith("//")), len(lines))
        lengths.append((first, name))
    return sorted(lengths, reverse=True)


def folder_sizes():
    """(files of the folder and below it, folder), smallest first, of those that hold a file themselves."""
    names = files(FOLDERS, ("",))
    below = collections.Counter()
    for name in names:
        folder = os.path.dirname(name)
        while folder:
            below[folder] += 1
            folder = os.path.dirname(folder)
    return sorted((below[folder], folder) for folder in {os.path.dirname(name) for name in names})


def over_limit(what, unit, limit, found, allowed):
    """What is above the limit and not among the exceptions, or above what it was allowed there, and exceptions that are
    none any more. `found`: (size, name, place)."""
    complaints = ["%s: %s has %d %s, more than %d" % (place, name, size, unit, allowed.get(name, limit))
                  for size, name, place in found if size > allowed.get(name, limit)]
    if not PLANTED:
        above = {name for size, name, _ in found if size > limit}
        complaints += ["%s is no %s above %d %s: strike it from house_exceptions.py" % (name, what, limit, unit)
                       for name in sorted(set(allowed) - above)]
    return complaints


def small_folders(sizes):
    complaints = ["%s: %d files, fewer than %d: a folder so small has its reason in house_exceptions.py" %
                  (name, size, SMALLEST_FOLDER) for size, name in sizes
                  if size < SMALLEST_FOLDER and name not in SMALL_FOLDERS]
    if not PLANTED:
        small = {name for size, name in sizes if size < SMALLEST_FOLDER}
        complaints += ["%s is no folder below %d files: strike it from house_exceptions.py" % (name, SMALLEST_FOLDER)
                       for name in sorted(set(SMALL_FOLDERS) - small)]
    return complaints


def counts(found):
    """The size of the nodes, a line each."""
    def lines(names):
        return sum(len(read(name).splitlines()) for name in names)

    sources = files((NODES,), (".h", ".cpp"))
    guard = [name for name in sources if name.startswith(NODES + "guard/")]
    tests = files(TESTS_OF_NODES, ENDINGS + (".test",))
    of_guard = [name for name in tests if name.startswith("test/ros/guard/")]
    text = "".join(map(read, sources))
    large = [(count, name) for count, name, _ in classes(found) if not is_options(name)]
    return [
        "lines of src/ros: %d in %d files; without guard: %d" % (lines(sources), len(sources), lines(sources) - lines(guard)),
        "lines of its tests: %d in %d files; without guard's: %d" % (lines(tests), len(tests), lines(tests) - lines(of_guard)),
        "classes with more than 15 members: %d; with more than %d: %d" % (
            sum(1 for count, _ in large if count > 15), LARGEST_CLASS, sum(1 for count, _ in large if count > LARGEST_CLASS)),
        "longest member list: %d of %s" % large[0],
        "catch: %d, of them catch (...): %d, std::bad_alloc: %d" % tuple(
            len(re.findall(r"\bcatch \(" + what, text)) for what in ("", r"\.\.\.", r"const std::bad_alloc")),
    ]


def main():
    if "Universal Ctags" not in (version_of("ctags") or ""):
        lacking("no universal-ctags: apt-get install universal-ctags")
    found = list(tags())
    if "--counts" in sys.argv:
        print("\n".join(counts(found)))
        return
    lengths, large, openings, folders = functions(found), classes(found), essays(), folder_sizes()
    long_ones = sum(1 for length, _, _ in lengths if length >= 20)
    totals = {
        "public headers": (len(files(("include",), (".h",))), ""),
        "functions of 20 lines and more, in a thousand":
            (-(-1000 * long_ones // max(len(lengths), 1)), "%d of %d" % (long_ones, len(lengths))),
    }
    complaints = ["%s: %d, more than %d: %s" % (what, count, LIMITS[what], where)
                  for what, (count, where) in totals.items() if count > LIMITS[what]]
    complaints += over_limit("function", "lines", LONGEST_FUNCTION, lengths, dict.fromkeys(HOT_LOOPS, sys.maxsize))
    complaints += over_limit("class", "members", LARGEST_CLASS, [row for row in large if not is_options(row[1])],
                             LARGE_CLASSES)
    complaints += over_limit("opening comment", "lines", LONGEST_ESSAY,
                             [(length, name, name + ":1") for length, name in openings], LONG_ESSAYS)
    complaints += small_folders(folders)
    twice = types_twice(found)
    complaints += ["%s is defined in %s" % (name, " and in ".join(where))
                   for name, where in sorted(twice.items())]
    if "--list" in sys.argv:
        for title, rows in (("functions", lengths), ("classes of the nodes", large), ("opening comments", openings),
                            ("folders", folders)):
            print("\n".join([title] + ["  %d %s" % (row[0], " ".join(row[1:])) for row in rows[:12]]))
    report = ["%s: %d (limit %d)" % (what, count, LIMITS[what]) for what, (count, _) in totals.items()]
    report += ["functions above %d lines: %d" % (LONGEST_FUNCTION, len(HOT_LOOPS)),
               "classes of the nodes above %d members: %d" % (LARGEST_CLASS, len(LARGE_CLASSES)),
               "opening comments above %d lines: %d" % (LONGEST_ESSAY, len(LONG_ESSAYS)),
               "folders below %d files: %d" % (SMALLEST_FOLDER, len(SMALL_FOLDERS)),
               "types with two definitions: %d" % len(twice)]
    finish(complaints, "%d functions (%s)" % (len(lengths), "; ".join(report)))


main()
