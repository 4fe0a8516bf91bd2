# SPDX-License-Identifier: BSD-3-Clause
"""Other molecules in a running preview: files that pages send, refused or opened. Argument PROGRAM."""

import asyncio
import glob
import http.client
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

from browser import ask, receive
from server_case import ATOMS, PROGRAM, ServerCase, picture

THREE = "".join(ATOMS.splitlines(keepends=True)[:3])
RUN = "three frames\n" + "".join("".join(f"{9.0 * n + frame:8.3f}" for n in range(9)) + "\n" for frame in range(4))
LARGEST = 512_000_000


class Opened(ServerCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        super().setUp()

    def serve(self, *arguments, **options):
        return super().serve(*arguments, env={**os.environ, "TMPDIR": self.temporary.name}, **options)

    def post(self, name, data, path="received/", **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.preview.port, timeout=20)
        target = path if path.startswith("/") else f"/{self.preview.url.split('/')[3]}/{path}"
        connection.request("POST", target + name, data.encode() if isinstance(data, str) else data,
                           {"Origin": self.preview.origin, **headers})
        answer = connection.getresponse()
        return answer.status, answer.read().decode().strip()

    async def open(self, client, *names):
        """Returns the reply to a request to open files, with the error that pages show."""
        await client.send(json.dumps({"id": 5, "request": "open", "files": names}))
        reply = await receive(client, lambda m: m.get("id") == 5 or m.get("event") == "opened")
        if not reply.get("ok", True) and "error" not in reply:
            reply["error"] = (await receive(client, lambda m: m.get("event") == "error"))["error"]
        return reply

    async def opened(self, *names):
        """Opens files and returns the state of the molecule."""
        async with self.preview.socket() as client:
            self.assertEqual(await self.open(client, *names), {"event": "opened"})
        async with self.preview.socket() as client:
            await picture(client)
            return await ask(client, {"command": "state"})

    def received(self):
        return sorted(os.path.relpath(path, self.temporary.name).split("/", 1)[-1]
                      for path in glob.glob(self.temporary.name + "/meniscus-*/*"))

    async def test_a_file_is_opened_in_place_of_the_molecule(self):
        self.assertEqual(self.post("three.pdb", THREE), (200, ""))
        folder, = glob.glob(self.temporary.name + "/meniscus-*")
        self.assertEqual(os.stat(folder).st_mode & 0o777, 0o700)
        state = await self.opened("three.pdb")
        self.assertEqual((state["atoms"], state["file"].split("/")[-1], state["unsaved"]), (3, "three.pdb", False))
        self.assertEqual(os.listdir(self.folder.name), ["five.pdb"], "nothing is written there")
        self.assertEqual(self.post("again.pdb", ATOMS)[0], 200)
        self.assertEqual((await self.opened("again.pdb"))["atoms"], 5)
        self.assertEqual(self.received(), ["again.pdb"], "the one before is gone")
        self.assertEqual(self.preview.end(signal.SIGINT)[0], 130)
        self.assertEqual(os.listdir(self.temporary.name), [])

    async def test_nothing_stays_however_the_preview_ends(self):
        for ending in (signal.SIGTERM, signal.SIGHUP, "quit"):
            self.preview = self.serve("--size", "64x48")
            self.post("three.pdb", THREE)
            await self.opened("three.pdb")
            self.post("waiting.pdb", ATOMS)
            self.assertEqual(self.received(), ["three.pdb", "waiting.pdb"])
            if ending == "quit":
                async with self.preview.socket() as client:
                    await ask(client, {"command": "quit"})
                self.preview.process.wait(30)
            else:
                self.preview.end(ending)
            self.assertEqual(os.listdir(self.temporary.name), [], ending)

    async def test_files_of_strangers_are_refused(self):
        token = self.preview.url.split("/")[3]
        self.assertEqual(self.post("a.pdb", THREE, Origin="http://example.org")[0], 403)
        self.assertEqual(self.post("a.pdb", THREE, Origin=f"https://127.0.0.1:{self.preview.port}")[0], 403)
        self.assertEqual(self.post("a.pdb", THREE, Origin="null")[0], 403)
        self.assertEqual(self.get("received/a.pdb", method="POST")[0], 403, "without an Origin")
        self.assertEqual(self.post("a.pdb", THREE, Host="example.org")[0], 403)
        self.assertEqual(self.post("a.pdb", THREE, path=f"/{'0' * len(token)}/received/")[0], 403)
        self.assertEqual(self.post("a.pdb", THREE, path="/received/")[0], 403)
        for path in ("", "files/", "socket", "receive/"):
            self.assertNotEqual(self.post("a.pdb", THREE, path=path)[0], 200, path)
        self.assertEqual(self.get("received/a.pdb")[0], 404)
        self.assertEqual(os.listdir(self.temporary.name), [])
        await self.still_serves()

    async def test_names_are_plain(self):
        for name in ("", ".", "..", ".pdb", "-a.pdb", "../a.pdb", "..%2fa.pdb", "a/b.pdb", "a%00.pdb", "a b.pdb".replace(" ", "%20"),
                     "%C3%A4.pdb", "a" * 97 + ".pdb"):
            self.assertEqual(self.post(name, THREE)[0], 400, name)
        self.assertEqual(self.post("a.pdb?token=of-a-proxy", THREE)[0], 200)
        self.assertEqual(self.received(), ["a.pdb"])

    async def test_what_is_too_large_or_has_no_end_is_refused(self):
        def answer(*headers, more=b""):
            with socket.create_connection(("127.0.0.1", self.preview.port), timeout=30) as stranger:
                lines = [f"POST /{self.preview.url.split('/')[3]}/received/a.pdb HTTP/1.1", f"Host: 127.0.0.1:{self.preview.port}",
                         f"Origin: {self.preview.origin}", *headers, "", ""]
                stranger.sendall("\r\n".join(lines).encode() + more)
                return stranger.recv(4096).decode().split(" ")[1:2]

        self.assertEqual(answer(f"Content-Length: {LARGEST + 1}"), ["413"])
        self.assertEqual(answer("Content-Length: 99999999999999999999"), [])
        self.assertEqual(answer("Transfer-Encoding: chunked", more=b"3\r\nabc\r\n0\r\n\r\n"), ["411"])
        self.assertEqual(answer(), ["411"])
        self.assertEqual(os.listdir(self.temporary.name), [])
        # An incomplete file leaves nothing behind. Other files are refused while it comes, and accepted afterwards.
        slow = socket.create_connection(("127.0.0.1", self.preview.port))
        slow.sendall(f"POST /{self.preview.url.split('/')[3]}/received/slow.pdb HTTP/1.1\r\nHost: 127.0.0.1:{self.preview.port}\r\n"
                     f"Origin: {self.preview.origin}\r\nContent-Length: 1000\r\n\r\nATOM".encode())
        await asyncio.sleep(0.5)
        self.assertEqual(self.received(), ["slow.pdb"])
        self.assertEqual(self.post("a.pdb", THREE)[0], 503)
        slow.close()
        await asyncio.sleep(0.5)
        self.assertEqual(self.received(), [])
        self.assertEqual(self.post("a.pdb", THREE)[0], 200)
        async with self.preview.socket() as client:
            self.assertEqual((await self.open(client, "slow.pdb"))["error"], "the file has not come; open it again")
            welcome = await self.preview.socket()
            self.assertEqual(json.loads(await welcome.recv())["largest_file"], LARGEST)
            await welcome.close()

    async def test_a_long_file_comes_whole(self):
        padding = "REMARK" + " " * 73 + "\n"
        text = padding * 250_000 + THREE  # 20 MB
        self.assertEqual(self.post("long.pdb", text)[0], 200)
        self.assertEqual(os.path.getsize(glob.glob(self.temporary.name + "/*/long.pdb")[0]), len(text))
        self.assertEqual((await self.opened("long.pdb"))["atoms"], 3)

    async def test_no_more_than_two_wait(self):
        for name in ("a.pdb", "b.pdb", "c.pdb"):
            self.post(name, THREE)
        self.assertEqual(self.received(), ["c.pdb"])

    async def test_who_looks_on_opens_nothing(self):
        self.post("three.pdb", THREE)
        async with self.preview.socket() as first, self.preview.socket() as second:
            await receive(first, lambda m: m.get("event") == "welcome")
            self.assertEqual((await self.open(second, "three.pdb"))["error"], "another page controls this preview")
            self.assertEqual((await ask(first, {"command": "state"}))["atoms"], 5)
            self.assertEqual(await self.open(first, "three.pdb"), {"event": "opened"})
            await receive(second, lambda m: m.get("event") == "opened")
            self.assertEqual((await ask(second, {"command": "state"}))["atoms"], 3)
            for nonsense in ([], ["a", "b", "c"], "three.pdb", [7], [None]):
                await first.send(json.dumps({"id": 9, "request": "open", "files": nonsense}))
                self.assertFalse((await receive(first, lambda m: m.get("id") == 9))["ok"], nonsense)

    async def test_what_cannot_be_read_is_said_and_the_molecule_stays(self):
        async with self.preview.socket() as client:
            await ask(client, {"command": "set", "key": "surface.probe", "value": 2})
            for name, text, said in (("nonsense.pdb", "nonsense\n", "nonsense.pdb: "), ("empty.cif", "", "empty.cif: "),
                                     ("page.pdb", "<html>", "looks like HTML"), ("notes.txt", THREE, "its name says no molecule and no trajectory"),
                                     ("x.pdb", ATOMS.replace("   3.000", "     inf"), "x.pdb:1: ")):
                self.assertEqual(self.post(name, text)[0], 200)
                reply = await self.open(client, name)
                self.assertFalse(reply["ok"])
                self.assertIn(said, reply["error"])
                self.assertNotIn("\n", reply["error"])
                self.assertEqual(self.received(), [], "it is gone")
            state = await ask(client, {"command": "state"})
            self.assertEqual((state["atoms"], state["values"]["surface.probe"]), (5, 2))
            self.assertIn("picture", (await picture(client))[0]["event"])

    async def test_a_trajectory_comes_with_its_molecule_or_after_it(self):
        self.post("three.pdb", THREE)
        self.post("run.mdcrd", RUN)
        state = await self.opened("run.mdcrd", "three.pdb")
        self.assertEqual((state["atoms"], state["frames"]), (3, 4))
        self.post("three.pdb", THREE)
        self.assertEqual((await self.opened("three.pdb"))["frames"], 1)
        self.post("run.mdcrd", RUN)
        state = await self.opened("run.mdcrd")
        self.assertEqual((state["file"].split("/")[-1], state["frames"]), ("three.pdb", 4))
        async with self.preview.socket() as client:
            self.post("three.pdb", THREE)
            self.post("other.pdb", ATOMS)
            self.assertIn("two files are a molecule and its trajectory", (await self.open(client, "three.pdb", "other.pdb"))["error"])
            self.post("run.xtc", "nonsense")
            self.assertIn("run.xtc", (await self.open(client, "run.xtc"))["error"])
            self.assertEqual((await ask(client, {"command": "state"}))["frames"], 4)

    async def test_a_trajectory_of_the_molecule_of_the_command_line(self):
        with open(self.file, "w") as file:
            file.write(THREE)
        self.preview = self.serve("--size", "64x48")
        self.post("run.mdcrd", RUN)
        self.assertEqual((await self.opened("run.mdcrd"))["frames"], 4)

    async def test_what_is_written_names_a_file_that_stays(self):
        """The molecule's file is copied to the output folder once a scene names it."""
        with open(self.path("three.pdb"), "w") as file:
            file.write("another file\n")
        self.post("three.pdb", THREE)
        await self.opened("three.pdb")
        async with self.preview.socket() as client:
            await ask(client, {"command": "set", "key": "surface.probe", "value": 2})
            self.assertEqual(sorted(os.listdir(self.folder.name)), ["five.pdb", "three.pdb"])
            self.assertTrue((await ask(client, {"command": "save", "path": "fig.json"}))["ok"])
            written = (await ask(client, {"command": "export_state"}))["written"]
            self.assertEqual([row["name"] for row in written], ["2-three.pdb", "fig.json"])
            self.assertEqual(self.get("files/2-three.pdb")[:2], (200, THREE.encode()))
            await ask(client, {"command": "set", "key": "surface.probe", "value": 1})
            self.assertTrue((await ask(client, {"command": "open", "path": "fig.json"}))["ok"])
            self.assertEqual((await ask(client, {"command": "state"}))["values"]["surface.probe"], 2)
            self.assertTrue((await ask(client, {"command": "export", "format": "png", "path": "a.png", "width": 64, "height": 48}))["ok"])
            words = (await ask(client, {"command": "render_command"}))["words"]
        self.preview.end()
        with open(self.path("three.pdb")) as file:
            self.assertEqual(file.read(), "another file\n")
        program = os.path.abspath(PROGRAM)
        for words in ([program, *words[1:], "-o", self.path("b.png")], [program, "render", "--scene", self.path("fig.json"), "-o", self.path("c.png")],
                      [program, "render", "--scene", self.path("a.png"), "-o", self.path("d.png")]):
            done = subprocess.run([*words, "--force"], capture_output=True, text=True, timeout=120, cwd=self.folder.name)
            self.assertEqual(done.returncode, 0, done.stderr)

    async def test_a_recorded_preview_keeps_its_molecule(self):
        self.preview = self.serve("--record", self.path("log.jsonl"))
        self.post("three.pdb", THREE)
        async with self.preview.socket() as client:
            self.assertIn("recorded for one molecule", (await self.open(client, "three.pdb"))["error"])

    async def test_what_is_being_written_is_waited_for(self):
        self.post("three.pdb", THREE)
        async with self.preview.socket() as client:
            export = {"command": "export", "format": "png", "path": "large.png", "width": 3000, "height": 3000, "samples": 1024, "wait": False}
            self.assertTrue((await ask(client, export))["running"])
            self.assertIn("still being written", (await self.open(client, "three.pdb"))["error"])

    def test_only_the_page_may_ask_the_bank(self):
        hosts = f"connect-src 'self' ws://127.0.0.1:{self.preview.port} ws://localhost:{self.preview.port} https://files.rcsb.org;"
        self.assertIn(hosts, self.get()[2]["Content-Security-Policy"])
        for path in ("program.js", "page.css", "nothing"):
            self.assertNotIn("rcsb", self.get(path)[2]["Content-Security-Policy"])
        subprocess.run([PROGRAM, "export", "page", self.file, "-q", "-o", self.path("page.html")], check=True)
        with open(self.path("page.html")) as file:
            text = file.read()
        self.assertNotIn("rcsb", text)
        self.assertNotIn("connect-src", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
