"""One call of a service over a connection of its own, as a client makes it that reads late."""
import io
import socket
import struct

import rosservice
from rosgraph.network import encode_ros_handshake_header
from roslib.message import get_service_class

TIMEOUT = 30.0  # s, for the answer


def read(connection, size):
    data = b""
    while len(data) < size:
        part = connection.recv(size - len(data))
        if not part:
            raise EOFError("the connection ended after %d of %d bytes" % (len(data), size))
        data += part
    return data


def read_counted(connection):
    return read(connection, struct.unpack("<I", read(connection, 4))[0])


def ends_after_answer(service, caller, seconds):
    """Whether the server closes the connection of a call by itself within `seconds` of its answer."""
    address = rosservice.get_service_uri(service)
    kind = get_service_class(rosservice.get_service_type(service))
    host, port = rosservice.rosgraph.network.parse_http_host_and_port(address.replace("rosrpc", "http"))
    with socket.create_connection((host, port), timeout=TIMEOUT) as connection:
        connection.sendall(encode_ros_handshake_header(
            {"service": service, "md5sum": kind._md5sum, "callerid": caller}))
        read_counted(connection)
        request = io.BytesIO()
        kind._request_class().serialize(request)
        connection.sendall(struct.pack("<I", len(request.getvalue())) + request.getvalue())
        read(connection, 1)  # whether it was carried out
        read_counted(connection)
        connection.settimeout(seconds)
        try:
            return connection.recv(1) == b""
        except socket.timeout:
            return False
