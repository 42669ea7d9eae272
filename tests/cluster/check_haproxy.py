#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Two servers of one project behind the HAProxy of deploy/cluster: a viewer stays at its server, and finds its changes at the
other one when that fails. check_haproxy.py RAYBUNDLE ROOT"""
import asyncio
import json
import re
import socket
import subprocess
import sys
import tempfile
import urllib.error
import urllib.request
from pathlib import Path

import websockets

RAYBUNDLE, ROOT = sys.argv[1], Path(sys.argv[2])
SUBPROTOCOL = "raybundle.v1"


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Programs:
    """What runs while the test does."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.running = []

    def start(self, *arguments, **options):
        process = subprocess.Popen([str(argument) for argument in arguments], **options)
        self.running.append(process)
        return process

    def end(self):
        for process in self.running:
            process.kill()
            process.wait()

    def redis(self):
        port = free_port()
        self.start("redis-server", ROOT / "deploy/cluster/redis.conf", "--port", port, "--bind", "127.0.0.1", "--dir",
                   self.folder, "--logfile", self.folder / "redis.log")
        return port

    def server(self, redis):
        process = self.start(RAYBUNDLE, "serve", ROOT / "scenes/cornell_box.gltf", "--listen", "127.0.0.1:0", "--redis",
                             f"127.0.0.1:{redis}", "--project", "box", "--log-level", "warn",
                             stdout=subprocess.PIPE, text=True)
        for line in process.stdout:
            found = re.search(r"http://127\.0\.0\.1:(\d+)", line)
            if found:
                return process, int(found[1])
        raise RuntimeError("the server has ended")

    def haproxy(self, ports):
        port = free_port()
        text = (ROOT / "deploy/cluster/haproxy.cfg").read_text()
        text = text.replace("bind :8080", f"bind 127.0.0.1:{port}")
        for name, backend in ports.items():
            text = text.replace(f"{name}:8080", f"127.0.0.1:{backend}")
        file = self.folder / "haproxy.cfg"
        file.write_text(text)
        self.start("haproxy", "-db", "-f", file)
        return port


async def until(condition):
    """Waits for what has to come; what hangs ends by the test's own limit."""
    while True:
        found = condition()
        if found:
            return found
        await asyncio.sleep(0.1)


def answers(port, path="/healthz/ready"):
    try:
        with urllib.request.urlopen(f"http://127.0.0.1:{port}{path}", timeout=10) as answer:
            return answer.status == 200
    except (urllib.error.URLError, OSError):
        return False


class Viewer:
    """A viewer behind the proxy, with a browser's cookie."""

    def __init__(self, port):
        self.port, self.cookie, self.server, self.welcome, self.socket, self.number = port, None, None, None, None, 1

    async def join(self):
        headers = {"Cookie": self.cookie} if self.cookie else {}
        self.socket = await websockets.connect(f"ws://127.0.0.1:{self.port}/ws", subprotocols=[SUBPROTOCOL],
                                               extra_headers=headers, max_size=None, open_timeout=30)
        given = self.socket.response_headers.get("Set-Cookie")
        if given:
            self.cookie = given.split(";")[0]
        self.server = self.cookie.split("=")[1]
        hello = {"protocol": "1.0", "name": "Ada", "viewport": {"width": 64, "height": 48}}
        self.welcome = (await self.ask({"hello": hello}))["welcome"]

    async def ask(self, body):
        self.number += 1
        await self.socket.send(json.dumps({"id": self.number, **body}))
        while True:
            message = await self.socket.recv()
            if isinstance(message, str) and json.loads(message).get("replyTo") == self.number:
                return json.loads(message)

    async def lost(self):
        try:
            while True:
                await self.socket.recv()
        except websockets.ConnectionClosed:
            pass


async def come_back(viewer):
    while True:
        try:
            await viewer.join()
            return
        except (OSError, asyncio.TimeoutError, websockets.WebSocketException):
            await asyncio.sleep(0.1)


async def run(programs):
    redis = programs.redis()
    await until(lambda: subprocess.run(["redis-cli", "-p", str(redis), "ping"], capture_output=True).returncode == 0)
    servers = {name: programs.server(redis) for name in ("one", "two")}
    for _, port in servers.values():
        await until(lambda port=port: answers(port))
    proxy = programs.haproxy({name: port for name, (_, port) in servers.items()})
    await until(lambda: answers(proxy))

    viewer, other = Viewer(proxy), Viewer(proxy)
    await come_back(viewer)
    first = viewer.server
    assert first in servers, viewer.cookie
    await viewer.socket.close()
    await come_back(viewer)
    assert viewer.server == first, "a viewer stays at its server"

    moved = await viewer.ask({"setLight": {"light": 1, "intensity": 400}})
    assert moved["sceneChanged"]["epoch"] == 1, moved
    process, _ = servers[first]
    process.kill()
    process.wait()
    await viewer.lost()
    await come_back(viewer)
    assert viewer.server != first, "it goes on at the other one"
    assert viewer.welcome["epoch"] == 1, viewer.welcome["epoch"]
    assert abs(viewer.welcome["scene"]["lights"][0]["intensity"] - 400) < 0.01
    await come_back(other)
    assert other.server == viewer.server
    print("ok: sticky, failed over at the same epoch")


def main():
    with tempfile.TemporaryDirectory() as folder:
        programs = Programs(folder)
        try:
            asyncio.run(run(programs))
        finally:
            programs.end()


if __name__ == "__main__":
    main()
