"""What a stranger may send: any message with some of its fields replaced, found by the fields' types."""
import io
import struct

import genpy

NUMBERS = ("float32", "float64")
HOSTILE_FRAMES = ("", "$(touch x)", "a\nb", "\x1b[2J", "a\"b", "m" * 257, "\u00e9")


def walk(message, change):
    """`change(type, name, value)` of every field that is no message gives its new value; arrays element by element."""
    for name, kind in zip(message.__slots__, message._slot_types):
        setattr(message, name, changed(kind, name, getattr(message, name), change))
    return message


def changed(kind, name, value, change):
    if kind == "Header" or isinstance(value, genpy.Message) and kind not in ("time", "duration"):
        return walk(value, change)
    if kind.endswith("]") and not isinstance(value, (bytes, str)):
        element = kind[:kind.index("[")]
        return [changed(element, name, one, change) for one in value]
    return change(kind, name, value)


def raw_time(seconds, nanoseconds):
    """Also with more than 999,999,999 ns, as a message may carry them and genpy.Time() does not."""
    time = genpy.Time()
    time.secs, time.nsecs = seconds, nanoseconds
    return time


def stamped(message, stamp):
    return walk(message, lambda kind, _, value: raw_time(stamp.secs, stamp.nsecs) if kind == "time" else value)


def has_stamp(message):
    found = []
    walk(message, lambda kind, _, value: found.append(1) or value if kind == "time" else value)
    return bool(found)


def with_numbers(message, number):
    """Not of float32 where it does not fit."""
    fits = {"float32": abs(number) < 3e38 or number != number or abs(number) == float("inf"), "float64": True}
    return walk(message, lambda kind, _, value: number if fits.get(kind) else value)


def with_frames(message, frame):
    return walk(message, lambda kind, name, value: frame if name.endswith("frame_id") else value)


def with_sizes(message, size):
    """Every size and count that it states, and for 0 nothing in it either."""
    def change(kind, name, value):
        if kind == "uint32" and name != "seq":
            return size
        return b"" if size == 0 and kind in ("int8[]", "uint8[]") else value
    return walk(message, change)


def serialized(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def raw(message, content):
    """A message of the same type whose bytes are `content`, as no client library would write it."""
    class Raw(type(message)):
        __slots__ = ()

        def serialize(self, buff):
            buff.write(content)
    return Raw()


def lengths(message):
    """Of all that it holds in a variable number, where that is not none."""
    found = set()

    def look(kind, _, value):
        if isinstance(value, (bytes, str)):
            found.add(len(value))
        return value
    for name, kind in zip(message.__slots__, message._slot_types):
        value = getattr(message, name)
        if isinstance(value, list):
            found.add(len(value))
        for part in value if isinstance(value, list) else [value]:
            if isinstance(part, genpy.Message):
                found |= lengths(part)
        look(kind, name, value)
    return found - {0}


def broken(message):
    """Cut short, and with lengths that are not there: a little too long, and more than any memory. Lengths between
    are left out: roscpp takes that memory before a node sees the message."""
    whole, known = serialized(message), lengths(message)
    yield raw(message, whole[:len(whole) // 2])
    yield raw(message, b"")
    for offset in range(0, len(whole) - 3):
        length = struct.unpack_from("<I", whole, offset)[0]
        if length in known:
            for claim in (length + 1000, (1 << 32) - 1):
                yield raw(message, whole[:offset] + struct.pack("<I", claim) + whole[offset + 4:])
