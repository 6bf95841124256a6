"""How long cmd_vel is silent while its node lives, and how late a bare 50 Hz thread of the same process is beside it.

    with Silence(tick=0.05) as silence:   # a process of its own, which does nothing else; s between two commands
        silence.begin(); ...; silence.end()
        print(silence.verdict())          # SessionFailed where the law does not hold

What is silent when it ends counts as it is then, also where nothing was heard at all. p99.9 is at most two ticks and
what the bare thread is late, and the half of cmd_vel_timeout, and no silence is longer than the half of
cmd_vel_timeout and the latest that the bare thread was: so long nobody had the machine.

With Silence(stops=True) the vehicle is stopped by `stop` every STOP_EVERY seconds, too: a zero follows within
cmd_vel_timeout.
"""
import json
import os
import subprocess
import sys
import threading
import time

TICK = 0.02             # s; of the bare thread
CMD_VEL_TIMEOUT = 0.5   # s
STOP_EVERY = 5.0        # s
STOP_FOR = 0.5          # s
ENOUGH = 2000           # silences; of fewer, p99.9 is the longest one of a moment, held to the half of that timeout


def quantile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))]


def judge_stops(delays):
    """`delays`: from `stop` to the first zero, in s."""
    from ros_session import SessionFailed
    text = ", %d times stopped, the zero came after %.0f ms (p95), at most %.0f ms" % (
        len(delays), 1e3 * quantile(delays, 0.95), 1e3 * max(delays)) if delays else ", never stopped"
    if not delays or max(delays) > CMD_VEL_TIMEOUT:
        raise SessionFailed(text[2:])
    return text


class Silence:
    def __init__(self, tick=TICK, stops=False):
        self.tick, self.stops = tick, stops

    def __enter__(self):
        arguments = [sys.executable, __file__] + ["stops"] * self.stops
        self.process = subprocess.Popen(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
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
        gaps, late, delays = json.loads(self.process.stdout.readline())
        if len(gaps) < 50:
            raise SessionFailed("cmd_vel has been heard %d times only" % len(gaps))
        silence, bare = quantile(gaps, 0.999), quantile(late, 0.999)
        text = "p99.9 of %d silences of cmd_vel %.0f ms, longest %.0f ms, a bare 50 Hz thread is %.0f ms late, at most %.0f ms" % (
            len(gaps), 1e3 * silence, 1e3 * max(gaps), 1e3 * bare, 1e3 * max(late))
        most = CMD_VEL_TIMEOUT / 2 + bare if len(gaps) < ENOUGH else min(2 * self.tick + bare, CMD_VEL_TIMEOUT / 2)
        if silence > most or max(gaps) > CMD_VEL_TIMEOUT / 2 + max(late):
            raise SessionFailed(text)
        return text + (judge_stops(delays) if self.stops else "")

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()


class Gaps:
    """Seconds between what is heard, while it listens. Thread-safe."""

    def __init__(self):
        self.seconds, self.since = [], None  # since: it listens, from then on or from what it last heard
        self.begun, self.lock = False, threading.Lock()

    def heard(self, now):
        with self.lock:
            if self.since is not None:
                if self.begun:
                    self.seconds.append(now - self.since)
                self.since, self.begun = now, True

    def begin(self, now):
        with self.lock:
            self.since, self.begun = now, False  # how long it was silent before is not asked

    def end(self, now):
        with self.lock:
            if self.since is not None:
                self.seconds.append(now - self.since)
            self.since = None


class Listener:
    def __init__(self, stops):
        import rospy
        from geometry_msgs.msg import Twist
        self.listens, self.gaps, self.late = False, Gaps(), []
        self.stands, self.stopped_at, self.delays = True, None, []
        rospy.Subscriber("/cmd_vel", Twist, self.on_velocity, tcp_nodelay=True)
        threading.Thread(target=self.tick, daemon=True).start()
        if stops:
            threading.Thread(target=self.stop_again_and_again, daemon=True).start()

    def on_velocity(self, velocity):
        now = time.monotonic()
        self.gaps.heard(now)
        self.stands = velocity.linear.x == velocity.linear.y == velocity.linear.z == velocity.angular.z == 0.0
        if self.stands and self.stopped_at is not None:
            self.delays.append(now - self.stopped_at)
            self.stopped_at = None

    def tick(self):
        due = time.monotonic()
        while True:
            due = max(due + TICK, time.monotonic())
            time.sleep(max(0.0, due - time.monotonic()))
            if self.listens:
                self.late.append(time.monotonic() - due)

    def stop_again_and_again(self):
        import rospy
        from std_msgs.msg import Bool
        publisher = rospy.Publisher("/stop", Bool, queue_size=1, tcp_nodelay=True)
        while True:
            time.sleep(STOP_EVERY)
            if not self.listens or self.stands:
                continue
            self.stopped_at = time.monotonic()
            publisher.publish(True)
            time.sleep(STOP_FOR)
            if self.stopped_at is not None:  # it is not there yet: as long as that, at least
                self.delays.append(time.monotonic() - self.stopped_at)
                self.stopped_at = None
            publisher.publish(False)

    def run(self):
        print("listens", flush=True)
        for word in map(str.strip, sys.stdin):
            if word == "report":
                print(json.dumps([self.gaps.seconds, self.late, self.delays]), flush=True)
            self.listens = word == "begin"
            (self.gaps.begin if self.listens else self.gaps.end)(time.monotonic())


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
    Listener("stops" in sys.argv[1:]).run()


if __name__ == "__main__":
    main()
