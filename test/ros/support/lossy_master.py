#!/usr/bin/env python3
"""Between nodes and their ROS master: loses the first questions of each registration and name, while a file exists.

    lossy_master.py http://localhost:20001 20002 /tmp/lossy    # nodes have ROS_MASTER_URI=http://localhost:20002
"""
import collections
import http.server
import os
import sys
import urllib.request
import xmlrpc.client

MASTER, PORT, SWITCH = sys.argv[1], int(sys.argv[2]), sys.argv[3]
LOST = 4  # a client of roscpp asks twice
asked = collections.Counter()


def is_lost(question):
    arguments, method = xmlrpc.client.loads(question)
    if not method.startswith("register") or not os.path.exists(SWITCH):
        return False
    asked[method, arguments[:2]] += 1
    return asked[method, arguments[:2]] <= LOST


class Questions(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def do_POST(self):
        question = self.rfile.read(int(self.headers["Content-Length"]))
        self.close_connection = is_lost(question)
        if self.close_connection:
            return
        request = urllib.request.Request(MASTER, question, {"Content-Type": "text/xml"})
        with urllib.request.urlopen(request) as reply:
            answer = reply.read()
        self.send_response(200)
        self.send_header("Content-Type", "text/xml")
        self.send_header("Content-Length", str(len(answer)))
        self.end_headers()
        self.wfile.write(answer)

    def log_message(self, *_):
        pass


http.server.ThreadingHTTPServer(("localhost", PORT), Questions).serve_forever()
