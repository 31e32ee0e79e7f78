#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A client of muro's controller.jsonrpc in one file, without anything but Python 3.

As a program, with the address of a server, HOST:PORT or the path of a Unix socket:

    muro_client.py 127.0.0.1:4010 list "rover/*:*"
    muro_client.py 127.0.0.1:4010 describe rover/base_link:pose
    muro_client.py 127.0.0.1:4010 get rover/base_link:pose crate/body:pose
    muro_client.py 127.0.0.1:4010 set rover/base_link:command.twist '{"vx": 0.5}'
    muro_client.py 127.0.0.1:4010 watch rover/base_link:pose --rate 10 --count 5
    muro_client.py 127.0.0.1:4010 call step '{"seconds": 1}'

As a library:

    from muro_client import Client
    with Client("127.0.0.1:4010") as muro:
        muro.call("pause")
        muro.set("rover/base_link:command.twist", {"vx": 0.5})
        muro.call("step", seconds=1)
        print(muro.get("rover/base_link:pose"))
"""

import argparse
import base64
import json
import os
import socket
import ssl
import sys


# What the module `struct` calls them.
NUMBERS = {"float64": "d", "float32": "f", "int64": "q", "uint64": "Q", "int32": "i", "uint32": "I", "uint8": "B"}


class MuroError(Exception):
    """What the server has answered instead of a result."""

    def __init__(self, error):
        super().__init__(error["message"])
        self.code = error["code"]
        self.data = error.get("data")


class Client:
    """A connection. Every call waits for its reply; updates that come in between are kept."""

    def __init__(self, address, timeout=60.0, tls=None, token=None):
        """`tls`: the certificate of a server that encrypts, or of who vouches for it, a file in PEM format. `token`: what
        a server wants to hear first."""
        if "/" in address:
            self._socket = socket.socket(socket.AF_UNIX)
            self._socket.settimeout(timeout)
            self._socket.connect(address)
        else:
            host, _, port = address.rpartition(":")
            host = host.strip("[]") or "127.0.0.1"
            self._socket = socket.create_connection((host, int(port)), timeout)
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            if tls:
                self._socket = ssl.create_default_context(cafile=tls).wrap_socket(self._socket, server_hostname=host)
        self._lines = self._socket.makefile("r", encoding="utf-8", newline="\n")
        self._last_id = 0
        self._updates = []
        if token:
            self.call("authenticate", token=token)

    def close(self):
        self._lines.close()
        self._socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.close()

    def _send(self, message):
        self._socket.sendall(json.dumps(message, allow_nan=False).encode() + b"\n")

    def _receive(self):
        line = self._lines.readline()
        if not line:
            raise ConnectionError("the server has closed the connection")
        return json.loads(line)

    def _request(self, method, params):
        self._last_id += 1
        return {"jsonrpc": "2.0", "id": self._last_id, "method": method, "params": params}

    def call(self, method, **params):
        """The result of a method. MuroError where there is none."""
        request = self._request(method, params)
        self._send(request)
        while True:
            message = self._receive()
            if "method" in message:
                self._updates.append(message["params"])
            elif message["id"] in (request["id"], None):
                if "error" in message:
                    raise MuroError(message["error"])
                return message["result"]

    def batch(self, *calls):
        """Results of several calls, (method, params) each, that follow each other without a gap. MuroError for the
        first that has none."""
        requests = [self._request(method, params) for method, params in calls]
        self._send(requests)
        while True:
            message = self._receive()
            if isinstance(message, list):
                break
            self._updates.append(message["params"])
        for reply in message:
            if "error" in reply:
                raise MuroError(reply["error"])
        results = {reply["id"]: reply["result"] for reply in message}
        return [results[request["id"]] for request in requests]

    def get(self, *properties):
        """The value of one property, or a dictionary with those of several or of a pattern."""
        values = self.call("get", properties=list(properties))["values"]
        is_one = len(properties) == 1 and not set("*?") & set(properties[0])
        return next(iter(values.values())) if is_one else values

    def get_array(self, name):
        """The numbers of a property that is an array or a list, one after the other: a picture, or ranges, without text on
        the way. numpy.asarray takes it as it is."""
        value = self.call("get", properties=name, encoding="base64")["values"].popitem()[1]
        return memoryview(base64.b64decode(value["base64"])).cast(NUMBERS[value["type"]])

    def set(self, name, value, **more):
        """Sets a property: a number, an array of all columns, or a dictionary of some. `element`, `unit`: optional."""
        return self.call("set", property=name, value=value, **more)

    def subscribe(self, *properties, **timing):
        """The number of a subscription: rate=HZ, or on_change=True and perhaps least_period=SECONDS."""
        return self.call("subscribe", properties=list(properties), **timing)["subscription"]

    def update(self):
        """The next update: a dictionary with subscription, time, values and, where some were lost, dropped."""
        while not self._updates:
            self._updates.append(self._receive()["params"])
        return self._updates.pop(0)


def value_of(text):
    try:
        return json.loads(text)
    except ValueError:
        return text


def token_of(options):
    if not options.token_file:
        return os.environ.get("MURO_TOKEN")
    with open(options.token_file, encoding="utf-8") as file:
        return file.read().strip()


def run(muro, options):
    """What the program is asked for on its command line; yields what it prints."""
    if options.command == "list":
        found = muro.call("list", pattern=options.pattern)
        yield from found.get("properties", found.get("objects"))
    elif options.command == "describe":
        yield muro.call("describe", property=options.property)
    elif options.command == "get":
        yield muro.call("get", properties=options.properties)
    elif options.command == "set":
        yield muro.set(options.property, value_of(options.value))
    elif options.command == "call":
        params = value_of(options.params)
        if options.method in ("pause", "step"):
            params.setdefault("keep", True)  # this client goes at once, and the pause would go with it
        yield muro.call(options.method, **params)
    elif options.command == "watch":
        timing = {"on_change": True} if options.on_change else {"rate": options.rate}
        muro.subscribe(*options.properties, **timing)
        count = 0
        while options.count is None or count < options.count:
            yield muro.update()
            count += 1


def command_line():
    parser = argparse.ArgumentParser(description="Talks to a simulation of muro with a controller.jsonrpc.")
    parser.add_argument("address", help="HOST:PORT, or the path of a Unix socket")
    parser.add_argument("--tls", metavar="FILE", help="the certificate of a server that encrypts (PEM)")
    parser.add_argument("--token-file", metavar="FILE", help="what the server wants to hear first; or in MURO_TOKEN")
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("list", help="names of objects, or of properties")
    one.add_argument("pattern", nargs="?", default="*", help='"rover*": objects; "rover*:*": properties')
    one = commands.add_parser("describe", help="type, unit and columns of a property")
    one.add_argument("property")
    one = commands.add_parser("get", help="values now")
    one.add_argument("properties", nargs="+", help="object:property, with * and ?")
    one = commands.add_parser("set", help="sets a property")
    one.add_argument("property")
    one.add_argument("value", help='JSON: 1, [1, 0, 0], {"vx": 1}')
    one = commands.add_parser("watch", help="values again and again")
    one.add_argument("properties", nargs="+")
    one.add_argument("--rate", type=float, default=10, help="Hz of simulated time")
    one.add_argument("--on-change", action="store_true")
    one.add_argument("--count", type=int, help="ends after so many updates")
    one = commands.add_parser("call", help="any method")
    one.add_argument("method")
    one.add_argument("params", nargs="?", default="{}", help='JSON: {"seconds": 1}')
    return parser


def show(result):
    try:
        print(result if isinstance(result, str) else json.dumps(result), flush=True)
    except BrokenPipeError:  # who reads this has read enough, as `head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)


def main():
    options = command_line().parse_args()
    try:
        with Client(options.address, tls=options.tls, token=token_of(options)) as muro:
            for result in run(muro, options):
                show(result)
    except MuroError as error:
        near = (error.data or {}).get("did_you_mean") if isinstance(error.data, dict) else None
        sys.exit(f"{error}" + (f" (did you mean {near}?)" if near else ""))
    except OSError as error:
        sys.exit(f"{options.address}: {error}")
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
