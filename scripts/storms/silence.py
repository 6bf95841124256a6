"""How long cmd_vel is silent while its node lives, and how late a bare 50 Hz thread of the same process is beside it.

    with Silence() as silence:            # a process of its own, which does nothing else
        silence.begin(); ...; silence.end()
        print(silence.verdict())          # SessionFailed where the law does not hold
"""
import json
import os
import subprocess
import sys
import threading
import time

TICK = 0.02             # s; of a control_rate of 50 Hz, and of the bare thread
CMD_VEL_TIMEOUT = 0.5   # s
ENOUGH = 2000           # silences; of fewer, p99.9 is the longest one of a moment, held to the half of that timeout


def quantile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))]


class Silence:
    def __enter__(self):
        self.process = subprocess.Popen([sys.executable, __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        text=True)
        self.process.stdout.readline()  # it listens
        return self

    def tell(self, word):
        self.process.stdin.write(word + "\n")
        self.process.stdin.flush()

    def begin(self):
        self.tell("begin")

    def end(self):
        self.tell("end")

    def verdict(self):
        from ros_session import SessionFailed
        self.tell("report")
        gaps, late = json.loads(self.process.stdout.readline())
        if len(gaps) < 50:
            raise SessionFailed("cmd_vel has been heard %d times only" % len(gaps))
        silence, bare = quantile(gaps, 0.999), quantile(late, 0.999)
        text = "p99.9 of %d silences of cmd_vel %.0f ms, longest %.0f ms, a bare 50 Hz thread is %.0f ms late" % (
            len(gaps), 1e3 * silence, 1e3 * max(gaps), 1e3 * bare)
        few = len(gaps) < ENOUGH
        if silence > (CMD_VEL_TIMEOUT / 2 + bare if few else min(2 * TICK + bare, CMD_VEL_TIMEOUT / 2)):
            raise SessionFailed(text)
        return text

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()


class Listener:
    def __init__(self):
        import rospy
        from geometry_msgs.msg import Twist
        self.listens, self.last, self.gaps, self.late = False, None, [], []
        rospy.Subscriber("/cmd_vel", Twist, self.on_velocity, tcp_nodelay=True)
        threading.Thread(target=self.tick, daemon=True).start()

    def on_velocity(self, _):
        now = time.monotonic()
        if self.listens and self.last is not None:
            self.gaps.append(now - self.last)
        self.last = now if self.listens else None

    def tick(self):
        due = time.monotonic()
        while True:
            due = max(due + TICK, time.monotonic())
            time.sleep(max(0.0, due - time.monotonic()))
            if self.listens:
                self.late.append(time.monotonic() - due)

    def run(self):
        print("listens", flush=True)
        for word in map(str.strip, sys.stdin):
            if word == "report":
                print(json.dumps([self.gaps, self.late]), flush=True)
            self.listens = word == "begin"


def take_realtime_priority():
    """As navigate_path's thread that commands: what is measured is its silence, not that of this process."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
    except PermissionError:
        pass  # nor has that thread any


def main():
    take_realtime_priority()  # before there are threads
    import rospy
    rospy.init_node("silence", anonymous=True, disable_signals=True)
    Listener().run()


if __name__ == "__main__":
    main()
