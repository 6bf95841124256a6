"""A publisher of one latched std_msgs/Bool that answers its subscribers late, as over a slow link."""
import socket
import struct
import threading
import time
from xmlrpc.server import SimpleXMLRPCServer

import rosgraph
from rosgraph.network import encode_ros_handshake_header
from std_msgs.msg import Bool


class LatePublisher:
    def __init__(self, topic, value, seconds):
        self.topic, self.value, self.seconds = topic, value, seconds
        self.heard = 0  # subscribers that have been answered
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.node = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False, allow_none=True)
        self.node.register_function(self.request_topic, "requestTopic")
        self.node.register_function(lambda *_: [1, "", 0], "getPid")
        self.uri = "http://127.0.0.1:%d/" % self.node.server_address[1]
        for run in (self.node.serve_forever, self.accept):
            threading.Thread(target=run, daemon=True).start()
        self.master = rosgraph.Master("/late_publisher")
        self.master.registerPublisher(topic, Bool._type, self.uri)

    def request_topic(self, *_):
        return [1, "", ["TCPROS", "127.0.0.1", self.listener.getsockname()[1]]]

    def accept(self):
        while True:
            try:
                connection, _ = self.listener.accept()
            except OSError:
                return  # closed
            threading.Thread(target=self.serve, args=(connection,), daemon=True).start()

    def serve(self, connection):
        time.sleep(self.seconds)
        message = b"\1" if self.value else b"\0"
        try:
            connection.sendall(encode_ros_handshake_header({
                "callerid": "/late_publisher", "latching": "1", "md5sum": Bool._md5sum, "type": Bool._type,
                "message_definition": Bool._full_text, "topic": self.topic}))
            connection.sendall(struct.pack("<I", len(message)) + message)
            self.heard += 1
            while connection.recv(4096):
                pass
        except OSError:
            pass  # the subscriber has left

    def close(self):
        self.master.unregisterPublisher(self.topic, self.uri)
        self.node.shutdown()
        self.node.server_close()
        self.listener.close()
