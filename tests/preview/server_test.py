# SPDX-License-Identifier: BSD-3-Clause
"""The preview server against visitors it must refuse or endure: arguments PROGRAM PAGE_FOLDER."""

import asyncio
import http.client
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import websockets

from browser import Preview, ask, receive

PROGRAM, PAGE = sys.argv[1], sys.argv[2]

ATOMS = "".join(f"ATOM  {n:5d}  C{n:<2d} UNL A   1    {3 * n:8.3f}{n:8.3f}{0:8.3f}  1.00 {n:5.2f}           C\n"
                for n in range(1, 6))


async def picture(client):
    await client.send('{"request":"picture"}')
    message = await receive(client, lambda m: m.get("event") == "picture")
    return message, await asyncio.wait_for(client.recv(), 30)


class Server(unittest.IsolatedAsyncioTestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file = self.path("five.pdb")
        with open(self.file, "w") as file:
            file.write(ATOMS)
        self.preview = self.serve("--size", "64x48")

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def serve(self, *arguments, **options):
        preview = Preview(PROGRAM, self.file, "--output-dir", self.folder.name, *arguments, **options)
        self.addCleanup(preview.end)
        return preview

    def get(self, path="", method="GET", **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.preview.port, timeout=20)
        token = self.preview.url.split("/")[3]
        connection.request(method, path if path.startswith("/") else f"/{token}/{path}", headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read(), answer.headers

    async def refused(self, status, **options):
        with self.assertRaises(websockets.exceptions.InvalidStatusCode) as caught:
            await self.preview.socket(**options)
        self.assertEqual(caught.exception.status_code, status)

    async def still_serves(self):
        async with self.preview.socket() as client:
            self.assertTrue((await ask(client, {"command": "state"}))["ok"])

    def test_the_page_is_whole_and_stands_under_a_strict_policy(self):
        for name in os.listdir(PAGE):
            with open(os.path.join(PAGE, name), "rb") as file:
                self.assertEqual(self.get(name)[:2], (200, file.read()), name)
        status, _, headers = self.get()
        self.assertEqual(status, 200)
        policy = headers["Content-Security-Policy"]
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("unsafe", policy)
        self.assertEqual(headers["Referrer-Policy"], "no-referrer")

    def test_strangers_are_refused(self):
        token = self.preview.url.split("/")[3]
        wrong = ("0" if token[0] != "0" else "1") + token[1:]
        for path in ("/", f"/{wrong}/", f"/{token}", f"/{token[:-1]}/", f"/{wrong}/page.js", "/favicon.ico"):
            self.assertEqual(self.get(path)[0], 403, path)
        self.assertEqual(self.get("?token=of-a-proxy")[:2], self.get()[:2])
        self.assertEqual(self.get(f"/?/{token}/")[0], 403)
        self.assertEqual(self.get("nothing.html")[0], 404)
        self.assertEqual(self.get("../../etc/passwd")[0], 404)
        self.assertEqual(self.get(method="POST")[0], 405)
        self.assertEqual(self.get(Host="example.org")[0], 403)
        self.assertEqual(self.get(Host=f"example.org:{self.preview.port}")[0], 403)
        self.assertEqual(self.get(Host=f"localhost:{self.preview.port}")[0], 200)

    def test_a_header_that_counts_is_there_once(self):
        host, origin = f"127.0.0.1:{self.preview.port}", f"http://127.0.0.1:{self.preview.port}"
        path = f"/{self.preview.url.split('/')[3]}/"
        for headers, status in (([("Host", host)], 200), ([("Host", host), ("Host", host)], 400),
                                ([("Host", host), ("host", "example.org")], 400), ([("Host", "example.org"), ("Host", host)], 400),
                                ([("Host", host), ("Origin", origin), ("Origin", "http://example.org")], 400)):
            connection = http.client.HTTPConnection("127.0.0.1", self.preview.port, timeout=20)
            connection.putrequest("GET", path, skip_host=True, skip_accept_encoding=True)
            for name, value in headers:
                connection.putheader(name, value)
            connection.endheaders()
            self.assertEqual(connection.getresponse().status, status, headers)

    async def test_a_page_is_told_what_is_read_and_then_served(self):
        preview = Preview(PROGRAM, "-", "--output-dir", self.folder.name, stdin=subprocess.PIPE)
        self.addCleanup(preview.end)
        self.preview = preview
        self.assertEqual(self.get()[0], 200, "the page is there before the molecule")
        async with preview.socket() as client:
            told = await receive(client, lambda message: message.get("event") == "progress")
            self.assertEqual(told["what"], "Reading standard input")
            await client.send('{"id":1,"command":"state"}')
            preview.process.stdin.write(ATOMS)
            preview.process.stdin.close()
            preview.process.stdin = None
            state = await receive(client, lambda message: message.get("id") == 1)
            self.assertEqual(state["atoms"], 5)
            self.assertIn("picture", (await picture(client))[0]["event"])
        async with preview.socket() as late:
            self.assertEqual(json.loads(await late.recv())["event"], "welcome")
            await late.send('{"id":2,"command":"stats"}')
            self.assertEqual(json.loads(await late.recv())["id"], 2, "nothing is read any more")

    async def test_what_cannot_be_read_is_told_to_pages_too(self):
        preview = Preview(PROGRAM, "-", "--output-dir", self.folder.name, stdin=subprocess.PIPE)
        self.addCleanup(preview.end)
        async with preview.socket() as client:
            await receive(client, lambda message: message.get("event") == "welcome")
            preview.process.stdin.write("nonsense")
            preview.process.stdin.close()
            preview.process.stdin = None
            ended = await receive(client, lambda message: message.get("event") == "ended")
            self.assertIn("standard input", ended["error"])
        self.assertEqual(preview.process.wait(timeout=30), 3)

    async def test_messages_begin_with_the_command_that_they_are_about(self):
        async with self.preview.socket() as client:
            for command in ({"command": "save", "path": "../x.json"}, {"command": "open", "path": "../x.json"},
                            {"command": "save", "path": "x.png"}, {"command": "export", "format": "png", "path": "../x.png"},
                            {"command": "undo"}, {"command": "press", "key": "Ctrl+z"}):
                reply = await ask(client, command)
                if command["command"] != "press":
                    self.assertFalse(reply["ok"], command)
                if not reply["ok"]:
                    self.assertTrue(reply["error"].startswith(command["command"] + ": "), reply)

    def test_a_token_of_the_users_own(self):
        token = "my-token_0123456789"
        with open(self.path("token"), "w") as file:
            file.write(token + "\n")
        for mode in (0o644, 0o640, 0o604, 0o620, 0o602):
            os.chmod(self.path("token"), mode)
            result = subprocess.run([PROGRAM, "preview", self.file, "--serve", "--token-file", self.path("token")],
                                    capture_output=True, text=True, timeout=60)
            self.assertEqual((result.returncode, result.stdout), (3, ""))
            self.assertRegex(result.stderr, r"\A\S*: error: .*/token: others can read or change the token; .*\n\Z")
        os.chmod(self.path("token"), 0o600)
        for options in ({"env": {**os.environ, "MENISCUS_TOKEN": token}}, {}):
            arguments = [] if options else ["--token-file", self.path("token")]
            self.preview = self.serve(*arguments, **options)
            self.assertTrue(self.preview.url.endswith(f"/{token}/"), self.preview.url)
            self.assertEqual(self.get()[0], 200)
            self.assertEqual(self.get(f"/{token[:-1]}/")[0], 403)
        for wrong in ("short", "with blanks in it, which is wrong", "x" * 129):
            result = subprocess.run([PROGRAM, "preview", self.file, "--serve"], capture_output=True, text=True,
                                    env={**os.environ, "MENISCUS_TOKEN": wrong}, timeout=60)
            self.assertEqual(result.returncode, 2)
            self.assertIn("MENISCUS_TOKEN: a token has 16 to 128 letters", result.stderr)
            self.assertNotIn(wrong, result.stderr)

    async def test_sockets_of_foreign_pages_are_refused(self):
        await self.refused(403, origin="http://example.org")
        await self.refused(403, origin=f"http://example.org:{self.preview.port}")
        await self.refused(403, origin=f"https://127.0.0.1:{self.preview.port}")
        await self.refused(403, origin=None)
        async with self.preview.socket(origin=f"http://localhost:{self.preview.port}"):
            pass

    async def test_a_proxy_is_trusted_by_its_name_and_no_other(self):
        """What jupyter-server-proxy 4 sends: Host and Origin of the page that the user sees, behind http or https."""
        self.preview = self.serve("--size", "64x48", "--trust-host", "hub.example.org", "--trust-host", "localhost:8888")
        for host in ("hub.example.org", "localhost:8888", f"127.0.0.1:{self.preview.port}"):
            self.assertEqual(self.get(Host=host)[0], 200, host)
        for host in ("hub.example.org:80", "hub.example.org.evil.com", "evil.hub.example.org", "localhost", "localhost:8889", "*", ""):
            self.assertEqual(self.get(Host=host)[0], 403, host)
        self.assertEqual(self.get("/" + "0" * 32 + "/", Host="hub.example.org")[0], 403, "without the token")
        policy = self.get(Host="hub.example.org")[2]["Content-Security-Policy"]
        self.assertIn("wss://hub.example.org", policy)
        self.assertNotIn("*", policy)
        for origin in ("http://hub.example.org", "https://hub.example.org", "https://localhost:8888"):
            address = f"ws://hub.example.org/{self.preview.url.split('/')[3]}/socket"
            async with websockets.connect(address, host="127.0.0.1", port=self.preview.port, origin=origin) as client:
                self.assertTrue((await ask(client, {"command": "state"}))["ok"], origin)
        for origin in ("https://hub.example.org:444", "https://hub.example.org.evil.com", "ws://hub.example.org", "null",
                       "https://hub.example.org/", "https://HUB.example.org@evil.com", f"https://127.0.0.1:{self.preview.port}"):
            await self.refused(403, origin=origin)
        for wrong in ("*", "*.example.org", "https://hub.example.org", "hub.example.org/lab", "", "Hub.example.org", "a b"):
            result = subprocess.run([PROGRAM, "preview", self.file, "--serve", "--trust-host", wrong], capture_output=True,
                                    text=True, timeout=60)
            self.assertEqual((result.returncode, result.stdout), (2, ""), wrong)
            self.assertIn("a host is a name", result.stderr)

    def test_names_of_others_stay_refused_at_every_address(self):
        """In a container it listens everywhere; a name that someone's DNS points there (rebinding) is still none of ours."""
        own = Preview(PROGRAM, self.file, "--output-dir", self.folder.name, port="0.0.0.0:0")
        self.addCleanup(own.end)
        self.preview = own
        with open("/proc/net/tcp") as file:
            self.assertIn(f"00000000:{own.port:04X}", file.read())
        self.assertEqual(self.get()[0], 200)
        for host in (f"0.0.0.0:{own.port}", f"evil.com:{own.port}", "evil.com", f"192.168.1.5:{own.port}"):
            self.assertEqual(self.get(Host=host)[0], 403, host)
        result = subprocess.run([PROGRAM, "preview", self.file, "--serve", "nowhere:8080"], capture_output=True, text=True,
                                timeout=60)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("nowhere", result.stderr)

    async def test_what_was_written_can_be_downloaded_and_nothing_else(self):
        with open(self.path("foreign.txt"), "w") as file:
            file.write("precious")
        async with self.preview.socket() as client:
            self.assertTrue((await ask(client, {"command": "save", "path": "fig.json"}))["ok"])
            self.assertTrue((await ask(client, {"command": "export", "format": "png", "path": "p.png", "width": 600, "height": 400}))["ok"])
            self.assertTrue((await ask(client, {"command": "export", "format": "povray", "path": "scene", "archive": True}))["ok"])
            written = (await ask(client, {"command": "export_state"}))["written"]
            self.assertEqual([row["name"] for row in written], ["fig.json", "p.png", "scene", "scene.zip"])
            for row in written:
                self.assertEqual(row["path"], os.path.join(os.path.realpath(self.folder.name), row["name"]))
            for name in ("fig.json", "p.png", "scene.zip"):
                status, data, headers = self.get("files/" + name)
                with open(self.path(name), "rb") as file:
                    self.assertEqual((status, data), (200, file.read()), name)
                self.assertEqual(headers["Content-Disposition"], f'attachment; filename="{name}"')
                self.assertEqual(headers["Content-Type"], "application/octet-stream")
                self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
                self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
            for name in ("foreign.txt", "five.pdb", "", "../five.pdb", "scene/surface.pov", "%66ig.json", "./fig.json", "files/fig.json",
                         "fig.json/", "fig.json%00", self.file, "/etc/passwd", "//etc/passwd"):
                self.assertEqual(self.get("files/" + name)[0], 404, name)
            self.assertEqual(self.get("files/scene")[0], 410, "a folder")
            self.assertEqual(self.get("files/fig.json", method="POST")[0], 405)
            self.assertEqual(self.get("files/fig.json", Host="evil.com")[0], 403)
            self.assertEqual(self.get("/" + "0" * 32 + "/files/fig.json")[0], 403)
            os.remove(self.path("fig.json"))
            os.symlink(self.path("foreign.txt"), self.path("fig.json"))
            self.assertEqual(self.get("files/fig.json")[0], 410, "a link elsewhere has come in its place")
            os.remove(self.path("p.png"))
            self.assertEqual(self.get("files/p.png")[0], 410)
        await self.still_serves()

    async def test_a_long_file_comes_whole_to_slow_readers_and_does_not_hold_up_others(self):
        async with self.preview.socket() as client:
            self.assertTrue((await ask(client, {"command": "export", "format": "png", "path": "p.png", "width": 16, "height": 16}))["ok"])
            with open(self.path("p.png"), "ab") as file:
                file.write(os.urandom(12 << 20))
            token = self.preview.url.split("/")[3]
            slow = socket.create_connection(("127.0.0.1", self.preview.port))
            slow.sendall(f"GET /{token}/files/p.png HTTP/1.1\r\nHost: 127.0.0.1:{self.preview.port}\r\n\r\n".encode())
            await asyncio.sleep(0.3)
            self.assertTrue((await ask(client, {"command": "state"}))["ok"], "while it is being read")
            data, begin = b"", time.monotonic()
            while piece := slow.recv(1 << 20):
                data += piece
                await asyncio.sleep(0.05)
            slow.close()
            with open(self.path("p.png"), "rb") as file:
                self.assertEqual(data.split(b"\r\n\r\n", 1)[1], file.read())
            lazy = socket.create_connection(("127.0.0.1", self.preview.port))
            lazy.sendall(f"GET /{token}/files/p.png HTTP/1.1\r\nHost: 127.0.0.1:{self.preview.port}\r\n\r\n".encode())
            await asyncio.sleep(12)
            lazy.settimeout(5)
            with self.assertRaises((ConnectionError, AssertionError)):
                while lazy.recv(1 << 20):
                    pass
                raise AssertionError("it was ended, for nobody read it")
            lazy.close()
        await self.still_serves()

    async def test_a_wrong_token_opens_no_socket(self):
        with self.assertRaises(websockets.exceptions.InvalidStatusCode) as caught:
            await websockets.connect(f"ws://127.0.0.1:{self.preview.port}/{'0' * 32}/socket",
                                     origin=self.preview.origin)
        self.assertEqual(caught.exception.status_code, 403)

    def test_it_listens_on_this_machine_only(self):
        with open("/proc/net/tcp") as file:
            own = [line.split()[1] for line in file if line.split()[1].endswith(f":{self.preview.port:04X}")
                   and line.split()[3] == "0A"]
        self.assertEqual(own, [f"0100007F:{self.preview.port:04X}"])
        with open("/proc/net/tcp6") as file:
            self.assertNotIn(f":{self.preview.port:04X} ", file.read().split("\n", 1)[1])

    async def test_messages_that_are_too_large_or_make_no_sense(self):
        client = await self.preview.socket()
        for nonsense in ("", "{", "[]", "7", '"state"', "[" * 4000, '{"command":"state"', '{"id":3}'):
            await client.send(nonsense)
            self.assertFalse((await receive(client, lambda m: "ok" in m))["ok"], nonsense)
        await client.send(b"\0\1\2")  # no text: passed over
        self.assertTrue((await ask(client, {"command": "state"}))["ok"])
        await client.send(json.dumps({"command": "state", "id": "x" * 5000}))
        with self.assertRaises(websockets.exceptions.ConnectionClosed) as caught:
            while True:
                await asyncio.wait_for(client.recv(), 30)
        self.assertEqual(caught.exception.rcvd.code, 1009)
        await self.still_serves()

    async def test_a_header_that_is_too_large_is_refused(self):
        self.assertEqual(self.get(**{"X-Long": "x" * 20000})[0], 431)
        await self.still_serves()

    async def test_four_may_look_and_the_first_controls(self):
        clients = [await self.preview.socket() for _ in range(4)]
        await self.refused(503)
        async def role(client):
            while "controls" not in (message := json.loads(await client.recv())):
                pass  # how far the file is read
            return message["controls"]
        roles = [await role(client) for client in clients]
        self.assertEqual(roles, [True, False, False, False])
        for client in clients:
            self.assertTrue((await ask(client, {"command": "state"}))["ok"])
            self.assertIn("picture", (await picture(client))[0]["event"])
        self.assertFalse((await ask(clients[1], {"command": "reset_view"}))["ok"])
        self.assertFalse((await ask(clients[1], {"command": "quit"}))["ok"])
        await clients[0].close()
        self.assertTrue((await receive(clients[1], lambda m: m.get("event") == "role"))["controls"])
        self.assertTrue((await ask(clients[1], {"command": "reset_view"}))["ok"])
        clients.append(await self.preview.socket())
        for client in clients:
            await client.close()

    async def test_control_can_be_taken(self):
        async with self.preview.socket() as first, self.preview.socket() as second:
            await second.send('{"request":"control"}')
            self.assertTrue((await receive(second, lambda m: m.get("event") == "role"))["controls"])
            self.assertFalse((await receive(first, lambda m: m.get("event") == "role"))["controls"])
            self.assertTrue((await ask(second, {"command": "reset_view"}))["ok"])
            self.assertFalse((await ask(first, {"command": "reset_view"}))["ok"])
        await self.still_serves()

    async def test_a_crowd_of_strangers_shuts_nobody_out(self):
        crowd = [socket.create_connection(("127.0.0.1", self.preview.port)) for _ in range(40)]
        await asyncio.sleep(0.3)
        begin = time.monotonic()
        self.assertEqual(self.get()[0], 200)
        await self.still_serves()
        self.assertLess(time.monotonic() - begin, 5)
        for connection in crowd:
            connection.close()

    async def test_a_client_that_vanishes_harms_nobody(self):
        for _ in range(5):
            client = await self.preview.socket()
            await client.send('{"request":"picture"}')
            await client.send('{"command":"orbit","dx":0.1,"dy":0}')
            client.transport.abort()
        await self.still_serves()

    def test_silence_ends_and_does_not_block_others(self):
        silent = [socket.create_connection(("127.0.0.1", self.preview.port)) for _ in range(8)]
        silent[0].sendall(b"GET / HTTP/1.1\r\n")
        self.assertEqual(self.get()[0], 200)
        begin = time.monotonic()
        for connection in silent:
            connection.settimeout(30)
            self.assertEqual(connection.recv(1), b"")
            connection.close()
        self.assertLess(time.monotonic() - begin, 25)

    async def test_connections_are_counted(self):
        crowd = [socket.create_connection(("127.0.0.1", self.preview.port)) for _ in range(60)]
        await asyncio.sleep(0.5)
        for connection in crowd:
            connection.close()
        await asyncio.sleep(0.5)
        await self.still_serves()

    async def test_pictures_come_when_asked_and_are_exact_at_rest(self):
        async with self.preview.socket() as client:
            message, data = await picture(client)
            while not message["full"]:
                self.assertTrue(data.startswith(b"\xff\xd8"), "JPEG")
                message, data = await picture(client)
            self.assertTrue(data.startswith(b"\x89PNG"))
            self.assertEqual(message["state"]["width"], 64)
            await client.send('{"request":"picture"}')
            with self.assertRaises(asyncio.TimeoutError):
                await asyncio.wait_for(client.recv(), 0.5)
            await client.send('{"id":9,"command":"orbit","dx":0.1,"dy":0}')
            self.assertFalse((await receive(client, lambda m: m.get("event") == "picture"))["full"])

    async def test_the_first_picture_is_a_draft_of_the_size_that_was_asked_for(self):
        async with self.preview.socket() as client:
            await ask(client, {"command": "resize", "width": 90, "height": 70})
            await asyncio.sleep(0.6)  # however late it is asked for
            message, _ = await picture(client)
            self.assertFalse(message["full"])
            self.assertEqual((message["state"]["width"], message["stats"]["width"]), (90, 45))

    async def test_others_are_served_while_an_export_is_written(self):
        async with self.preview.socket() as client, self.preview.socket() as other:
            export = {"command": "export", "format": "png", "path": "large.png", "width": 3000, "height": 3000,
                      "samples": 1024, "wait": False}
            self.assertTrue((await ask(client, export))["running"])
            await ask(client, {"command": "orbit", "dx": 0.1, "dy": 0})
            message, _ = await picture(other)
            self.assertTrue(message["state"]["atoms"])
            told = await ask(other, {"command": "export_state"})
            self.assertTrue(told["running"], told)
            self.assertTrue(told["path"].endswith("large.png"))
        self.assertEqual(self.preview.end()[0], 143)  # which ends the export, too
        self.assertEqual(os.listdir(self.folder.name), ["five.pdb"])

    async def test_drags_in_a_hurry_become_one(self):
        log = self.path("session.jsonl")
        self.preview = self.serve("--record", log, "--size", "800x600")
        async with self.preview.socket() as client:
            count = 150
            for n in range(count):
                await client.send(json.dumps({"id": n, "command": "orbit", "dx": 1 / 1024, "dy": 0}))
                if n == 0:
                    await client.send('{"request":"picture"}')
            for n in range(count):
                self.assertTrue((await receive(client, lambda m, n=n: m.get("id") == n))["ok"])
            camera = (await ask(client, {"command": "state"}))["camera"]
        self.assertEqual(self.preview.end(signal.SIGINT)[0], 130)
        with open(log) as file:
            text = file.read()
        drags = [json.loads(line) for line in text.splitlines()]
        self.assertLess(len(drags), count)
        self.assertEqual(sum(drag["dx"] for drag in drags), count / 1024)
        again = subprocess.run(
            [PROGRAM, "preview", self.file, "--serve", "--commands", "/dev/stdin", "--size", "800x600", "--quiet"],
            input=text + '{"command":"state"}\n{"command":"quit"}\n', capture_output=True, text=True, check=True)
        self.assertEqual(json.loads(again.stdout.splitlines()[-2])["camera"], camera)

    async def test_a_fast_wheel_over_a_slow_picture_is_not_refused(self):
        self.preview = self.serve("--size", "1600x1200", "--device", "software")
        async with self.preview.socket() as client:
            for factor in (2.0, 0.5):
                count = 100
                for n in range(count):
                    await client.send(json.dumps({"id": n, "command": "zoom", "factor": factor, "x": 30, "y": 20}))
                    if n == 0:
                        await client.send('{"request":"picture"}')
                for n in range(count):
                    reply = await receive(client, lambda m, n=n: m.get("id") == n)
                    self.assertTrue(reply["ok"], reply)

    async def test_it_ends_as_it_is_told(self):
        async with self.preview.socket() as client:
            self.assertTrue((await ask(client, {"command": "quit"}))["ok"])
            await receive(client, lambda m: m.get("event") == "ended")
        self.assertEqual(self.preview.process.wait(20), 0)
        self.assertEqual(self.serve().end(signal.SIGTERM)[0], 143)

    def test_what_cannot_be_begun_is_said_in_one_line(self):
        def fails(code, *arguments):
            result = subprocess.run([PROGRAM, "preview", self.file, *arguments], capture_output=True, text=True,
                                    timeout=60)
            errors = [line for line in result.stderr.splitlines() if "error" in line]
            self.assertEqual((result.returncode, len(errors)), (code, 1), result.stderr)

        fails(2, "--serve", str(self.preview.port))
        fails(2, "--serve", "70000")
        fails(2, "--serve", "--instances", "exact")
        fails(3, "--serve", "--show", "chain Z")
        fails(6, "--serve", "--output-dir", self.path("nowhere"))
        fails(6, "--serve", "--record", self.file)
        fails(3, "--serve", "--token-file", self.path("missing"))
        with open(self.path("bad.jsonl"), "w") as file:
            file.write('{"command":"state"}\n{"command":"set","key":"surface.probe","value":-1}\n')
        fails(3, "--serve", "--commands", self.path("bad.jsonl"))
        fails(3, "--serve", "--commands", self.path("missing.jsonl"))

    def test_a_refused_command_of_a_replay_is_named_by_its_line(self):
        for command in ('{"command":"set","key":"surface.probe","value":-1}', '{"command":"pause"}', "[1]", '{"command":5}',
                        '{"command":"set","key":"surface.probe","value":"x"}'):
            with open(self.path("bad.jsonl"), "w") as file:
                file.write('{"command":"pause"}\n\n' + command + '\n{"command":"nonsense"}')
            result = subprocess.run([PROGRAM, "preview", self.file, "--no-open", "--commands", self.path("bad.jsonl")],
                                    capture_output=True, text=True, timeout=60)
            self.assertEqual(result.returncode, 3, command)
            line = 4 if "pause" in command else 3  # the line after it is refused
            self.assertIn(f"bad.jsonl:{line}: ", result.stderr, command)


def until(holds, seconds=30):
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            raise AssertionError("it never happens")
        time.sleep(0.02)


class Opening(unittest.TestCase):
    """What is opened, by programs that stand for browsers and write down their arguments."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file, self.opened = self.path("five.pdb"), self.path("opened")
        with open(self.file, "w") as file:
            file.write(ATOMS)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def stub(self, name, more=""):
        """A program that writes its number, its session's and its arguments, and then does `more`."""
        with open(self.path(name), "w") as file:
            file.write("#!/bin/sh\n(echo $$ $(ps -o sid= -p $$); printf '%s\\n' \"$0\" \"$@\") >"
                       f"'{self.opened}.part'\nmv '{self.opened}.part' '{self.opened}'\n{more}\n")
        os.chmod(self.path(name), 0o755)
        return self.path(name)

    def start(self, *arguments, **environment):
        """The preview, its address and its port. environment: in place of what would name a browser or a display."""
        plain = {name: value for name, value in os.environ.items() if name not in ("BROWSER", "DISPLAY", "WAYLAND_DISPLAY")}
        process = subprocess.Popen([PROGRAM, "preview", self.file, "--output-dir", self.folder.name, *arguments],
                                   env={**plain, **environment}, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.terminate)
        self.url = process.stdout.readline().rstrip("\n")
        self.assertRegex(self.url, r"^http://127\.0\.0\.1:\d+/[0-9a-f]{32}/$")
        self.port = int(self.url.split(":")[2].split("/")[0])
        return process

    def get(self, address, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        connection.request("GET", "/" + address.split("/", 3)[3], headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.getheader("Location"), answer.read()

    def said(self, process, sentence):
        """Ends the preview once it has said this on standard error; what it said until then."""
        text = ""
        while sentence not in text:
            line = process.stderr.readline()
            self.assertTrue(line, text)
            text += line
        return text

    def path_with(self, folder):
        return f"{folder}:{os.environ['PATH']}"

    def test_no_open_prints_the_address_alone(self):
        browser = self.stub("browser")
        self.stub("xdg-open")
        for word in ("--no-open", "--serve"):
            process = self.start(word, BROWSER=browser, DISPLAY=":77", PATH=self.path_with(self.folder.name))
            text = self.said(process, "Ctrl-C ends the preview")
            self.assertIn(f"ssh -L {self.port}:127.0.0.1:{self.port} ", text)
            self.assertEqual(self.get(self.url)[0], 200)
            time.sleep(0.5)
            self.assertFalse(os.path.exists(self.opened), word)

    def test_the_browser_gets_an_address_that_leads_to_the_page_once(self):
        self.stub("xdg-open")
        self.start(DISPLAY=":77", PATH=self.path_with(self.folder.name))
        until(lambda: os.path.exists(self.opened))
        with open(self.opened) as file:
            _, program, *words = file.read().splitlines()
        self.assertEqual((program, len(words)), (self.path("xdg-open"), 1))
        self.assertRegex(words[0], rf"^http://127\.0\.0\.1:{self.port}/[0-9a-f]{{32}}$")
        token = self.url.split("/")[3]
        self.assertNotIn(token, words[0])
        self.assertEqual(self.get(words[0], Host=f"example.org:{self.port}")[0], 403, "which does not count")
        self.assertEqual(self.get(words[0] + "/")[0], 403)
        self.assertEqual(self.get(f"http://127.0.0.1:{self.port}/")[0], 403)
        self.assertEqual(self.get(words[0])[:2], (303, f"/{token}/"))
        self.assertEqual(self.get(words[0])[:2], (403, None))
        self.assertEqual(self.get(f"http://127.0.0.1:{self.port}/")[0], 403)
        self.assertEqual(self.get(self.url)[0], 200)

    def test_a_browser_that_is_named_needs_no_display(self):
        browser = self.stub("my-browser")
        for named, path in ((browser, os.environ["PATH"]), ("my-browser", self.path_with(self.folder.name))):
            self.start(BROWSER=named, PATH=path)
            until(lambda: os.path.exists(self.opened))
            with open(self.opened) as file:
                self.assertEqual(file.read().splitlines()[1], browser)
            os.remove(self.opened)

    def test_without_a_display_the_address_and_the_way_to_it_are_printed(self):
        self.stub("xdg-open")
        for environment in ({}, {"BROWSER": ""}, {"DISPLAY": ""}, {"BROWSER": "firefox -P; xdg-open"}):
            process = self.start(PATH=self.path_with(self.folder.name), **environment)
            text = self.said(process, "no browser was opened: there is no display; open the address above in one")
            self.assertIn(f"from another machine: ssh -L {self.port}:127.0.0.1:{self.port} {socket.gethostname()}", text)
            self.assertEqual(self.get(self.url)[0], 200)
            self.assertFalse(os.path.exists(self.opened))

    def test_a_browser_that_fails_is_said_and_the_page_is_served(self):
        self.stub("xdg-open", "exit 3")
        process = self.start(DISPLAY=":77", PATH=self.path_with(self.folder.name))
        self.said(process, "no browser was opened: xdg-open ended with code 3;")
        self.assertEqual(self.get(self.url)[0], 200)
        process = self.start(BROWSER=self.path("missing"))
        self.said(process, f"no browser was opened: {self.path('missing')} cannot be started;")
        self.assertEqual(self.get(self.url)[0], 200)

    def test_the_browser_outlives_the_preview_and_keeps_nothing_of_it(self):
        browser = self.stub("browser", "exec sleep 60")
        process = self.start(BROWSER=browser)
        until(lambda: os.path.exists(self.opened))
        with open(self.opened) as file:
            number, session = map(int, file.readline().split())
        self.addCleanup(os.kill, number, signal.SIGKILL)
        self.assertEqual(session, number, "Ctrl-C does not reach it")
        with open(f"/proc/{number}/status") as file:
            signals = {line.split(":")[0]: int(line.split()[1], 16) for line in file if line.startswith(("SigBlk", "SigIgn"))}
        self.assertEqual(signals["SigBlk"], 0)
        self.assertEqual(signals["SigIgn"] & (1 << (signal.SIGPIPE - 1) | 1 << (signal.SIGXFSZ - 1)), 0)
        os.killpg(process.pid, signal.SIGINT)
        self.assertEqual(process.wait(30), 130)
        os.kill(number, 0)  # it is there
        with self.assertRaises(ConnectionRefusedError):
            socket.create_connection(("127.0.0.1", self.port))

    def test_a_session_that_ends_itself_opens_nothing(self):
        with open(self.path("quit.jsonl"), "w") as file:
            file.write('{"command":"export","format":"png","path":"a.png","width":32,"height":24}\n{"command":"quit"}\n')
        result = subprocess.run([PROGRAM, "preview", self.file, "--output-dir", self.folder.name, "--commands",
                                 self.path("quit.jsonl")], env={**os.environ, "BROWSER": self.stub("browser")},
                                capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([json.loads(line)["ok"] for line in result.stdout.splitlines()], [True, True])
        self.assertTrue(os.path.exists(self.path("a.png")))
        time.sleep(0.3)
        self.assertFalse(os.path.exists(self.opened))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
