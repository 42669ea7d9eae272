#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The Python client against a real server; run by run_in_environment.py."""
import asyncio
import base64
import faulthandler
import hmac
import io
import json
import os
import signal
import struct
import sys
import tempfile
import time
import unittest
import zlib
from datetime import datetime, timedelta, timezone
from pathlib import Path

import numpy as np

import raybundle
from raybundle import link, messages, recording
from served import EXECUTABLE, LONGEST, ROOT, Daemon, run

BOX = str(ROOT / "scenes/cornell_box.gltf")
EXAMPLES = ROOT / "protocol/python/examples"


def room_with_a_lamp(folder):
    """The Cornell box with a point light named `lamp`, where lamps may be moved."""
    scene = json.loads(Path(BOX).read_text())
    scene.setdefault("extensionsUsed", []).append("KHR_lights_punctual")
    scene.setdefault("extensions", {})["KHR_lights_punctual"] = {
        "lights": [{"type": "point", "name": "lamp", "color": [1, 1, 1], "intensity": 200}]}
    scene["nodes"].append({"name": "lamp", "translation": [2.7, 4.5, 2.7],
                           "extensions": {"KHR_lights_punctual": {"light": 0}}})
    scene["scenes"][0]["nodes"].append(len(scene["nodes"]) - 1)
    file = Path(folder) / "room.gltf"
    file.write_text(json.dumps(scene))
    return str(file)


class WithServer(unittest.IsolatedAsyncioTestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.daemon = Daemon(room_with_a_lamp(folder.name))
        cls.addClassCleanup(cls.daemon.end)

    async def connect(self, **options):
        client = await raybundle.connect(self.daemon.address, viewport=(160, 120), **options)
        self.addAsyncCleanup(client.close)
        return client

    async def asyncTearDown(self):
        client = await raybundle.connect(self.daemon.address, viewport=(64, 48))
        if client.epoch:
            await client.undo(0)
        await client.close()


class Requests(WithServer):
    async def test_the_welcome_lists_the_scene(self):
        client = await self.connect(name="Ada")
        self.assertEqual(client.role, "EDITOR")
        self.assertIn("short box", [thing.name for thing in client.scene.objects])
        self.assertEqual(client.welcome.name, "Ada")

    async def test_a_picture_is_an_array_of_its_size(self):
        client = await self.connect()
        await client.use_camera(client.scene.cameras[0].name)
        await client.settled(0.5)
        frame = await client.picture()
        pixels = frame.image()
        self.assertEqual(pixels.shape, (frame.header.height, frame.header.width, 3))
        self.assertGreater(int(pixels.max()), 64)

    async def test_a_picture_shows_the_changes_made_before_it(self):
        client = await self.connect()
        await client.set_light("lamp", dim=0.5)
        changed = await client.set_light("lamp", on=False)
        frame = await client.picture()
        self.assertGreaterEqual(frame.header.epoch, changed.epoch)

    async def test_a_move_keeps_what_it_does_not_name(self):
        client = await self.connect()
        box = client.state.object("short box")
        scale, before = box.transform.scale.x, client.epoch
        changed = await client.move("short box", translation=(2.0, 0.0, 1.7))
        self.assertEqual(changed.epoch, before + 1)
        self.assertEqual(client.epoch, before + 1)
        now = client.state.object(box.id).transform
        self.assertAlmostEqual(now.translation.x, 2.0)
        self.assertEqual(now.translation.y, 0.0)
        self.assertEqual(now.scale.x, scale)

    async def test_others_see_what_is_copied_and_removed(self):
        one, other = await self.connect(name="one"), await self.connect(name="other")
        box = one.state.object("short box")
        addition = messages.AddObject(copy_of=box.id, name="second box")
        addition.transform.CopyFrom(box.transform)
        addition.transform.translation.x += 0.5
        changed = (await one.request(add_object=addition)).scene_changed
        await other.wait_for(lambda: other.epoch >= changed.epoch)
        added = other.state.object("second box")
        self.assertEqual(added.id, changed.add_object.object)
        self.assertAlmostEqual(added.transform.translation.x, box.transform.translation.x + 0.5, places=5)
        changed = (await one.request(remove_object=messages.RemoveObject(object=box.id))).scene_changed
        await other.wait_for(lambda: other.epoch >= changed.epoch)
        self.assertNotIn("short box", [thing.name for thing in other.scene.objects])

    async def test_others_see_changes_of_lights_groups_materials_and_pins(self):
        one, other = await self.connect(name="one"), await self.connect(name="other")
        stream = other.messages()
        first = asyncio.ensure_future(stream.__anext__())
        await one.set_light("lamp", intensity=321.0, position=(1.0, 4.0, 1.0), colour_temperature=3000)
        await one.set_group("desks", dim=0.25, lights=["lamp"])
        material = one.scene.materials[0]
        await one.set_material(material.id, base_colour=(0.1, 0.2, 0.3))
        pin = await one.add_pin("glare", (1.0, 0.0, 1.0))
        await other.wait_for(lambda: pin.pin in other.pins)
        lamp = other.state.light("lamp")
        self.assertAlmostEqual(lamp.intensity, 321.0, places=3)
        self.assertAlmostEqual(lamp.position.y, 4.0, places=5)
        self.assertAlmostEqual(lamp.dim, 0.25)
        self.assertEqual([list(group.lights) for group in other.scene.groups], [[lamp.id]])
        self.assertAlmostEqual(other.state.material(material.id).base_colour.z, 0.3, places=6)
        self.assertTrue((await first).HasField("reply_to") is False)
        history = await other.changes()
        self.assertEqual(history[-1].by_name, "one")
        await one.remove_pin(pin.pin)
        await other.wait_for(lambda: pin.pin not in other.pins)
        await stream.aclose()

    async def test_lighting_scenes_come_back(self):
        client = await self.connect()
        await client.set_light("lamp", dim=0.5)
        await client.save_lighting_scene("dim")
        self.assertEqual([scene.name for scene in client.scene.lighting_scenes], ["dim"])
        await client.set_light("lamp", dim=1.0)
        await client.apply_lighting_scene("dim", fade_seconds=60.0)
        self.assertAlmostEqual(client.state.light("lamp").dim, 0.5)
        late = await self.connect()
        self.assertEqual([fade.light for fade in late.scene.fades], [client.state.light("lamp").id])
        await client.set_group("all", dim=1.0, lights=["lamp"], fade_seconds=0.0)
        self.assertAlmostEqual(client.state.light("lamp").dim, 1.0)
        with self.assertRaises(raybundle.RequestRefused) as caught:
            await client.set_group("all", dim=0.5, fade_seconds=61.0)
        self.assertIn("setGroup.fadeSeconds", caught.exception.message)

    async def test_daylight_by_the_clock(self):
        client = await self.connect()
        noon = datetime(2026, 6, 21, 13, 10, tzinfo=timezone(timedelta(hours=2)))
        changed = await client.set_daylight("clear", time=noon, place=(52.52, 13.4))
        self.assertAlmostEqual(changed.set_daylight.sun_elevation, 61.0, delta=1.0)
        self.assertIn("SKY", [raybundle.messages.Light.Kind.Name(light.kind) for light in client.scene.lights])
        with self.assertRaises(ValueError):
            await client.set_daylight(time=datetime(2026, 6, 21))

    async def test_refusals_name_code_and_field(self):
        client = await self.connect()
        with self.assertRaises(raybundle.RequestRefused) as caught:
            await client.request(move_object=raybundle.messages.MoveObject(
                object=99, transform=raybundle.messages.Transform()))
        self.assertIn(caught.exception.code, ("INVALID_ARGUMENT", "NOT_FOUND"))
        self.assertIn("moveObject.object", caught.exception.message)
        with self.assertRaises(KeyError) as unknown:
            await client.set_light("nothing")
        self.assertIn("lamp", str(unknown.exception))

    async def test_a_request_that_is_repeated_under_its_key_is_made_once(self):
        client = await self.connect()
        body = raybundle.messages.SetLight(light=client.state.light("lamp").id, dim=0.5)
        first = await client.request(request_key="key-1", set_light=body)
        again = await client.request(request_key="key-1", set_light=body)
        self.assertEqual(first.scene_changed.epoch, again.scene_changed.epoch)
        self.assertEqual(client.epoch, first.scene_changed.epoch)
        with self.assertRaises(raybundle.RequestRefused):
            await client.request(request_key="with blanks", set_light=body)

    async def test_measured_light_has_an_interval(self):
        client = await self.connect()
        found = await client.measure(area=((1, 2, 1), (3, 0, 0), (0, 0, 3)), grid=(3, 2), relative_error=0.2)
        self.assertEqual((found.columns, found.rows, len(found.points)), (3, 2, 6))
        self.assertLess(found.mean_low, found.mean)
        self.assertLess(found.mean, found.mean_high)

    async def test_a_snapshot_is_radiance(self):
        client = await self.connect()
        await client.use_camera(client.scene.cameras[0].name)
        shot = await client.snapshot(96, 64, relative_error=0.3)
        self.assertLessEqual(shot.relative_error, 0.3)
        luminance = shot.luminance()
        self.assertEqual(luminance.shape, (64, 96))
        self.assertTrue(np.isfinite(luminance).all())
        self.assertGreater(float(luminance.mean()), 1.0)  # a lamp of 1356 cd/m² is in view
        png = await client.snapshot(96, 64, relative_error=0.5, format="PNG")
        self.assertEqual(png.image().shape, (64, 96, 3))

    async def test_a_snapshot_can_be_taken_back(self):
        client = await self.connect()
        task = asyncio.ensure_future(client.snapshot(640, 480, relative_error=1e-5))
        await asyncio.sleep(0)
        await client.wait_for(lambda: client.solution is not None)
        task.cancel()
        with self.assertRaises(asyncio.CancelledError):
            await task


class Recording(WithServer):
    async def meeting(self, file):
        listener, ada = await self.connect(name="listener"), await self.connect(name="Ada")
        end = asyncio.Event()
        task = asyncio.ensure_future(recording.record(listener, file, end))
        await asyncio.sleep(0)
        await ada.move("short box", translation=(2.0, 0.8, 1.7))
        await ada.set_light("lamp", intensity=50.0, position=(1.0, 4.0, 1.0))
        await ada.set_material(ada.scene.materials[0].id, base_colour=(0.1, 0.2, 0.3))
        await ada.add_pin("too dark", (1.0, 0.0, 1.0))
        await listener.wait_for(lambda: listener.epoch == ada.epoch and listener.pins)
        end.set()
        await task
        for pin in list(ada.pins):
            await ada.remove_pin(pin)
        await listener.wait_for(lambda: not listener.pins)
        await ada.undo(0)
        return ada

    async def test_what_is_replayed_ends_as_the_meeting_did(self):
        file = io.StringIO()
        ada = await self.meeting(file)
        file.seek(0)
        self.assertEqual(await recording.replay(ada, file), [])
        self.assertAlmostEqual(ada.state.light("lamp").intensity, 50.0, places=3)
        self.assertEqual([pin.text for pin in ada.pins.values()], ["too dark"])
        await ada.set_light("lamp", intensity=60.0)
        last = json.loads(file.getvalue().splitlines()[-1])["end"]["state"]
        self.assertEqual(len(recording.differences(last, recording.state_of(ada.scene))), 1)
        for pin in list(ada.pins):
            await ada.remove_pin(pin)

    async def test_minutes_say_who_did_what(self):
        file = io.StringIO()
        await self.meeting(file)
        file.seek(0)
        text = recording.minutes(file)
        self.assertIn("Ada moved object", text)
        self.assertIn("Ada: too dark", text)

    def test_what_is_no_recording_is_refused_and_a_torn_end_is_not(self):
        with self.assertRaises(raybundle.RaybundleError):
            list(recording.read(io.StringIO("{}\n")))
        with self.assertRaises(raybundle.RaybundleError):
            list(recording.read(io.StringIO('{"s":0,"begin":{"format":"other"}}\n')))
        begin = json.dumps({"s": 0, "begin": {"format": recording.FORMAT}}) + "\n"
        self.assertEqual(len(list(recording.read(io.StringIO(begin + '{"s":1,"sce')))), 1)


class Reconnecting(unittest.IsolatedAsyncioTestCase):
    async def test_a_client_comes_back_to_another_server_as_it_was(self):
        first, second = Daemon(BOX), Daemon(BOX)
        self.addCleanup(second.end)
        async with await raybundle.connect([first.address, second.address], name="Ada", viewport=(160, 120)) as client:
            await client.set_camera((2.7, 2.7, -5.0), (2.7, 2.7, 2.7), vertical_fov=0.9)
            await client.set_viewport(96, 64)
            await client.picture()
            first.end(signal.SIGKILL)
            await client.wait_for(lambda: client.connections == 2)
            self.assertIn(str(second.port), client.address)
            await client.wait_for(lambda: any(viewer.viewer == client.viewer and abs(viewer.eye.z + 5.0) < 1e-6
                                              and abs(viewer.vertical_fov - 0.9) < 1e-6
                                              for viewer in client.viewers))
            frame = await client.wait_for(lambda: client.frame)
            self.assertLessEqual(frame.header.width, 160)
            self.assertEqual(client.welcome.name, "Ada")

    async def test_without_reconnection_what_waits_hears_of_the_end(self):
        daemon = Daemon(BOX)
        async with await raybundle.connect(daemon.address, viewport=(64, 48), reconnect=False) as client:
            waiting = asyncio.ensure_future(client.snapshot(640, 480, relative_error=1e-5))
            await client.wait_for(lambda: client.solution is not None)
            daemon.end(signal.SIGKILL)
            with self.assertRaises(raybundle.ConnectionClosed):
                await waiting
            with self.assertRaises(raybundle.ConnectionClosed):
                await client.wait_for(lambda: False)


def signed_token(secret, claims):
    """A JSON Web Token by HS256."""
    def encode(data):
        return base64.urlsafe_b64encode(data).rstrip(b"=")
    text = encode(b'{"alg":"HS256"}') + b"." + encode(json.dumps(claims).encode())
    return (text + b"." + encode(hmac.digest(secret, text, "sha256"))).decode()


class LoginTokens(unittest.IsolatedAsyncioTestCase):
    def config(self, **jwt):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        secret = Path(folder.name) / "secret"
        secret.write_bytes(b"s" * 32 + b"\n")
        file = Path(folder.name) / "config.json"
        file.write_text(json.dumps({"jwt": {"issuer": "https://login.example", "audience": "raybundle",
                                            "secretFile": str(secret), **jwt}}))
        return str(file)

    async def test_who_comes_by_a_token_of_the_login_service_has_its_name_and_role(self):
        daemon = Daemon(BOX, "--config", self.config(roleClaim="roles"))
        self.addCleanup(daemon.end)
        claims = {"iss": "https://login.example", "aud": "raybundle", "sub": "42", "name": "Ada",
                  "roles": ["staff", "REVIEWER"], "exp": time.time() + 3600}
        async with await raybundle.connect(daemon.address, viewport=(64, 48), name="somebody",
                                           token=signed_token(b"s" * 32, claims)) as client:
            self.assertEqual((client.role, client.welcome.name), ("REVIEWER", "Ada"))
            with self.assertRaises(raybundle.RequestRefused) as refused:
                await client.undo(0)
            self.assertEqual(refused.exception.code, "PERMISSION_DENIED")
        for token in (signed_token(b"s" * 32, {**claims, "exp": time.time() - 1}), signed_token(b"t" * 32, claims), ""):
            with self.assertRaises(raybundle.RequestRefused) as refused:
                await raybundle.connect(daemon.address, token=token)
            self.assertEqual(refused.exception.code, "UNAUTHENTICATED")

    def test_settings_that_are_wrong_end_the_server(self):
        for wrong, reason in (({"audience": ""}, "audience"), ({"secretFile": "/nowhere"}, "/nowhere"),
                              ({"isuer": "a"}, "did you mean 'issuer'"), ({"keyFiles": 3}, "keyFiles: must be")):
            done = run(EXECUTABLE, "serve", BOX, "--config", self.config(**wrong))
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(reason, done.stderr)


class Addresses(unittest.TestCase):
    def test_of_page_and_socket(self):
        for given, socket in (("127.0.0.1:8080", "ws://127.0.0.1:8080/ws"), ("http://a:1/", "ws://a:1/ws"),
                              ("https://a.example/light/", "wss://a.example/light/ws"), ("ws://a:1/ws", "ws://a:1/ws"),
                              ("http://[::1]:8080", "ws://[::1]:8080/ws")):
            self.assertEqual(link.socket_address(given), socket)
        self.assertEqual(link.page_address("wss://a.example/light/ws"), "https://a.example/light")
        for wrong in ("ftp://a/", "", "ws://"):
            with self.assertRaises(ValueError):
                link.socket_address(wrong)


class ExrFiles(unittest.TestCase):
    def test_what_is_none_is_an_error(self):
        for wrong in (b"", b"\x89PNG" * 10, struct.pack("<i", 20000630) + b"\2\0\0\0",
                      struct.pack("<i", 20000630) + zlib.compress(b"a" * 100)):
            with self.assertRaises(raybundle.RaybundleError):
                raybundle.read_exr(wrong)


class Shell(WithServer):
    def run_client(self, *arguments, status=0):
        done = run(os.environ["RAYBUNDLE_CLIENT"], "--server", self.daemon.address, "--size", "96x64", *arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        return json.loads(done.stdout) if done.stdout else done.stderr

    def test_commands(self):
        self.assertEqual(self.run_client("info")["role"], "EDITOR")
        self.assertEqual(self.run_client("light", "lamp", "--dim", "0.5")["setLight"]["dim"], 0.5)
        self.assertIn("moveObject", self.run_client("move", "short box", "2,0,1.7"))
        self.assertIn("setDaylight", self.run_client("daylight", "overcast", "--elevation", "30", "--azimuth", "180"))
        self.assertEqual(len(self.run_client("measure", "--point", "2,2,2", "--error", "0.3")["points"]), 1)
        self.assertIn("ok", self.run_client("send", '{"setTarget":{"seconds":1}}'))
        self.assertGreaterEqual(len(self.run_client("changes")["changes"]), 3)
        self.assertGreater(self.run_client("undo", "0")["epoch"], 3)
        with tempfile.TemporaryDirectory() as folder:
            self.run_client("save", "-o", f"{folder}/a.glb")
            self.assertEqual(Path(f"{folder}/a.glb").read_bytes()[:4], b"glTF")
            self.run_client("picture", "--error", "0.5", "-o", f"{folder}/a.jpg")
            self.run_client("snapshot", "--error", "0.5", "-o", f"{folder}/a.exr")
            self.assertEqual(raybundle.read_exr(Path(f"{folder}/a.exr").read_bytes()).shape, (64, 96, 3))

    def test_exit_status_and_reason(self):
        self.assertIn("no light 'x'", self.run_client("light", "x", "--dim", "0.5", status=2))
        self.assertIn("INVALID_ARGUMENT", self.run_client("light", "lamp", "--dim", "7", status=1))
        done = run(os.environ["RAYBUNDLE_CLIENT"], "--server", "127.0.0.1:1", "info")
        self.assertEqual(done.returncode, 3, done.stderr)


class Examples(WithServer):
    def run_example(self, name, *arguments):
        return run(sys.executable, EXAMPLES / name, *arguments)

    def test_lamp_positions_end_in_a_plot_and_leave_the_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "plot.svg"
            done = self.run_example("lamp_positions.py", self.daemon.address, "lamp", "--from", "1,4.5,2.7", "--to",
                                    "4.5,4.5,2.7", "--steps", "2", "--plane", "1,2,1", "3,0,0", "0,0,3", "--error",
                                    "0.3", "-o", file)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.count(" lx, uniformity"), 2)
            self.assertIn("<svg", file.read_text())

        async def lamp():
            async with await raybundle.connect(self.daemon.address) as client:
                return client.state.light("lamp").position.x
        self.assertAlmostEqual(asyncio.run(lamp()), 2.7, places=5)

    def test_a_day_is_numbered_pictures(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_example("day_time_lapse.py", self.daemon.address, "--place", "52.52,13.4", "--date",
                                    "2026-06-21", "--zone", "2", "--begin", "12", "--end", "13", "--error", "0.5",
                                    "--size", "96x64", "-o", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(sorted(path.name for path in Path(folder).iterdir()), ["000.jpg", "001.jpg"])

    def test_a_check_ends_by_what_it_has_found(self):
        plane = [[1, 2, 1], [3, 0, 0], [0, 0, 3]]
        for required, status in ((1, 0), (1e6, 5)):  # as of `raybundle measure`
            with self.subTest(required), tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "requirements.json"
                file.write_text(json.dumps([{"name": "plane", "plane": plane, "grid": [3, 3], "mean": required}]))
                done = self.run_example("check_lighting.py", self.daemon.address, file, "--error", "0.3")
                self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "requirements.json"
            self.assertEqual(self.run_example("check_lighting.py", "127.0.0.1:1", file).returncode, 2)
            file.write_text("[]")
            self.assertEqual(self.run_example("check_lighting.py", "127.0.0.1:1", file).returncode, 1)


class WithinLimit(unittest.TextTestResult):
    """Prints where all threads stand, and ends, when one test takes longer than LONGEST and what it may wait for."""

    def startTest(self, test):
        faulthandler.dump_traceback_later(2 * LONGEST, exit=True)
        super().startTest(test)

    def stopTest(self, test):
        faulthandler.cancel_dump_traceback_later()
        super().stopTest(test)


if __name__ == "__main__":
    unittest.main(testRunner=unittest.TextTestRunner(resultclass=WithinLimit, verbosity=2))
