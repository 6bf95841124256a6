"""The examples in the headers' essays compile.

An essay is the comment that a header opens with. In it every line indented by three spaces belongs to
an example or a table; a paragraph of them that has a statement is C++. All such paragraphs of an
essay are the body of one function, in the namespace of the header, after the declarations that
example_context.py has for the header.

    check_examples.py BUILD [ABSENT...]
        BUILD/compile_commands.json says where the headers are; ABSENT are folders of src/ that are not built,
        whose examples are not compiled: the libraries that they need may be absent too
    check_examples.py --list        prints the examples, and compiles nothing
"""
import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile

from common import PLANTED, ROOT, compiler_and_flags, files, finish, read
from example_context import COMMON, CONTEXT

EXAMPLE = re.compile(r"//   (.*)")
CALL = re.compile(r"\w\([^)]*\)\s*(//.*)?$")
OWN_SCOPE = re.compile(r"template <|int main\(")
ELLIPSIS = re.compile(r"^[^/]*\.\.\.")
NAMESPACE = re.compile(r"^namespace (grid_path_planner\b[\w:]*) \{", re.MULTILINE)
INCLUDE = re.compile(r"^\s*(#include .*)$", re.MULTILINE)


def paragraphs(text):
    """(number of the first line, lines) of every indented paragraph of a header's essay."""
    found, open_one = [], None
    for number, line in enumerate(text.splitlines(), 1):
        if not line.startswith("//"):
            break
        match = EXAMPLE.match(line)
        if not match:
            open_one = None
            continue
        if open_one is None:
            open_one = []
            found.append((number, open_one))
        open_one.append(match.group(1))
    return found


def is_code(lines):
    return any(line.split("//")[0].rstrip().endswith(";") for line in lines)


def complaints_of(name, lines, number):
    """What a reader would stumble over and a compiler not."""
    for offset, line in enumerate(lines):
        if is_code(lines) and ELLIPSIS.search(line):
            yield "%s:%d: '...' is no code: say it in a comment" % (name, number + offset)
        if not is_code(lines) and CALL.search(line):
            yield "%s:%d: an example without a statement: where is its ';'?" % (name, number + offset)


def namespace_of(text):
    """The namespace of a header's own: where it has several, the last that it opens."""
    return NAMESPACE.findall(text)[-1]


def has_ros(name):
    return re.search(r"/(ros|nodes|tools|command_line)/", name) is not None


def context_of(name):
    keys = [key for key in CONTEXT if ("/" + name).endswith("/" + key)]
    return max(keys, key=len) if keys else None


def example(name, namespace, code, others=()):
    """The C++ of one header's example; errors name the header's own lines. It sees the names of the
    namespaces `others`, as a reader does who knows where they come from."""
    scope = "example_of_" + re.sub(r"\W", "_", name)
    body = "".join('#line %d "%s"\n%s\n' % (number, name, "\n".join(lines)) for number, lines in code)
    if not OWN_SCOPE.match(code[0][1][0]):
        body = "auto example() {\n%s}\n" % body
    declarations = INCLUDE.sub("", CONTEXT.get(context_of(name), ""))
    declared = '#line 1 "context of %s"\n%s' % (name, declarations)
    seen = "".join("using namespace %s;\n" % other for other in others if other != namespace)
    return "namespace %s::%s {\n%s%s\n%s\n%s}\n" % (namespace, scope, seen, COMMON, declared, body)


def translation_unit(examples, others):
    includes = ['#include "%s"' % re.sub("^(include|src)/", "", name) for name in sorted(examples)]
    includes += [line for name in examples
                 for line in INCLUDE.findall(CONTEXT.get(context_of(name), ""))]
    return "\n".join(includes + [""]) + "".join("namespace %s {}\n" % other for other in others) + "\n".join(
        example(name, *parts, others) for name, parts in sorted(examples.items()))


def compile_all(unit, compiler, flags, folder, name):
    source = os.path.join(folder, name + ".cpp")
    with open(source, "w", encoding="utf-8") as file:
        file.write(unit)
    answer = subprocess.run([compiler, "-fsyntax-only", "-w"] + flags + [source], cwd=ROOT,
                            capture_output=True, text=True, check=False)
    if answer.returncode == 0:
        return []
    return [line for line in answer.stderr.splitlines() if " error: " in line] or [answer.stderr]


def main():
    examples, complaints = {}, []
    for name in files(("include", "src"), (".h",)):
        text = read(name)
        found = paragraphs(text)
        complaints += [complaint for number, lines in found
                       for complaint in complaints_of(name, lines, number)]
        code = [(number, lines) for number, lines in found if is_code(lines)]
        if code:
            examples[name] = namespace_of(text), code
    needed = {context_of(name) for name in examples}
    complaints += ["test/style/example_context.py: '%s' is of no header with an example" % key
                   for key in sorted(CONTEXT) if not PLANTED and key not in needed]
    if "--list" in sys.argv:
        print("\n".join(example(name, *parts) for name, parts in sorted(examples.items())))
        finish(complaints, "%d examples" % len(examples))
    compiler, flags = compiler_and_flags(sys.argv[1] if len(sys.argv) > 1 else "build", ("-I" + ROOT,))
    absent = tuple("%s/%s/" % (tree, folder) for folder in sys.argv[2:]
                   for tree in ("src", "include/grid_path_planner"))
    examples = {name: parts for name, parts in examples.items() if not name.startswith(absent)}
    others = sorted({namespace for namespace, _ in examples.values()})
    halves = {"ros": {name: parts for name, parts in examples.items() if has_ros(name)},
              "core": {name: parts for name, parts in examples.items() if not has_ros(name)}}
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(compile_all, translation_unit(half, others), compiler, flags, folder, name)
                for name, half in halves.items() if half]
        complaints += [text for job in jobs for text in job.result()]
    finish(complaints, "%d examples" % len(examples))


main()
