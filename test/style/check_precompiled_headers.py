"""GCC uses each precompiled header for every source that is compiled with one. It rejects a header, and parses
all of it again, where the options differ: the warning of -Winvalid-pch is one line in a long build.

    check_precompiled_headers.py BUILD   BUILD/compile_commands.json has the options; BUILD is built, with the tests
"""
import concurrent.futures
import os
import re
import shlex
import subprocess
import sys

from common import compilations, finish


def header_of(words):
    """The precompiled header that a compilation asks for, or None."""
    asked = [words[i + 1] for i, word in enumerate(words[:-1]) if word == "-include"]
    return next((header for header in asked if os.path.basename(header) == "cmake_pch.hxx"), None)


def asks(build):
    """One compilation of each kind that has a precompiled header: (source, words before the output, folder)."""
    kinds = {}
    for entry in compilations(build):
        words = [word for word in shlex.split(entry["command"]) if "ccache" not in word]
        header = header_of(words)
        if header and not re.search(r"/cmake_pch\.hxx(\.cxx)?$", entry["file"]):
            words = words[:words.index("-o")]
            kind = header, frozenset(word for word in words if "/" not in word)  # not the folders of includes
            kinds.setdefault(kind, (entry["file"], words, entry["directory"]))
    return list(kinds.values())


def complaint_of(ask):
    """What the compiler says against the header, or nothing. With -H it marks with '!' what it uses."""
    source, words, folder = ask
    answer = subprocess.run(words + ["-H", "-fsyntax-only", "-x", "c++", "/dev/null"], cwd=folder,
                            capture_output=True, text=True, check=False)
    header = header_of(words)
    if "! %s.gch" % header in answer.stderr.splitlines():
        return []
    if not os.path.exists(header + ".gch"):
        return ["%s: its precompiled header is not built: scripts/build tests" % source]
    reason = re.search(r"(?:not used because|created and used with) .*", answer.stderr)
    return ["%s: %s.gch: %s" % (source, header, reason.group(0) if reason else answer.stderr)]


def main():
    kinds = asks(sys.argv[1] if len(sys.argv) > 1 else "build")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        complaints = [text for found in pool.map(complaint_of, kinds) for text in found]
    finish(complaints, "%d kinds of compilations with a precompiled header" % len(kinds))


main()
