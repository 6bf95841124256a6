"""Another package can include every public header, alone and first.

A public header includes public headers only. It is complete: a source file of its name includes it before
all others, or it is compiled here by itself, without src/ among the folders of includes.

    check_headers.py BUILD [ROOM...]   BUILD/compile_commands.json says where the libraries are; the headers of
                                       ROOM, whose libraries may be absent, are not compiled
"""
import os
import re
import subprocess
import sys
import tempfile

from common import ROOT, compiler_and_flags, files, finish, read

PACKAGE = "grid_path_planner/"
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]', re.M)


def private_includes(name, public):
    """Includes of what another package does not have. Those of messages are generated."""
    for quote, header in INCLUDE.findall(read(name)):
        generated = re.fullmatch(PACKAGE + r"[A-Z]\w*\.h", header)
        own = quote == '"' or header.startswith(PACKAGE) or os.path.exists(os.path.join(ROOT, "src", header))
        if own and header not in public and not generated:
            yield "%s: includes '%s', which is no public header" % (name, header)


def first_includes():
    """The header that each source file includes first."""
    found = (INCLUDE.search(read(name)) for name in files(("src",), (".cpp",)))
    return {match.group(2) for match in found if match}


def compile_alone(headers, compiler, flags):
    """What the compiler says where each of the headers is all that a file includes."""
    with tempfile.TemporaryDirectory() as folder:
        sources = []
        for header in headers:
            sources.append(os.path.join(folder, header.replace("/", "_") + ".cpp"))
            with open(sources[-1], "w", encoding="utf-8") as file:
                file.write('#include "%s"\n' % header)
        answer = subprocess.run([compiler, "-fsyntax-only"] + flags + sources, cwd=ROOT,
                                capture_output=True, text=True, check=False)
    if answer.returncode == 0:
        return []
    return [line for line in answer.stderr.splitlines() if " error: " in line] or [answer.stderr]


def main():
    names = files(("include",), (".h",))
    public = {name[len("include/"):] for name in names}
    complaints = [text for name in names for text in private_includes(name, public)]
    absent = tuple(PACKAGE + room + "/" for room in sys.argv[2:])
    alone = sorted(header for header in public - first_includes() if not header.startswith(absent))
    compiler, flags = compiler_and_flags(sys.argv[1] if len(sys.argv) > 1 else "build")
    flags = [flag for flag in flags if not re.match(r"-I%s/(src|test)\b" % re.escape(ROOT), flag)]
    complaints += compile_alone(alone, compiler, flags)
    finish(complaints, "%d headers, %d of them by compiling," % (len(names), len(alone)))


main()
