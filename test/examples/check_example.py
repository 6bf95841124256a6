"""An example ends with 0 and prints what its section of doc/examples.md shows.

    check_example.py PROGRAM

The section of `1_plan_on_a_file` is headed by it. Its indented blocks are a command, which says with what
arguments the example runs, and what it prints.
"""
import difflib
import os
import re
import subprocess
import sys
import tempfile

PAGE = "doc/examples.md"
BLOCK = re.compile(r"(?:^    .*\n|^\n(?=    ))+", re.M)


def section_of(example):
    """(command, output) that the page shows."""
    with open(PAGE, encoding="utf-8") as file:
        sections = re.split(r"^## %s$" % example, file.read(), flags=re.M)
    if len(sections) != 2:
        sys.exit("%s has no section on %s" % (PAGE, example))
    blocks = [re.sub(r"^    ", "", block, flags=re.M).strip("\n") + "\n"
              for block in BLOCK.findall(sections[1].split("\n## ")[0])]
    if len(blocks) != 2:
        sys.exit("%s: the section on %s shows a command and its output, and no more" % (PAGE, example))
    return blocks


def main():
    program = os.path.abspath(sys.argv[1])
    command, expected = section_of(os.path.basename(program))
    words = command.split()
    arguments = [os.path.abspath(word) if os.path.exists(word) else word
                 for word in words[words.index(os.path.basename(program)) + 1:]]
    with tempfile.TemporaryDirectory() as folder:
        answer = subprocess.run([program] + arguments, cwd=folder, capture_output=True, text=True,
                                timeout=60, check=False)
    printed = "\n".join(line.rstrip() for line in answer.stdout.rstrip().splitlines()) + "\n"
    sys.stdout.writelines(difflib.unified_diff(expected.splitlines(True), printed.splitlines(True), PAGE, program))
    sys.stderr.write(answer.stderr)
    print("exit code %d" % answer.returncode)
    sys.exit(0 if answer.returncode == 0 and printed == expected else 1)


main()
