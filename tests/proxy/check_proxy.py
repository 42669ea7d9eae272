#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Starts a server and one of the proxy examples of deploy/proxy in front of it, with addresses and
certificate of this test in place of those of the example, and talks to the server through it:
pages, WebSocket messages and frames, uploads, and what must not pass.

usage: check_proxy.py nginx|haproxy RAYBUNDLE ROOT       exit status 77: the proxy is not installed
"""
import http.client
import json
import os
import pathlib
import re
import shutil
import socket
import ssl
import struct
import subprocess
import sys
import tempfile
import time

EDITOR = "1" * 64
KEY = "dGhlIHNhbXBsZSBub25jZQ=="


def free_port():
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        return sock.getsockname()[1]


def wait_for_port(port, seconds=60.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            socket.create_connection(("127.0.0.1", port), 1.0).close()
            return
        except OSError:
            time.sleep(0.1)
    raise RuntimeError(f"nothing listens on {port}")


def certificate(folder):
    """A key and a certificate of this machine, and both in one file as HAProxy wants them."""
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
         "-days", "2", "-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost",
         "-keyout", folder / "key.pem", "-out", folder / "cert.pem"],
        check=True, capture_output=True)
    both = (folder / "cert.pem").read_text() + (folder / "key.pem").read_text()
    (folder / "both.pem").write_text(both)


def nginx(example, folder, port, backend):
    text = re.sub(r"listen 443", f"listen 127.0.0.1:{port}", example)
    text = re.sub(r"\n\s*listen \[::\]:443[^\n]*", "", text)
    text = re.sub(r"/etc/letsencrypt\S+fullchain.pem", str(folder / "cert.pem"), text)
    text = re.sub(r"/etc/letsencrypt\S+privkey.pem", str(folder / "key.pem"), text)
    text = text.replace("127.0.0.1:8080", f"127.0.0.1:{backend}")
    temporary = "".join(f"{kind}_temp_path {folder}/{kind};\n"
                        for kind in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
    (folder / "nginx.conf").write_text(
        f"daemon off;\npid {folder}/pid;\nerror_log {folder}/error.log;\nevents {{}}\n"
        f"http {{\naccess_log off;\n{temporary}\n{text}\n}}\n")
    return ["nginx", "-p", str(folder), "-c", str(folder / "nginx.conf")]


def haproxy(example, folder, port, backend):
    text = example.replace("bind :443", f"bind 127.0.0.1:{port}")
    text = text.replace("/etc/haproxy/certs/raybundle.pem", str(folder / "both.pem"))
    text = text.replace("127.0.0.1:8080", f"127.0.0.1:{backend}")
    (folder / "haproxy.cfg").write_text(text)
    return ["haproxy", "-db", "-f", str(folder / "haproxy.cfg")]


def wait_until_healthy(port, seconds=30.0):
    """Until the server has a solution to show: a proxy that asks before takes it for broken."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
        connection.request("GET", "/healthz")
        if connection.getresponse().status == 200:
            return
        connection.close()
        time.sleep(0.1)
    sys.exit(f"the server is not healthy after {seconds} s")


class Checks:
    def __init__(self, port, folder):
        self.port = port
        self.tls = ssl.create_default_context(cafile=folder / "cert.pem")
        self.failures = 0

    def expect(self, holds, what):
        print(("ok: " if holds else "FAILED: ") + what, flush=True)
        self.failures += not holds

    def request(self, method, path, body=None, headers=None):
        connection = http.client.HTTPSConnection("localhost", self.port, context=self.tls, timeout=30)
        connection.request(method, path, body, headers or {})
        answer = connection.getresponse()
        return answer.status, answer.headers, answer.read()

    def websocket(self, origin):
        """A connection that has been upgraded, or the status that refuses it."""
        sock = self.tls.wrap_socket(socket.create_connection(("localhost", self.port), 30),
                                    server_hostname="localhost")
        sock.settimeout(30)
        sock.sendall((f"GET /ws HTTP/1.1\r\nHost: localhost:{self.port}\r\nUpgrade: websocket\r\n"
                      f"Connection: Upgrade\r\nSec-WebSocket-Key: {KEY}\r\nSec-WebSocket-Version: 13"
                      f"\r\nSec-WebSocket-Protocol: raybundle.v1\r\nOrigin: {origin}\r\n\r\n").encode())
        stream = sock.makefile("rb")
        status = int(stream.readline().split()[1])
        while stream.readline() not in (b"\r\n", b""):
            pass
        return status, sock, stream

    def run(self):
        status, headers, body = self.request("GET", "/")
        self.expect(status == 200 and b"<html" in body, "the page comes through")
        self.expect("content-security-policy" in headers, "with its security headers")
        self.expect("strict-transport-security" in headers, "and those of the proxy")
        self.expect(self.websocket("https://elsewhere.example")[0] == 403,
                    "a page of another origin may not connect")
        status, sock, stream = self.websocket(f"https://localhost:{self.port}")
        self.expect(status == 101, "the server's own page may")
        if status == 101:
            self.talk(sock, stream)
        scene = pathlib.Path(sys.argv[3], "scenes/cornell_box.gltf").read_bytes()
        scene += b" " * (-len(scene) % 4)
        glb = (b"glTF" + struct.pack("<3I", 2, 20 + len(scene), len(scene)) + b"JSON" + scene)
        token = {"Authorization": "Bearer " + EDITOR}
        self.expect(self.request("PUT", "/scenes/box.glb", glb, token)[0] == 201, "a scene is stored")
        large = b"glTF" + bytes(3_000_000)
        self.expect(self.request("PUT", "/scenes/large.glb", large, token)[0] == 422,
                    "three megabytes arrive whole, and are rejected for what they are")

    def talk(self, sock, stream):
        def send(message):
            payload = json.dumps(message).encode()
            sock.sendall(struct.pack(">BBH4x", 0x81, 0x80 | 126, len(payload)) + payload)

        def receive():
            first, size = struct.unpack(">BB", stream.read(2))
            if size >= 126:
                size = struct.unpack(">H" if size == 126 else ">Q",
                                     stream.read(2 if size == 126 else 8))[0]
            return first & 15, stream.read(size)

        send({"id": 1, "hello": {"protocol": "1.0", "token": EDITOR,
                                 "viewport": {"width": 160, "height": 120}}})
        welcomed, frames = False, 0
        while frames < 10:
            opcode, payload = receive()
            if opcode == 1:
                welcomed = welcomed or "welcome" in json.loads(payload)
            elif opcode == 2:
                length = struct.unpack("<I", payload[:4])[0]
                header = json.loads(payload[4:4 + length])
                frames += 1
                send({"ack": {"frame": header["frame"], "decodeMs": 1}})
        self.expect(welcomed, "messages pass both ways")
        self.expect(frames == 10, "and frames, each acknowledged")


def main():
    kind, raybundle, root = sys.argv[1:4]
    if shutil.which(kind) is None and not os.path.exists(f"/usr/sbin/{kind}"):
        print(f"{kind} is not installed")
        return 77
    os.environ["PATH"] += ":/usr/sbin"
    example = pathlib.Path(root, "deploy/proxy",
                           {"nginx": "nginx.conf", "haproxy": "haproxy.cfg"}[kind]).read_text()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        os.chmod(folder, 0o755)
        (folder / "scenes").mkdir()
        certificate(folder)
        digest = subprocess.run(["sha256sum"], input=EDITOR.encode(), capture_output=True,
                                check=True).stdout.split()[0].decode()
        (folder / "site.json").write_text(
            json.dumps({"tokens": [{"name": "a", "role": "EDITOR", "sha256": digest}]}))
        backend, port = free_port(), free_port()
        server = subprocess.Popen(
            [raybundle, "serve", root + "/scenes/cornell_box.gltf", "--listen",
             f"127.0.0.1:{backend}", "--config", folder / "site.json", "--scenes",
             folder / "scenes", "--log-level", "warn", "--journal", "none"])
        command = {"nginx": nginx, "haproxy": haproxy}[kind](example, folder, port, backend)
        proxy = None
        try:
            wait_for_port(backend)
            wait_until_healthy(backend)
            proxy = subprocess.Popen(command)
            wait_for_port(port, 20.0)
            checks = Checks(port, folder)
            if kind == "haproxy":
                time.sleep(3.0)  # until it has seen the server's health
            checks.run()
        finally:
            for process in (proxy, server):
                if process is not None:
                    process.terminate()
                    process.wait(20)
        return 1 if checks.failures else 0


if __name__ == "__main__":
    sys.exit(main())
