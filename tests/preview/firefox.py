# SPDX-License-Identifier: BSD-3-Clause
"""A Firefox on a hidden display, driven by WebDriver BiDi, which uses pages like browser.Browser."""

import asyncio
import base64
import json
import os
import re
import signal
import subprocess

import websockets
from browser import Browser

# Firefox fetches and asks nothing, and WebGL runs without a device.
PREFERENCES = {"webgl.force-enabled": True, "webgl.disabled": False, "app.update.enabled": False, "datareporting.policy.dataSubmissionEnabled": False,
               "browser.shell.checkDefaultBrowser": False, "browser.aboutwelcome.enabled": False, "network.captive-portal-service.enabled": False,
               "network.connectivity-service.enabled": False}


class Firefox(Browser):
    """One page in its own Firefox; `async with Firefox(program) as page`. It has no mouse."""

    async def __aenter__(self):
        with open(os.path.join(self.folder.name, "user.js"), "w") as file:
            file.writelines(f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in PREFERENCES.items())
        # A headless Firefox has no GL, so it has its own display.
        self.process = subprocess.Popen(["xvfb-run", "-a", "-s", "-screen 0 1400x1000x24", self.program, "--no-remote", "--profile", self.folder.name, "--remote-debugging-port=0", "about:blank"],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True,
                                        env={**os.environ, "HOME": self.folder.name})
        for line in self.process.stderr:
            if found := re.search(r"WebDriver BiDi listening on (ws://\S+)", line):
                break
        else:
            raise RuntimeError("Firefox ended")
        self.drain = asyncio.get_running_loop().run_in_executor(None, self.process.stderr.read)
        self.connection = await websockets.connect(found.group(1) + "/session", max_size=None, origin=None)
        self.reader = asyncio.create_task(self._read())
        await self.send("session.new", capabilities={})
        self.context = (await self.send("browsingContext.getTree"))["contexts"][0]["context"]
        await self.send("session.subscribe", events=["log.entryAdded"])
        await self.send("browsingContext.setViewport", context=self.context, viewport={"width": self.size[0], "height": self.size[1]}, devicePixelRatio=1)
        return self

    async def __aexit__(self, *_):
        os.killpg(self.process.pid, signal.SIGTERM)  # xvfb-run does not end its two programs
        self.process.wait(30)
        await self.drain
        self.reader.cancel()
        self.folder.cleanup()

    async def _read(self):
        async for text in self.connection:
            message = json.loads(text)
            if message.get("method") == "log.entryAdded" and message["params"]["level"] in ("error", "warn"):
                self.complaints.append(message["params"]["text"])
            if message.get("id") in self.waiting:
                self.waiting.pop(message["id"]).set_result(message)

    async def send(self, method, **parameters):
        self.number += 1
        answer = self.waiting[self.number] = asyncio.get_running_loop().create_future()
        await self.connection.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        message = await asyncio.wait_for(answer, 240)  # software GL may need so long to draw
        if message["type"] == "error":
            raise RuntimeError(f"{method}: {message['message']}")
        return message["result"]

    async def evaluate(self, script):
        """Returns a number, a text or a truth value."""
        answer = await self.send("script.evaluate", expression=script, target={"context": self.context}, awaitPromise=True)
        if answer["type"] == "exception":
            raise RuntimeError(str(answer["exceptionDetails"]))
        return answer["result"].get("value")

    async def navigate(self, url):
        await self.send("browsingContext.navigate", context=self.context, url=url, wait="complete")

    async def screenshot(self, path):
        shot = await self.send("browsingContext.captureScreenshot", context=self.context)
        with open(path, "wb") as file:
            file.write(base64.b64decode(shot["data"]))
