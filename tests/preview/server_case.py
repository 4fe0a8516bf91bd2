# SPDX-License-Identifier: BSD-3-Clause
"""A preview of five atoms and its clients: the first argument is PROGRAM."""

import asyncio
import http.client
import os
import sys
import tempfile
import unittest

from websockets.exceptions import InvalidHandshake

from browser import Preview, ask, receive

PROGRAM = sys.argv[1]

ATOMS = "".join(f"ATOM  {n:5d}  C{n:<2d} UNL A   1    {3 * n:8.3f}{n:8.3f}{0:8.3f}  1.00 {n:5.2f}           C\n"
                for n in range(1, 6))


async def picture(client):
    await client.send('{"request":"picture"}')
    message = await receive(client, lambda m: m.get("event") == "picture")
    return message, await asyncio.wait_for(client.recv(), 30)


class ServerCase(unittest.IsolatedAsyncioTestCase):
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

    async def refused(self, status, socket=None, **options):
        with self.assertRaises(InvalidHandshake) as caught:
            await (socket or self.preview.socket(**options))
        # Before version 14 of websockets the error had the status itself.
        self.assertEqual(getattr(caught.exception, "response", caught.exception).status_code, status)

    async def still_serves(self):
        async with self.preview.socket() as client:
            self.assertTrue((await ask(client, {"command": "state"}))["ok"])
