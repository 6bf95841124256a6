"""Opens a report of `grid_path study` in headless Chromium and uses it as a person would.

    check_report.py GRID_PATH CHROMIUM WORK_FOLDER

Sorts a table in both orders, changes picture, weights, query and paths, and fails where one of them does
not do what it says, or where anything is written to the console or asked of a network.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

STUDY = """
title: A report for the browser
maps: [site.map]
planners: [dijkstra, a_star]
heuristics: [octile, euclidean]
kernels: [1, 2]
weights: [[1, 50, 100], [1, 2, 100]]
queries: {pairs: [[[0, 0], [5, 3]], [[5, 3], [0, 1]]]}
repeats: 1
"""
MAP = "type octile\nheight 4\nwidth 6\nmap\n......\n......\n@@@@..\n@@@@..\n"

# Before the page's own script: everything that complains is kept.
LISTEN = """<script>
const complaints = [];
for (const kind of ["error", "warn", "log", "info"]) console[kind] = (...words) => complaints.push(words.join(" "));
addEventListener("error", event => complaints.push(event.message));
</script>"""

USE = """<script>
const result = {};
const column = (table, n) => [...table.tBodies[0].rows].map(row => Number(row.cells[n].dataset.n));
const press = element => { element.focus(); element.click(); };
const table = document.getElementById("table-effort");
const head = [...table.tHead.rows[0].cells].findIndex(cell => cell.textContent === "cells expanded");
const button = table.tHead.rows[0].cells[head].firstElementChild;
press(button);
result.up = column(table, head);
result.upSays = table.tHead.rows[0].cells[head].getAttribute("aria-sort");
press(button);
result.down = column(table, head);
result.downSays = table.tHead.rows[0].cells[head].getAttribute("aria-sort");
result.focusable = document.activeElement === button;

const map = document.getElementById("map");
const change = (element, set) => { set(element); element.dispatchEvent(new Event("change", {bubbles: true})); };
const image = () => map.querySelector("image").getAttribute("href");
const lines = () => map.querySelectorAll("polyline").length;
const first = image();
result.lines = lines();
change(document.querySelectorAll("input[name=picture]")[1], input => { input.checked = true; });
result.otherPicture = image() !== first;
change(document.querySelectorAll("input[name=variant]")[0], input => { input.checked = false; });
result.linesWithoutOne = lines();
const query = document.getElementById("pick-query");
result.queries = query.options.length;
change(query, select => { select.selectedIndex = 1; });
result.linesOfOneQuery = lines();
result.commands = [...document.querySelectorAll("#results code")].map(code => code.textContent);
const weights = document.getElementById("pick-weights");
change(weights, select => { select.selectedIndex = 1; });
result.label = map.getAttribute("aria-label");
result.widest = document.documentElement.scrollWidth - document.documentElement.clientWidth;
result.complaints = complaints;
const out = document.createElement("pre");
out.id = "result";
out.textContent = JSON.stringify(result);
document.body.append(out);
</script>"""


def make_report(grid_path, folder):
    for name, text in (("study.yaml", STUDY), ("site.map", MAP)):
        with open(os.path.join(folder, name), "w") as out:
            out.write(text)
    subprocess.run([grid_path, "study", os.path.join(folder, "study.yaml"), "--out",
                    os.path.join(folder, "out")], check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(folder, "out", "report.html")) as report:
        return report.read()


def browse(chromium, folder, page, *options):
    command = [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
               "--disable-background-networking", "--disable-component-update", "--disable-sync",
               "--disable-dev-shm-usage", "--user-data-dir=" + os.path.join(folder, "profile"), *options,
               "file://" + page]
    return subprocess.run(command, check=True, timeout=90, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, universal_newlines=True).stdout


def complaints_of(result, grid_path):
    checks = [
        (result["up"] == sorted(result["up"]) and len(set(result["up"])) > 1, "does not sort upwards"),
        (result["upSays"] == "ascending", "does not say that it is sorted upwards"),
        (result["down"] == sorted(result["down"], reverse=True), "does not sort downwards"),
        (result["downSays"] == "descending", "does not say that it is sorted downwards"),
        (result["focusable"], "the head of a table cannot be reached with the keyboard"),
        (result["lines"] == 6, "does not draw three variants' paths for two queries"),
        (result["otherPicture"], "does not switch the picture"),
        (result["linesWithoutOne"] == 4, "does not hide a variant"),
        (result["queries"] == 3, "does not offer all queries and each"),
        (result["linesOfOneQuery"] == 2, "does not show one query alone"),
        (len(result["commands"]) == 2, "does not give the commands"),
        ("weights 1/2/100" in result["label"], "does not switch the weights"),
        (result["widest"] <= 0, "is wider than its window"),
        (not result["complaints"], "complains: %s" % result["complaints"]),
    ]
    complaints = [words for good, words in checks if not good]
    for command in result["commands"]:  # what the report says can be done
        words = command.split()
        assert words[:3] == ["rosrun", "grid_path_planner", "grid_path"], command
        if subprocess.run([grid_path] + words[3:], stdout=subprocess.DEVNULL).returncode != 0:
            complaints.append("gives a command that fails: " + command)
    return complaints


def main():
    grid_path, chromium, work = sys.argv[1:]
    os.makedirs(work, exist_ok=True)
    folder = tempfile.mkdtemp(dir=work)
    try:
        html = make_report(grid_path, folder)
        page = os.path.join(folder, "page.html")
        with open(page, "w") as out:
            out.write(html.replace("<head>", "<head>" + LISTEN, 1).replace("</body>", USE + "</body>", 1))
        complaints = []
        for window in ("1100,900", "390,800"):  # a screen, a phone
            dom = browse(chromium, folder, page, "--window-size=" + window, "--dump-dom")
            found = re.search(r'<pre id="result">(.*?)</pre>', dom, re.S)
            if not found:
                complaints.append("%s: the page's script ended early" % window)
                continue
            text = found.group(1).replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&")
            complaints += ["%s: %s" % (window, words) for words in complaints_of(json.loads(text), grid_path)]
    finally:
        shutil.rmtree(folder)
    for words in complaints:
        print("report " + words)
    print("report used in %s: %d complaints" % (os.path.basename(chromium), len(complaints)))
    sys.exit(1 if complaints else 0)


main()
