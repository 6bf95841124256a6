"""A ROS master that is slow in one of its answers, or loses questions, in front of the real one."""
import http.server
import threading
import time
import urllib.error
import urllib.request


class Server(http.server.ThreadingHTTPServer):
    request_queue_size = 128  # as the real one's: a sixth node that connects meanwhile would wait a second


class SlowMaster:
    """Hands all calls on to `master`; `times` of `method` are answered after `seconds`, once `before` of them have been at
    once. `asked_at` has when each came (monotonic s), `answers` when each that is answered came and went."""

    def __init__(self, master, seconds, times, method="getSystemState", before=0, port=0):
        self.master, self.seconds, self.method = master, seconds, method.encode()
        self.slow_ones = range(before, before + times)
        self.asked_at, self.answers, self.lock = [], [], threading.Lock()
        self.server = Server(("localhost", port), self.handler())
        self.uri = "http://localhost:%d/" % self.server.server_address[1]
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def end(self):
        self.server.shutdown()
        self.server.server_close()

    def is_slow(self):
        with self.lock:
            self.asked_at.append(time.monotonic())
            return len(self.asked_at) - 1 in self.slow_ones

    def is_lost(self, question):  # pylint: disable=unused-argument
        return False

    def handler(slow):  # pylint: disable=no-self-argument
        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_POST(self):  # pylint: disable=invalid-name
                came, body = time.monotonic(), self.rfile.read(int(self.headers["Content-Length"]))
                if slow.is_lost(body):
                    self.close_connection = True
                    return
                if slow.method in body and slow.is_slow():
                    time.sleep(slow.seconds)
                request = urllib.request.Request(slow.master, body, {"Content-Type": "text/xml"})
                try:
                    with urllib.request.urlopen(request) as answer:
                        said = answer.read()
                    if slow.method in body:
                        slow.answers.append((came, time.monotonic()))
                    self.send_response(200)
                    self.send_header("Content-Type", "text/xml")
                    self.send_header("Content-Length", str(len(said)))
                    self.end_headers()
                    self.wfile.write(said)
                except (urllib.error.URLError, OSError):
                    self.close_connection = True  # either of the two has gone

            def log_message(self, *_):
                pass
        return Handler


class CeasingMaster(SlowMaster):
    """Answers as `master` does until it ceases: silent, as one that is stopped, or gone, as one that was killed."""

    def __init__(self, master):
        super().__init__(master, 0.0, 0, method="")  # it is asked before each answer
        self.goes_on = threading.Event()
        self.goes_on.set()

    def is_slow(self):
        self.goes_on.wait()
        return False

    def fall_silent(self):
        self.goes_on.clear()

    def die(self):
        """Connections that it has end with what they ask next."""
        self.master = "http://localhost:1/"
        super().end()

    def end(self):
        self.goes_on.set()
        super().end()
