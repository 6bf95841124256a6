"""scripts/fuzz tells what it found and sums its runs: a target that ends, one that crashes and one that hangs, by a program
that prints what libFuzzer prints; and which targets have not had enough."""
import contextlib
import importlib.machinery
import importlib.util
import io
import os
import pathlib
import resource
import sys
import tempfile
import time
from unittest import mock

from common import ROOT, finish

# Targets: "crash" leaves an input and ends with a code, "loud" prints 200 MB, "parent" leaves a child that keeps its output, "hang" never ends, "killed" is ended by others, "slow" has an input that takes 12 s, "late" one that took too long once, "stuck" one that always does, "asleep" one that waits for ever, "well" runs as
# often as it is allowed.
PROGRAM = r"""#!/bin/sh
case " $* " in *" --list "*) echo "TARGETS"; exit 0 ;; esac
for word; do
  case $word in
    --target=*) target=${word#--target=} ;;
    --write-seeds=*) echo seed > "${word#--write-seeds=}/seed0"; exit 0 ;;
    -artifact_prefix=*) prefix=${word#-artifact_prefix=} ;;
    -runs=*) runs=${word#-runs=} ;;
    -report_slow_units=*) reported=${word#-report_slow_units=} ;;
    -entropic=0) edges=9 ;;
  esac
done
if [ -z "$prefix" ]; then
  [ $target != asleep ] || exec sleep 100
  [ $target != stuck ] || python3 -c 'while __import__("time").process_time() < 1.5: pass'
  exit 0
fi
echo "#2	INITED cov: 5 ft: 6 corp: 1/1b exec/s: 0 rss: 30Mb" >&2
[ $target != hang ] || exec sleep 100
[ $target != killed ] || kill -TERM $$
[ $target != parent ] || { sleep 20 & exit 0; }
[ $target != loud ] || yes "$(printf %01000d 0)" | head -n 200000 >&2
[ $target != crash ] || { echo x > "${prefix}crash-1"; exit 77; }
[ $target != slow ] || [ ${reported:-10} -gt 12 ] || echo x > "${prefix}slow-unit-1"
case $target in asleep|late|stuck) echo x > "${prefix}timeout-1"; exit 70 ;; esac
half=$((runs / 2))
echo "#3	NEW    cov: ${edges:-7} ft: 8 corp: 2/2b lim: 4 exec/s: 0 rss: 30Mb L: 2/2 MS: 1 CopyPart-" >&2
echo "#9	REDUCE cov: ${edges:-7} ft: 8 corp: 2/2b lim: 4 exec/s: 0 rss: 30Mb L: 1/1 MS: 1 EraseBytes-" >&2
echo "stat::number_of_executed_units: $half" >&2
"""


def load(folder):
    """scripts/fuzz with that program, whose inputs may take a second."""
    path = os.path.join(ROOT, "scripts/fuzz")
    loader = importlib.machinery.SourceFileLoader("fuzz", path)
    fuzz = importlib.util.module_from_spec(importlib.util.spec_from_loader("fuzz", loader))
    loader.exec_module(fuzz)
    fuzz.PROGRAMS, fuzz.TABLE = folder / "programs", folder / "table.txt"
    fuzz.SPARE_SECONDS, fuzz.LAST_WORDS = 1, 0.5
    fuzz.PROGRAMS.mkdir()
    for name, targets in (("bad", "crash hang killed parent"), ("good", "asleep late loud slow stuck well")):
        program = fuzz.PROGRAMS / name
        program.write_text(PROGRAM.replace("TARGETS", targets), encoding="utf-8")
        program.chmod(0o755)
    return fuzz


def told(fuzz, *arguments):
    """Exit code, and {target: the numbers of its row} of the last table."""
    drawn = io.StringIO()
    with mock.patch.object(sys, "argv", ["fuzz", "--no-build", *arguments]), contextlib.redirect_stdout(drawn):
        code = fuzz.main()
    last = drawn.getvalue().split("all runs", 1)[1]
    rows = (line.split() for line in last.splitlines()[1:] if not line.startswith("FOUND"))
    return code, {row[0]: [float(cell.replace(",", "")) for cell in row[1:]] for row in rows}, drawn.getvalue()


def complaints_of_runs(fuzz, corpus):
    arguments = ("--corpus", str(corpus), "--seconds", "8", "--executions", "800")
    code, rows, text = told(fuzz, *arguments, "well")
    if code != 0 or rows["well"][0] != 600 or rows["well"][2:] != [9, 403, 0]:
        yield f"a half of 800 and one of 400 are 600, with 9 edges since the third of the second: {code} {rows}"
    code, rows, text = told(fuzz, *arguments, "well")
    if rows["well"][0] != 1200 or rows["well"][3] != 403:
        yield f"what another run covered again is no growth: {rows}"
    code, rows, text = told(fuzz, "--corpus", str(corpus), "--seconds", "1", "--executions", "2", "well")
    if rows["well"][0] != 1201 or rows["well"][2:4] != [9, 403]:
        yield f"a run that covered less takes edges away: {rows}"
    code, rows, text = told(fuzz, *arguments, "crash")
    if code != 1 or rows["crash"][4] != 1 or "crash-1" not in text:
        yield f"a crash is not told: {code} {text}"
    code, rows, text = told(fuzz, "--corpus", str(corpus), "--seconds", "1", "hang")
    if code != 1 or rows["hang"][4] != 1 or "last.log" not in text:
        yield f"a program that hangs is not ended and told: {code} {text}"
    with contextlib.redirect_stderr(io.StringIO()) as errors:
        code, rows, text = told(fuzz, *arguments, "killed")
    if code != 1 or rows["killed"][4] != 0 or "killed was killed by others" not in errors.getvalue():
        yield f"that others kill a program is told as a finding, as a success or not at all: {code} {text} {errors.getvalue()}"
    begin = time.monotonic()
    code, rows, text = told(fuzz, *arguments, "parent")
    if code != 1 or rows["parent"][4] != 1 or "last.log" not in text or time.monotonic() - begin > 15:
        yield f"a child that keeps a program's output holds the run up, or nothing is told: {code} {text}"
    code, rows, text = told(fuzz, *arguments, "slow")
    if code != 0 or rows["slow"][0] != 600 or rows["slow"][4] != 0:
        yield f"an input that takes no longer than it may is told as a finding, or ends the run: {code} {text}"


def complaints_of_waiting(fuzz, corpus):
    arguments = ("--corpus", str(corpus), "--seconds", "8", "--executions", "800")
    with contextlib.redirect_stderr(io.StringIO()) as errors:
        code, rows, text = told(fuzz, *arguments, "late")
    if code != 0 or rows["late"][4] != 0 or "kept waiting" not in errors.getvalue():
        yield f"an input for which others took the processor is a finding, or not told: {code} {text} {errors.getvalue()}"
    with mock.patch.multiple(fuzz, MOST_SECONDS=1, SPARE_SECONDS=100):
        code, rows, text = told(fuzz, *arguments, "stuck")
    if code != 1 or rows["stuck"][4] != 1 or "timeout-1" not in text:
        yield f"an input that takes too long is no finding: {code} {text}"
    with mock.patch.object(fuzz, "MOST_SECONDS", 1):
        code, rows, text = told(fuzz, *arguments, "asleep")
    if code != 1 or rows["asleep"][4] != 1 or "timeout-1" not in text:
        yield f"an input that waits for ever, without the processor, is no finding: {code} {text}"


def complaints_of_memory(fuzz, corpus):
    code, rows, _ = told(fuzz, "--corpus", str(corpus), "--seconds", "8", "--executions", "800", "loud")
    megabytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    if code != 0 or rows["loud"][0] != 600 or rows["loud"][2:4] != [9, 403]:
        yield f"what a library prints hides what libFuzzer does: {code} {rows}"
    if megabytes > 150:
        yield f"it keeps all that a program prints: {megabytes:.0f} MB, which libFuzzer takes for the next program's memory"


def complaints_of_lengths(fuzz, corpus):
    corpus.mkdir()
    for length, limit in ((0, 1024), (1024, 1024), (3000, 3000), (10000, 4096)):
        (corpus / f"seed{length}").write_bytes(bytes(length))
        if fuzz.plain_guidance(corpus)[-1] != f"-max_len={limit}":
            yield f"beside a seed of {length} bytes inputs are {fuzz.plain_guidance(corpus)[-1]}"


def complaints_of_targets(fuzz, corpus):
    runs = fuzz.kept(corpus)
    if list(fuzz.least_first({"well": 1, "crash": 1, "new": 1}, runs))[0] != "new":
        yield "the target without a run is not the first"
    if fuzz.unfinished({"well": 1201}, runs) or fuzz.unfinished({"well": 1202}, runs) != {"well": 1}:
        yield "1201 executions are not told from 1202, of which one is left"
    long = {"well": runs["well"]._replace(cpu=fuzz.ENOUGH_CPU_SECONDS)}
    if fuzz.unfinished({"well": 10**7}, long):
        yield "an hour of the processor is not enough"
    if not fuzz.unfinished({"world_tree": 1202}, {"world_tree": long["well"]}):
        yield "an hour of the processor is enough for world_tree, which is to do its executions"
    sources = "".join(path.read_text(encoding="utf-8") for path in pathlib.Path(ROOT, "test/fuzz").glob("*/*.cpp"))
    for target in fuzz.ENOUGH_EXECUTIONS:
        if f"FUZZ_TARGET({target}," not in sources:
            yield f"there is no target {target}"


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        fuzz = load(folder)
        complaints = [*complaints_of_memory(fuzz, folder / "loud"), *complaints_of_runs(fuzz, folder / "corpus"),
                      *complaints_of_waiting(fuzz, folder / "waiting"), *complaints_of_lengths(fuzz, folder / "lengths"),
                      *complaints_of_targets(fuzz, folder / "corpus")]
    finish(complaints, "18 rules of scripts/fuzz")


if __name__ == "__main__":
    main()
