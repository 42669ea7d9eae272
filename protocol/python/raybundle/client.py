# SPDX-License-Identifier: Apache-2.0
"""A connection to a server: requests and their answers, what the server tells, pictures."""
from __future__ import annotations

import asyncio
import itertools
import ssl as ssl_module
import time
from typing import Any, AsyncIterator, Callable, Optional, Sequence

import websockets
from google.protobuf import json_format
from google.protobuf.message import Message

from . import messages
from .errors import ConnectionClosed, RaybundleError, RequestRefused
from .frames import Frame, read_frame
from .link import Addresses, Link, retry_delay
from .requests import Requests
from .scene_state import SceneState

PROTOCOL = "1.0"
_MOST_WAITING_MESSAGES = 1000
#: Answers to `hello` that another attempt, or another server, does not change.
_FINAL_CODES = ("UNAUTHENTICATED", "PERMISSION_DENIED", "UNIMPLEMENTED", "INVALID_ARGUMENT")
#: What a viewer has set for itself, and gets back after a reconnection.
_OWN_STATE = ("set_camera", "set_viewport", "set_target", "set_display", "set_hidden")


class Client(Requests):
    """An open session. Made by connect(); close it, or use it with `async with`.

    Where the connection is lost it comes back by itself, to the next of its addresses that answers, as the same
    name, with the same camera, size, target and display. Requests that waited raise ConnectionClosed: whether their
    change was made is seen in `epoch` and `scene`.
    """

    def __init__(self, addresses: Addresses, hello: messages.Hello, ssl: Optional[ssl_module.SSLContext],
                 reconnect: bool) -> None:
        self._link = Link(addresses, ssl)
        self._hello = hello
        self._reconnect = reconnect
        self._socket: Any = None
        self._reader: Optional[asyncio.Task[None]] = None
        self._ids = itertools.count(1)
        self._waiting: dict[int, asyncio.Future[Any]] = {}
        self._own: dict[str, Message] = {}
        self._news: set[asyncio.Queue[Any]] = set()
        self._heard = asyncio.Condition()
        self._failure: Optional[Exception] = None
        self._state: Any = None
        self.welcome: Any = None             #: the last Welcome
        self.frame: Optional[Frame] = None   #: the newest picture
        self.solution: Any = None            #: the newest Solution, of this connection
        self.viewers: Sequence[Any] = ()     #: who is here (Viewer)
        self.pins: dict[int, Any] = {}       #: PinChanged by number
        self.viewpoints: dict[int, Any] = {}
        self.connections = 0                 #: counts up with every connection

    # ------------------------------------------------------------------ what is known

    @property
    def scene(self) -> Any:
        """messages.Scene as it is now: objects, lights, materials, cameras, groups, daylight."""
        return self._state.scene

    @property
    def state(self) -> SceneState:
        state: SceneState = self._state
        return state

    @property
    def epoch(self) -> int:
        """Changes of the scene that this client knows of."""
        return self.state.epoch

    @property
    def viewer(self) -> int:
        """This viewer's number; another one after a reconnection."""
        return int(self.welcome.viewer)

    @property
    def role(self) -> str:
        return messages.Role.Name(self.welcome.role)

    @property
    def address(self) -> str:
        """Of the server's page; paths as those of snapshots are appended to it."""
        return self._link.page

    @property
    def ssl(self) -> Optional[ssl_module.SSLContext]:
        return self._link.ssl

    @property
    def token(self) -> str:
        return str(self._hello.token)

    # ------------------------------------------------------------------ opening and closing

    async def __aenter__(self) -> "Client":
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def open(self) -> None:
        """Connects and says hello. Raises RequestRefused, OSError or ConnectionClosed."""
        self._socket = await self._link.open()
        await self._greet()
        self._reader = asyncio.create_task(self._read())

    async def close(self) -> None:
        """Ends the session. What waits for answers raises ConnectionClosed."""
        self._reconnect = False
        if self._reader is not None:
            self._reader.cancel()
            await asyncio.gather(self._reader, return_exceptions=True)
        if self._socket is not None:
            await self._socket.close()
        await self._end(ConnectionClosed("the client has closed the connection"))

    async def _greet(self) -> None:
        request = messages.ClientMessage(id=next(self._ids), hello=self._hello)
        await self._socket.send(request.SerializeToString())
        while True:
            try:
                received = await self._socket.recv()
            except websockets.ConnectionClosed as closed:
                raise ConnectionClosed(f"the server has closed the connection: {closed}") from closed
            if isinstance(received, bytes):
                continue
            message = _parse(received)
            if message.HasField("error"):
                raise RequestRefused(messages.Error.Code.Name(message.error.code), message.error.message)
            if message.HasField("welcome"):
                self._take_welcome(message.welcome)
                return

    def _take_welcome(self, welcome: Any) -> None:
        self.welcome = welcome
        self._state = SceneState(welcome)
        self.pins = {pin.pin: pin for pin in welcome.pins}
        self.viewpoints = {view.viewpoint: view for view in welcome.viewpoints}
        self.solution = None
        self.frame = None
        self.connections += 1

    # ------------------------------------------------------------------ requests

    async def request(self, *, request_key: Optional[str] = None, traceparent: Optional[str] = None, **body: Any) -> Any:
        """Sends one message of the protocol and returns its answer, a ServerMessage.

        await client.request(set_light=messages.SetLight(light=1, dim=0.5)); a dict stands for a message, too.
        request_key: of a change, any new text of 1 to 64 visible ASCII characters. After ConnectionClosed the same
        request under the same key makes the change if it was not made, and is answered as before if it was.
        traceparent: of a change, the trace that it is a part of (W3C Trace Context, as OpenTelemetry's propagators write).
        Raises RequestRefused, ConnectionClosed; ValueError and TypeError for what is no message.
        """
        _, answer = await self.begin_request(request_key=request_key, traceparent=traceparent, **body)
        return await answer

    async def begin_request(
        self, *, request_key: Optional[str] = None, traceparent: Optional[str] = None, **body: Any
    ) -> tuple[int, "asyncio.Future[Any]"]:
        """The same without waiting: the request's number, and the answer to come."""
        if len(body) != 1:
            raise ValueError("a request has exactly one body")
        if self._failure is not None:
            raise self._failure
        message: Any = messages.ClientMessage(id=next(self._ids), request_key=request_key, traceparent=traceparent, **body)
        name = message.WhichOneof("body")
        answer: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        self._waiting[message.id] = answer
        try:
            await self._socket.send(message.SerializeToString())
        except websockets.ConnectionClosed as closed:
            self._waiting.pop(message.id, None)
            raise ConnectionClosed(f"the connection is lost: {closed}") from closed
        if name in _OWN_STATE:
            self._own[name] = message
        return message.id, answer

    # ------------------------------------------------------------------ what the server tells

    async def messages(self) -> AsyncIterator[Any]:
        """Every ServerMessage from now on that answers no request of this client. Who reads too slowly loses the
        oldest ones; state that matters is in this object."""
        queue: asyncio.Queue[Any] = asyncio.Queue(_MOST_WAITING_MESSAGES)
        self._news.add(queue)
        try:
            while True:
                message = await queue.get()
                if message is None:
                    return
                yield message
        finally:
            self._news.discard(queue)

    async def frames(self) -> AsyncIterator[Frame]:
        """Pictures as they come; of several that came meanwhile the newest alone."""
        shown: Optional[Frame] = None
        while True:
            shown = await self.wait_for(lambda last=shown: self.frame if self.frame is not last else None)
            yield shown

    async def wait_for(self, condition: Callable[[], Any], timeout: Optional[float] = None) -> Any:
        """Waits until something that the server tells makes condition() true, and returns what it returned. Raises
        asyncio.TimeoutError after `timeout` seconds, ConnectionClosed once no server can be reached any more."""
        end = None if timeout is None else time.monotonic() + timeout
        async with self._heard:
            while True:
                result = condition()
                if result:
                    return result
                if self._failure is not None:
                    raise self._failure
                left = None if end is None else max(end - time.monotonic(), 0.0)
                await asyncio.wait_for(self._heard.wait(), left)

    # ------------------------------------------------------------------ the reader

    async def _read(self) -> None:
        while True:
            try:
                async for received in self._socket:
                    await self._take(received)
                reason = f"the server has closed the connection ({self._socket.close_code})"
            except websockets.ConnectionClosed as closed:
                reason = f"the connection is lost: {closed}"
            except RaybundleError as error:
                reason = str(error)
            self._fail_waiting(ConnectionClosed(reason))
            if not self._reconnect or not await self._come_back():
                await self._end(ConnectionClosed(reason))
                return

    async def _come_back(self) -> bool:
        """False: the server does not want this client."""
        for attempt in itertools.count():
            try:
                self._socket = await self._link.open()
                await self._greet()
                for message in self._own.values():
                    await self._socket.send(message.SerializeToString())
                async with self._heard:
                    self._heard.notify_all()
                return True
            except RequestRefused as refused:
                if refused.code in _FINAL_CODES:
                    return False
                self._link.prefer_next()
            except (OSError, asyncio.TimeoutError, ConnectionClosed, websockets.WebSocketException):
                self._link.prefer_next()
            await asyncio.sleep(retry_delay(attempt))
        return False

    async def _end(self, failure: Exception) -> None:
        self._failure = self._failure or failure
        self._fail_waiting(failure)
        for queue in self._news:
            _put(queue, None)
        async with self._heard:
            self._heard.notify_all()

    def _fail_waiting(self, failure: Exception) -> None:
        waiting, self._waiting = self._waiting, {}
        for answer in waiting.values():
            if not answer.done():
                answer.set_exception(failure)
                answer.exception()  # not to be reported where nobody waits any more

    async def _take(self, received: Any) -> None:
        if isinstance(received, bytes):
            self.frame = read_frame(received)
            ack = messages.ClientMessage(ack=messages.Ack(frame=self.frame.header.frame))
            await self._socket.send(ack.SerializeToString())
        else:
            message = _parse(received)
            self._follow(message)
            if not self._answer(message):
                for queue in self._news:
                    _put(queue, message)
        async with self._heard:
            self._heard.notify_all()

    def _answer(self, message: Any) -> bool:
        answer = self._waiting.pop(message.reply_to, None) if message.HasField("reply_to") else None
        if answer is None or answer.done():
            return answer is not None
        if message.HasField("error"):
            answer.set_exception(RequestRefused(messages.Error.Code.Name(message.error.code), message.error.message))
        else:
            answer.set_result(message)
        return True

    def _follow(self, message: Any) -> None:
        body = message.WhichOneof("body")
        if body == "scene_changed":
            self.state.apply(message.scene_changed)
        elif body == "solution":
            self.solution = message.solution
        elif body == "presence":
            self.viewers = list(message.presence.viewers)
        elif body == "pin_changed":
            _keep(self.pins, message.pin_changed.pin, message.pin_changed)
        elif body == "viewpoint_changed":
            _keep(self.viewpoints, message.viewpoint_changed.viewpoint, message.viewpoint_changed)
        elif body == "lighting_scene_changed":
            self._follow_lighting_scene(message.lighting_scene_changed)

    def _follow_lighting_scene(self, changed: Any) -> None:
        kept = {scene.name: scene.by_name for scene in self.scene.lighting_scenes if scene.name != changed.name}
        if not changed.removed:
            kept[changed.name] = changed.by_name
        del self.scene.lighting_scenes[:]
        for name in sorted(kept):
            self.scene.lighting_scenes.add(name=name, by_name=kept[name])


def _parse(text: str) -> Any:
    message = messages.ServerMessage()
    try:
        json_format.Parse(text, message, ignore_unknown_fields=True)
    except json_format.ParseError as error:
        raise RaybundleError(f"the server has sent what cannot be read: {error}") from error
    return message


def _keep(entries: dict[int, Any], number: int, entry: Any) -> None:
    if entry.removed:
        entries.pop(number, None)
    else:
        entries[number] = entry


def _put(queue: "asyncio.Queue[Any]", item: Any) -> None:
    if queue.full():
        queue.get_nowait()
    queue.put_nowait(item)


async def connect(addresses: Addresses, *, name: str = "python", token: str = "",
                  viewport: tuple[int, int] = (800, 600), codecs: Sequence[str] = ("JPEG", "PNG"),
                  ssl: Optional[ssl_module.SSLContext] = None, reconnect: bool = True,
                  timeout: Optional[float] = 300.0) -> Client:
    """Opens a session, once the server's scene is ready.

    addresses: "HOST:PORT", the address of the page or of the socket; or several of them, of servers of one project.
    viewport: pixels. codecs: without PNG, pictures at rest are JPEG, too; not VP9, which
    nothing here decodes. timeout: seconds.
    Raises RequestRefused (wrong token, server full), OSError, asyncio.TimeoutError.
    """
    hello = messages.Hello(protocol=PROTOCOL, name=name, token=token, codecs=[messages.Codec.Value(c) for c in codecs],
                           viewport=messages.Viewport(width=viewport[0], height=viewport[1]))
    client = Client(addresses, hello, ssl, reconnect)
    try:
        await asyncio.wait_for(client.open(), timeout)
    except BaseException:
        await client.close()
        raise
    return client
