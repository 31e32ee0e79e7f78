#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Drives a vehicle through streets by its laser scanner.

It sees a Hokuyo URG-04LX on a serial device (SCIP 2.0) and a drive on TCP that takes lines of text, and nothing else:
it would drive a real vehicle with such a scanner and drive in the same way.

    python3 pilot.py --laser /tmp/rover.laser --drive 127.0.0.1:4100

In each turn it asks for a scan, waits for it, and answers with a velocity. --delay MAX sleeps for a random time, at
most MAX s, before whatever it says, as a slow machine would.
"""
import argparse
import math
import os
import random
import select
import socket
import sys
import termios
import time
import tty


class Gone(Exception):
    """The other end has closed the connection."""


def patiently(action, seconds=20):
    """Repeats `action` until it works, for as long as the device may take to appear."""
    end = time.monotonic() + seconds
    while True:
        try:
            return action()
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.02)


class Scanner:
    """A URG-04LX: SCIP 2.0 on a serial device."""

    def __init__(self, path, pause):
        self.pause = pause
        self.file = patiently(lambda: os.open(path, os.O_RDWR | os.O_NOCTTY))
        tty.setraw(self.file, termios.TCSANOW)
        self.buffer = b""
        self.ask("SCIP2.0", may_fail=True)
        about = dict(line.split(b";")[0].split(b":", 1) for line in self.ask("PP")[2:] if b":" in line)
        self.first, self.last, self.front = (int(about[k]) for k in (b"AMIN", b"AMAX", b"AFRT"))
        self.step = 2 * math.pi / int(about[b"ARES"])
        self.least = int(about[b"DMIN"])
        self.ask("BM")

    def ask(self, command, may_fail=False):
        """Sends a command; the lines of the reply, with its echo, without the empty line at its end."""
        self.pause()
        os.write(self.file, command.encode() + b"\n")
        while b"\n\n" not in self.buffer:
            if not select.select([self.file], [], [], 60)[0]:
                raise Gone("the scanner does not answer to " + command)
            try:
                arrived = os.read(self.file, 65536)
            except OSError as e:
                raise Gone(str(e)) from e
            if not arrived:
                raise Gone("the scanner is gone")
            self.buffer += arrived
        reply, self.buffer = self.buffer.split(b"\n\n", 1)
        lines = reply.split(b"\n")
        if not may_fail and lines[1][:2] not in (b"00", b"02"):
            raise SystemExit(f"the scanner answers {lines[1][:2].decode()} to {command}")
        return lines

    def scan(self):
        """Distances in mm, from right to left; 0 where nothing was seen."""
        lines = self.ask(f"GD{self.first:04d}{self.last:04d}01")
        data = b"".join(line[:-1] for line in lines[3:])
        values = [(data[i] - 48) << 12 | (data[i + 1] - 48) << 6 | data[i + 2] - 48 for i in range(0, len(data), 3)]
        return [0 if v < self.least else v for v in values]

    def angle(self, i):
        return (self.first + i - self.front) * self.step


class Drive:
    """A drive that takes a velocity: `set base vx vy wz`."""

    def __init__(self, address, pause):
        host, port = address.rsplit(":", 1)
        self.pause = pause
        self.socket = patiently(lambda: socket.create_connection((host, int(port))))
        self.file = self.socket.makefile("rw", newline="\n")

    def set(self, vx, wz):
        self.pause()
        self.file.write(f"set base {vx:.3f} 0 {wz:.3f}\n")
        self.file.flush()
        answer = self.file.readline()
        if not answer:
            raise Gone("the drive is gone")
        if not answer.startswith("ok"):
            raise SystemExit("the drive says: " + answer.strip())


def steer(scanner, scan):
    """A velocity towards the widest way out: m/s, rad/s."""
    sectors = []
    for i in range(0, len(scan) - 20, 20):
        seen = [v for v in scan[i : i + 20] if v > 0]
        sectors.append((scanner.angle(i + 10), min(seen) / 1000 if seen else 5.6))
    half_width, best, best_free = 0.45, 0.0, -1.0
    for heading, _ in sectors:
        if abs(heading) > 1.6:
            continue
        free = 5.6
        for angle, distance in sectors:
            across = distance * math.sin(angle - heading)
            along = distance * math.cos(angle - heading)
            if along > 0 and abs(across) < half_width:
                free = min(free, along)
        score = free - 0.8 * abs(heading)
        if score > best_free:
            best, best_free = heading, score
    ahead = min(d for a, d in sectors if abs(a) < 0.5)
    speed = max(0.0, min(0.6, 0.5 * (ahead - 0.6)))
    return speed, max(-1.0, min(1.0, 1.5 * best)) if speed > 0.05 or abs(best) > 0.1 else 0.8


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--laser", required=True, help="serial device of the scanner")
    parser.add_argument("--drive", required=True, help="HOST:PORT of the drive")
    parser.add_argument("--delay", type=float, default=float(os.environ.get("PILOT_DELAY", 0)),
                        help="s, longest time that it dawdles before it speaks (default: PILOT_DELAY, or 0)")
    arguments = parser.parse_args()
    chance = random.SystemRandom()

    def pause():
        if arguments.delay > 0:
            time.sleep(chance.uniform(0, arguments.delay))

    turns = 0
    try:
        drive = Drive(arguments.drive, pause)
        scanner = Scanner(arguments.laser, pause)
        while True:
            drive.set(*steer(scanner, scanner.scan()))
            turns += 1
    except (Gone, ConnectionError, BrokenPipeError) as e:
        print(f"{turns} turns, then: {e}", file=sys.stderr)


if __name__ == "__main__":
    main()
