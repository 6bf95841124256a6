"""Seconds in which this session had a processor, for deadlines.

A session may be left without any for ten seconds (own_master.py), where its nodes cannot answer and this process cannot
ask. A thread wakes up fifty times a second; where it is late by more than half a second, which other work alone does not
bring about, half a second counts.
"""
import threading
import time

PERIOD, MOST = 0.02, 0.5  # s


class SessionClock:
    def __init__(self):
        self.passed = 0.0
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        last = time.monotonic()
        while True:
            time.sleep(PERIOD)
            now = time.monotonic()
            self.passed += min(now - last, MOST)
            last = now


CLOCK = SessionClock()


def session_seconds():
    return CLOCK.passed
