"""scripts/failed_cases says what failed and why: cases of gtest and unittest, a node that ended without results, a check
and a test that was ended, which leave no result file, and a file that is none; at most some lines of each, and nothing
of what passed. Its input is what ctest leaves of tests that are made here."""
import os
import subprocess
import tempfile

from common import ROOT, finish

FAILURES = "".join('<testcase name="many%d" classname="C"><failure message="no %d"/></testcase>' % (number, number)
                   for number in range(12))
RESULTS = {
    "gtest-path.xml": """<testsuites><testsuite name="Path"><testcase name="Is.short" classname="Path">
        <failure message="path_test.cpp:198&#x0A;Value of: call &amp; answer"><![CDATA[the same again]]></failure>
        <failure message="a second one \u00e9"/></testcase>
        <testcase name="Passes" classname="Path"/></testsuite></testsuites>""",
    "rostest-clock.xml": """<testsuite><testcase name="test_1" classname="package.EveryNode"><error type="AssertionError">%s</error>
        </testcase><testcase name="lost" classname="rostest"><failure>Test [lost] did not generate test results</failure></testcase>
        </testsuite>""" % "\n".join("line %d" % number for number in range(100)),
    "rostest-class.xml": '<testsuite errors="1" failures="0"/>',
    "rostest-many.xml": "<testsuite>%s</testsuite>" % FAILURES,
    "rostest-passed.xml": '<testsuite><testcase name="Good" classname="C"><failure message="of a run before"/></testcase></testsuite>',
    "rostest-cut.xml": "<testsuite><testcase",
}
# Its name, what it runs, whether it passes.
TESTS = [
    ("path", "echo %s/gtest-path.xml", False), ("clock", "echo verify result %s/rostest-clock.xml", False),
    ("class", "printf '%%s\\n' %s/rostest-class.xml 'setUpClass failed'", False), ("many", "echo %s/rostest-many.xml", False),
    ("cut", "echo %s/rostest-cut.xml", False), ("passed", "echo %s/rostest-passed.xml", True),
    ("style", "seq 1 50 && true %s", False), ("ended", "sh -c 'echo began %s; sleep 60'", False),
]
EXPECTED = ("FAILED path\n  Path.Is.short\n    path_test.cpp:198\n    Value of: call & answer\n    a second one \\xe9\nFAILED",
            "FAILED clock\n  package.EveryNode.test_1\n    line 0\n", "    line 11\n    ...\n  rostest.lost\n    Test [lost] did not",
            "FAILED class\n", "    setUpClass failed\n", "FAILED many\n  C.many0\n    no 0\n", "  and 2 more\n",
            "FAILED cut\n  ", "no result can be read: ", "FAILED style\n    39\n    40\n", "FAILED ended\n", "    began ")
UNEXPECTED = ("Passes", "the same again", "line 12\n", "many10", "of a run before", "    38\n")


def run_tests(folder):
    results = os.path.join(folder, "test_results")
    os.makedirs(results)
    for name, text in RESULTS.items():
        with open(os.path.join(results, name), "w", encoding="utf-8") as file:
            file.write(text)
    with open(os.path.join(folder, "CTestTestfile.cmake"), "w", encoding="utf-8") as file:
        for name, command, passes in TESTS:
            script = os.path.join(folder, name + ".sh")
            with open(script, "w", encoding="utf-8") as lines:
                lines.write("%s\nexit %d\n" % (command % results, 0 if passes else 1))
            file.write('add_test(%s sh "%s")\n' % (name, script))
    subprocess.run(["ctest", "--timeout", "2"], cwd=folder, stdout=subprocess.DEVNULL, check=False)


def main():
    with tempfile.TemporaryDirectory() as folder:
        run_tests(folder)
        told = subprocess.run([os.path.join(ROOT, "scripts/failed_cases"), folder], stdout=subprocess.PIPE, check=True,
                              env=dict(os.environ, PYTHONIOENCODING="ascii"), universal_newlines=True).stdout
    complaints = ["it lacks %r" % text for text in EXPECTED if text not in told]
    complaints += ["it says %r" % text for text in UNEXPECTED if text in told]
    finish(complaints + ["it said:\n" + told] * bool(complaints), "%d texts" % len(EXPECTED + UNEXPECTED))


main()
