"""Every reader of files, handler of messages, service and set of parameters has a target of the fuzzer, or a reason why not:
fuzz_inputs.py names them. One that is new, or gone, is told; so is a target that is not there or does not know the message."""
import re

from common import finish, files, read
from fuzz_inputs import INPUTS, NOT_A_NODE, Part, Without

COMMENT = re.compile(r"//.*")
TYPE = r"([A-Za-z][\w:]*)"
HANDLERS = [re.compile(pattern) for pattern in (
    r"\bsubscribe(?:Checked|Bounded)<\s*" + TYPE, r"\bInput<\s*" + TYPE + ">", r"\blisten<\s*" + TYPE + r">\(\s*Source::", r"\badvertiseService(?:BySpec)?<\s*" + TYPE,
    r"\bActionCaller<\s*" + TYPE, r"\bActionServer<\s*(?:\w+::)*" + TYPE + r">(?:::initialize|\s+\w+;)",
    r"\b(NavigatePathServer) \w+;", r"\bconversion\(&" + TYPE, r"\bmake_unique<Reconfigurable<\w+,\s*(?:\w+::)*" + TYPE,
    r"\bReconfigurable<\w+,\s*" + TYPE + r"> server_")]
READER = re.compile(r"\b(readWholeFile|loadYamlFile|fopen|popen|receiveLine)\(|\bifstream\b|\bBagReader \w+|\bRegularFile\b[ &(]")
# Those that all others use.
DEFINITIONS = ("base/files.cpp", "ros/guard/incoming/", "ros/input/input.h", "ros/guard/parameters.h")
# What comes past the judges of lengths.
UNCHECKED = re.compile(r"\b(?:nh|nh_|node|private_nh|own)\.(subscribe|advertiseService)\b")
TARGET = re.compile(r"^FUZZ_TARGET\((\w+),", re.MULTILINE)


def inputs_of(name, text):
    """What a source hears and reads, as INPUTS names it."""
    text = COMMENT.sub("", text)
    found = {kind for handler in HANDLERS for kind in handler.findall(text) if not kind.startswith("grid_path_planner")}
    if not name.endswith(".cpp"):
        return found
    if READER.search(text):
        found.add("file")
    return found


def is_asked(name):
    return not name.startswith(NOT_A_NODE) and not name.startswith(DEFINITIONS)


def sources():
    """{name below src/: text}"""
    return {name[len("src/"):]: read(name) for name in files(["src"], (".cpp", ".h")) if is_asked(name[len("src/"):])}


def targets():
    """{target: the text of its source}"""
    texts = (read(name) for name in files(["test/fuzz"], (".cpp",)))
    return {target: text for text in texts for target in TARGET.findall(text)}


def complaints_of(name, kind, given, known):
    if isinstance(given, Without):
        return
    named, knows_part = (given[0], True) if isinstance(given, Part) else (given, kind == "file")
    for target in named.split():
        if target not in known:
            yield f"src/{name}: {kind} is to be fuzzed by {target}, which test/fuzz does not have"
    short = kind.rsplit("::", 1)[-1]
    if not knows_part and not any(re.search(rf"\b{short}\b", known.get(target, "")) for target in named.split()):
        yield f"src/{name}: none of the targets {named} knows {kind}"


def complaints(texts, inputs, known):
    for name, text in texts.items():
        if UNCHECKED.search(COMMENT.sub("", text)):
            yield f"src/{name}: subscribeChecked() and advertiseService() judge lengths before messages are unpacked, this does not"
        for kind in sorted(inputs_of(name, text) - set(inputs.get(name, {}))):
            yield f"src/{name}: {kind} has no target of the fuzzer in test/style/fuzz_inputs.py"
    for name, kinds in inputs.items():
        for kind, given in kinds.items():
            if kind not in inputs_of(name, texts.get(name, "")):
                yield f"src/{name}: {kind} of test/style/fuzz_inputs.py is not there"
            yield from complaints_of(name, kind, given, known)


def rules():
    """What the check must find in sources that are made up."""
    node, reader = "ros/x/x_node.cpp", "x/x_file.cpp"
    target = {"thing": "FUZZ_TARGET(thing, seeds) { messageOf<new_msgs::Thing>(input); }"}
    hears = {node: "  // subscribeChecked<old_msgs::Other>(\nsub_ = subscribeChecked<\n    new_msgs::Thing>(nh, \"x\", 1, f);"}
    for texts, inputs, number in (
            (hears, {}, 1), (hears, {node: {"new_msgs::Thing": "thing"}}, 0), (hears, {node: {"new_msgs::Thing": "other"}}, 2),
            (hears, {node: {"new_msgs::Thing": "thing", "new_msgs::Gone": "thing"}}, 2),
            ({node: "sub_ = nh_.subscribe(\"x\", 1, f);"}, {}, 1),
            ({node: "s_ = advertiseService<New>(nh, \"x\", f);"}, {}, 1),
            ({node: "r_ = std::make_unique<Reconfigurable<XConfig, XOptions>>(nh);"}, {}, 1),
            ({node: "s_ = advertiseService<New>(nh, \"x\", f);"}, {node: {"New": Part(("thing", "all"))}}, 0),
            ({node: "s_ = advertiseService<New>(nh, \"x\", f);"}, {node: {"New": Without("no byte")}}, 0),
            ({reader: "const auto text = base::readWholeFile(file, 9);"}, {}, 1),
            ({reader: "const base::RegularFile regular(file);"}, {reader: {"file": "thing"}}, 0)):
        told = list(complaints(texts, inputs, target))
        if len(told) != number:
            yield f"{number} complaints of {texts} with {inputs} are {told}"


def main():
    texts, known = sources(), targets()
    finish([*rules(), *complaints(texts, INPUTS, known)], "%d sources with inputs" % len(INPUTS))


if __name__ == "__main__":
    main()
