"""scripts/failed_cases says what failed and why: cases of gtest and unittest, a node that ended without results, and a
file that is none; each once, at most some lines of it, and nothing of what passed."""
import os
import subprocess
import tempfile

from common import ROOT, finish

RESULTS = {
    "unload.xml": """<testsuites><testsuite name="Unload"><testcase name="Under.load" classname="Unload">
        <failure message="unload_rostest.cpp:198&#x0A;Value of: call &amp; answer"><![CDATA[the same again]]></failure>
        <failure message="a second one"></failure></testcase>
        <testcase name="Passes" classname="Unload"/></testsuite></testsuites>""",
    "rostest-unload.xml": """<testsuite><testcase name="Under.load" classname="package.Unload">
        <failure type="">as its node said</failure></testcase>
        <testcase name="lost" classname="rostest"><failure>Test [lost] did not generate test results</failure></testcase>
        </testsuite>""",
    "below/clock.xml": """<testsuite><testcase name="test_1" classname="EveryNode"><error type="AssertionError">%s</error>
        </testcase></testsuite>""" % "\n".join("line %d" % number for number in range(100)),
    "cut.xml": "<testsuite><testcase",
}
EXPECTED = ("FAILED unload: Unload.Under.load\n    unload_rostest.cpp:198\n    Value of: call & answer\n    a second one\n",
            "FAILED rostest-unload: rostest.lost\n    Test [lost] did not generate test results\n",
            "FAILED clock: EveryNode.test_1\n    line 0\n", "    line 11\n    ...\n", "FAILED cut: cut.xml\n    no result can be read: ")
UNEXPECTED = ("Passes", "the same again", "as its node said", "line 12\n")


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.makedirs(os.path.join(folder, "below"))
        for name, text in RESULTS.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        told = subprocess.run([os.path.join(ROOT, "scripts/failed_cases"), folder], stdout=subprocess.PIPE, check=True,
                              universal_newlines=True).stdout
    complaints = ["it lacks %r" % text for text in EXPECTED if text not in told]
    complaints += ["it says %r" % text for text in UNEXPECTED if text in told]
    finish(complaints + ["it said:\n" + told] * bool(complaints), "%d texts" % len(EXPECTED + UNEXPECTED))


main()
