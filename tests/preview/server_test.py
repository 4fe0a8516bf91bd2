# SPDX-License-Identifier: BSD-3-Clause
"""The preview server refuses or endures difficult clients: arguments PROGRAM PAGE_FOLDER [TEST...]."""

import asyncio
import http.client
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import time
import unittest

import websockets

from browser import Preview, ask, receive
from server_case import ATOMS, PROGRAM, ServerCase, picture

PAGE = sys.argv[2]


class Server(ServerCase):
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
                            {"command": "undo"}, {"command": "add", "key": "surface.clip", "value": "x=1"}):
                reply = await ask(client, command)
                self.assertFalse(reply["ok"], command)
                self.assertTrue(reply["error"].startswith(command["command"] + ": "), reply)

    async def test_page_and_program_speak_of_the_same_things(self):
        """Every command that the page sends exists, and every key that it receives is read or used by tests."""
        page = {name: pathlib.Path(PAGE, name).read_text() for name in os.listdir(PAGE) if name.endswith(".js")}
        whole = "\n".join(page.values())
        with open(os.path.join(PAGE, "../../commands.md")) as file:
            rows = re.findall(r"^\| (`[a-z_]+`(?:, `[a-z_]+`)*) \|", file.read(), re.MULTILINE)
        commands = set(re.findall("[a-z_]+", " ".join(rows)))
        sent = set(re.findall(r'"([a-z_]+)"', " ".join(re.findall(r"\b(?:command\(|command: )[^,)}]*", whole))))
        sent |= {"undo", "redo"}  # a variable names these
        self.assertEqual((sent - commands, commands - sent), (set(), {"orbit", "next_frame", "quit", "scene", "stats"}))
        async with self.preview.socket() as client:
            choices = await ask(client, {"command": "choices"})
            state = await ask(client, {"command": "state"})
        unread = [key for key in choices.keys() - {"ok", "id"} if f"choices.{key}" not in page["program.js"]]
        unread += [key for choice in choices["properties"] for key in choice if not re.search(rf"\b{key}\b", page["properties.js"])]
        unread += [key for key in state.keys() - {"ok", "id"} if not re.search(rf"[.{{,]\s*{key}\b", whole)]
        self.assertEqual(sorted(set(unread)), ["copies", "drawn_by"])

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
        """jupyter-server-proxy 4 sends Host and Origin of the page that the user sees, with http or https."""
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
        """In a container the server listens everywhere; foreign names of it (DNS rebinding) are still refused."""
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

    async def test_a_wrong_token_opens_no_socket(self):
        await self.refused(403, websockets.connect(f"ws://127.0.0.1:{self.preview.port}/{'0' * 32}/socket",
                                                   origin=self.preview.origin))

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
        await client.send(b"\0\1\2")  # not a text: ignored
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
                pass  # messages about the progress of reading
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
            await asyncio.sleep(0.6)  # however late the page asks for it
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
        self.assertEqual(self.preview.end()[0], 143)  # the end of the preview also ends the export
        self.assertEqual(os.listdir(self.folder.name), ["five.pdb"])

    async def test_drags_in_a_hurry_become_one(self):
        log = self.path("session.jsonl")
        self.preview = self.serve("--record", log, "--size", "800x600")
        async with self.preview.socket() as client:
            count = 150
            for n in range(count):
                camera = {"position": [6.0, 3.0, 40.0 + n], "target": [6.0, 3.0, 0.0], "up": [0.0, 1.0, 0.0], "projection": "perspective", "vertical_fov": 30.0}
                await client.send(json.dumps({"id": n, "command": "camera", "camera": camera}))
                if n == 0:
                    await client.send('{"request":"picture"}')
            for n in range(count):
                self.assertTrue((await receive(client, lambda m, n=n: m.get("id") == n))["ok"])
            told = (await ask(client, {"command": "state"}))["camera"]
        self.assertEqual(self.preview.end(signal.SIGINT)[0], 130)
        with open(log) as file:
            text = file.read()
        drags = [json.loads(line) for line in text.splitlines()]
        self.assertLess(len(drags), count)
        self.assertEqual(drags[-1]["camera"], camera)
        again = subprocess.run(
            [PROGRAM, "preview", self.file, "--serve", "--commands", "/dev/stdin", "--size", "800x600", "--quiet"],
            input=text + '{"command":"state"}\n{"command":"quit"}\n', capture_output=True, text=True, check=True)
        self.assertEqual(json.loads(again.stdout.splitlines()[-2])["camera"], told)

    async def test_it_ends_as_it_is_told(self):
        async with self.preview.socket() as client:
            self.assertTrue((await ask(client, {"command": "quit"}))["ok"])
            await receive(client, lambda m: m.get("event") == "ended")
        self.assertEqual(self.preview.process.wait(20), 0)
        self.assertEqual(self.serve().end(signal.SIGTERM)[0], 143)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
