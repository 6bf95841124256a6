"""`grid_path localization`: one worker and two write the same bytes, and evo's format is what it writes.

    check_trial.py GRID_PATH STUDY.yaml WORK_FOLDER
"""
import os
import shutil
import subprocess
import sys

SECONDS = 200
UNORDERED = {"runs.jsonl"}  # a line as each worker comes to its end


def files_of(folder):
    found = {}
    for parent, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(parent, name)
            with open(path, "rb") as content:
                data = content.read()
            if name in UNORDERED:
                data = b"\n".join(sorted(data.splitlines()))
            found[os.path.relpath(path, folder)] = data
    return found


def main():
    program, study, work = (os.path.abspath(argument) for argument in sys.argv[1:4])
    shutil.rmtree(work, ignore_errors=True)
    results = []
    for jobs in ("1", "2"):
        folder = os.path.join(work, jobs)
        os.makedirs(folder)
        subprocess.run([program, "localization", study, "--out", "out", "--jobs", jobs], cwd=folder, check=True,
                       timeout=SECONDS)
        results.append(files_of(os.path.join(folder, "out")))
    one, two = results
    assert sorted(one) == sorted(two), "files differ: %s" % (set(one) ^ set(two))
    differing = [name for name in one if one[name] != two[name]]
    assert not differing, "not the same with one worker and two: %s" % differing
    for wanted in ("report.html", "summary.yaml", "figures.csv", "tum/nominal_L5.txt"):
        assert one.get(wanted), "%s is missing or empty" % wanted
    assert b"standard_error" in one["summary.yaml"], "NEES has no standard error"
    for line in one["tum/nominal_L5.txt"].decode().splitlines():
        assert len([float(word) for word in line.split()]) == 8, line
    again = subprocess.run([program, "localization", study, "--out", "out"], cwd=os.path.join(work, "1"),
                           capture_output=True, text=True, timeout=SECONDS)
    assert again.returncode == 0 and "resumed=10" in again.stdout, again
    wrong = subprocess.run([program, "localization", os.path.join(work, "gone.yaml"), "--out", "out"], cwd=work,
                           capture_output=True, text=True, timeout=SECONDS)
    assert wrong.returncode == 2 and "gone.yaml" in wrong.stderr, wrong


main()
