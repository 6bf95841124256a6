"""Doxygen makes API pages of the public headers without a warning, each with the text that the header opens with.

    check_api_pages.py FOLDER       the pages go there
"""
import html
import os
import re
import subprocess
import sys
import tempfile

from common import ROOT, files, finish, lacking, read, version_of

DOC = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "doc")


def run_doxygen(folder):
    """Its warnings."""
    with open(os.path.join(DOC, "Doxyfile"), encoding="utf-8") as file:
        settings = file.read()
    settings += '\nOUTPUT_DIRECTORY = "%s"\n' % folder
    settings += 'INPUT_FILTER = "%s %s"\n' % (sys.executable, os.path.join(DOC, "doxygen_filter.py"))
    answer = subprocess.run(["doxygen", "-"], input=settings, cwd=ROOT, check=False,
                            capture_output=True, text=True)
    lines = answer.stderr.splitlines()
    return lines if answer.returncode == 0 else lines + ["doxygen ends with %d" % answer.returncode]


def words_of(text):
    return re.findall(r"[a-z]+", text.lower())


def main():
    version = re.match(r"(\d+)\.(\d+)", version_of("doxygen") or "0.0")
    if tuple(map(int, version.groups())) < (1, 9):  # older ones know fewer settings
        lacking("no doxygen 1.9: apt-get install doxygen")
    with tempfile.TemporaryDirectory() as temporary:
        folder = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else temporary
        os.makedirs(folder, exist_ok=True)
        complaints = run_doxygen(folder)
        with open(os.path.join(folder, "html", "files.html"), encoding="utf-8") as file:
            rows = dict(re.findall(r'el" href="[^"]*"[^>]*>([\w.]+)</a></td><td class="desc">(.*?)</td>', file.read(), re.S))
    names = files(("include",), (".h",))
    for name in names:
        essay = words_of(read(name).splitlines()[0])[:3]
        row = html.unescape(re.sub(r"<[^>]*>", "", rows.get(os.path.basename(name), "")))
        if words_of(row)[:len(essay)] != essay:
            complaints.append("%s: its page does not open with '%s'" % (name, " ".join(essay)))
    finish(complaints, "%d headers" % len(names))


main()
