# SPDX-License-Identifier: BSD-3-Clause
"""Files that the preview server writes and lets browsers download, and how it opens a browser: argument PROGRAM."""

import asyncio
import http.client
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

from browser import ask
from server_case import ATOMS, PROGRAM, ServerCase


class Files(ServerCase):
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
    """Tests what is opened, with programs that replace browsers and write down their arguments."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file, self.opened = self.path("five.pdb"), self.path("opened")
        with open(self.file, "w") as file:
            file.write(ATOMS)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def stub(self, name, more=""):
        """Makes a program that writes its number, its session's and its arguments, and then does `more`."""
        with open(self.path(name), "w") as file:
            file.write("#!/bin/sh\n(echo $$ $(ps -o sid= -p $$); printf '%s\\n' \"$0\" \"$@\") >"
                       f"'{self.opened}.part'\nmv '{self.opened}.part' '{self.opened}'\n{more}\n")
        os.chmod(self.path(name), 0o755)
        return self.path(name)

    def start(self, *arguments, **environment):
        """Starts the preview; returns it, its address and port. environment: variables for a browser or a display."""
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
        """Ends the preview after it has written this to standard error; returns the text until then."""
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
        # While the shell of the stub starts a program, it blocks all signals itself.
        until(lambda: pathlib.Path(f"/proc/{number}/comm").read_text() == "sleep\n")
        with open(f"/proc/{number}/status") as file:
            signals = {line.split(":")[0]: int(line.split()[1], 16) for line in file if line.startswith(("SigBlk", "SigIgn"))}
        self.assertEqual(signals["SigBlk"], 0)
        self.assertEqual(signals["SigIgn"] & (1 << (signal.SIGPIPE - 1) | 1 << (signal.SIGXFSZ - 1)), 0)
        os.killpg(process.pid, signal.SIGINT)
        self.assertEqual(process.wait(30), 130)
        os.kill(number, 0)  # the process exists
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
