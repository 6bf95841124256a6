"""Doxygen's INPUT_FILTER: the plain comments of a header as Doxygen reads them.

    doxygen_filter.py HEADER

The comment that the file opens with describes the file, a comment on lines of its own what follows, one
behind code what stands before it. Lines indented by three spaces are code, as in CONTRIBUTING.md.
"""
import re
import sys

COMMENT = re.compile(r'^((?:[^"/]|"(?:[^"\\]|\\.)*"|/(?!/))*?)//( {0,3})(.*)$')
SPAN = re.compile(r"(`[^`]*`)")


def escaped(text):
    """Nothing in the text is a command, a tag or a link, but `code` stays."""
    return "".join(part if part.startswith("`") else re.sub(r"([\\@<>#%&])", r"\\\1", part)
                   for part in SPAN.split(text))


def translated(lines):
    """The lines, and one more: the essay's."""
    behind = None  # the column of the comment of the line before, where it stands behind code
    for number, line in enumerate(lines):
        match = COMMENT.match(line)
        if match is None:
            behind = None
            yield line
            continue
        code, indent, text = match.groups()
        if number == 0:
            yield "/// @file"
        continued = not code.strip() and len(code) == behind
        behind = len(code) if code.strip() or continued else None
        is_code = len(indent) == 3 and behind is None
        yield "%s///%s%s" % (code, "<" if behind is not None else "",
                             "      " + text if is_code else " " + escaped(text))


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        print("\n".join(translated(file.read().splitlines())))


main()
