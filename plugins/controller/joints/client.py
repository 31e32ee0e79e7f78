#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A client of controller.joints and controller.sensors with `protocol: binary`; see README.md.

    client.py PORT          lets the first group of joints swing for a second
"""
import math
import socket
import struct
import sys
import zlib

INFO, GET, SET, STOP, WAIT, REPORT, TIME = range(1, 8)
ERROR = 132


def frame(kind, sequence, payload=b""):
    """A request with numbers as f64."""
    header = struct.pack("<BBHB", kind, sequence, len(payload), 1)
    header += bytes([(255 - sum(header)) % 256])
    whole = b"\xa5\x5a" + header + payload
    return whole + struct.pack("<I", zlib.crc32(whole))


class Client:
    def __init__(self, port, host="127.0.0.1"):
        self.socket = socket.create_connection((host, port), timeout=20)
        self.sequence = 0

    def _read(self, size):
        data = b""
        while len(data) < size:
            part = self.socket.recv(size - len(data))
            if not part:
                raise ConnectionError("the simulation has ended")
            data += part
        return data

    def ask(self, kind, payload=b""):
        """Sends a request; returns the payload of its reply."""
        self.sequence = (self.sequence + 1) % 256
        self.socket.sendall(frame(kind, self.sequence, payload))
        head = self._read(8)
        reply, sequence, size = struct.unpack("<2xBBH2x", head)
        body = self._read(size)
        (crc,) = struct.unpack("<I", self._read(4))
        if head[:2] != b"\xa5\x5a" or sum(head[2:]) % 256 != 255 or crc != zlib.crc32(head + body):
            raise ValueError("no intact frame")
        if sequence != self.sequence:
            raise ValueError("the reply to another request")
        if reply == ERROR:
            raise ValueError(body[9:].decode())
        return body

    def info(self):
        return self.ask(INFO).decode()

    def state(self, kind, payload=b""):
        """The time in s, and the numbers of a group."""
        body = self.ask(kind, payload)
        time, count = struct.unpack_from("<q2xH", body)
        return time * 1e-9, struct.unpack_from("<%dd" % count, body, 12)

    def get(self, group=0, quantity=0):
        return self.state(GET, bytes([group, quantity]))

    def wait(self, seconds, group=0, quantity=0):
        return self.state(WAIT, struct.pack("<qBB", round(1e9 * seconds), group, quantity))

    def set(self, values, group=0, quantity=0):
        self.ask(SET, struct.pack("<BB%dd" % len(values), group, quantity, *values))


def main():
    client = Client(int(sys.argv[1]))
    print(client.info())
    begin, first = client.get()
    time = begin
    while time < begin + 1:
        client.set([q + 0.2 * math.sin(math.pi * (time - begin)) for q in first])
        time, now = client.wait(0.02)
        print("%.3f" % time, " ".join("%.6f" % q for q in now))


if __name__ == "__main__":
    main()
