# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium driven by the DevTools protocol, and a preview server to look at."""

import asyncio
import base64
import json
import os
import re
import signal
import subprocess
import tempfile
import time
import urllib.request

import websockets


class Preview:
    """`meniscus preview FILE --serve`, which runs until the with-block ends. options: arguments of Popen."""

    def __init__(self, program, *arguments, port="", **options):
        self.process = subprocess.Popen([program, "preview", *arguments, "--serve", *([str(port)] if port else [])],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
        self.lines = []
        for line in self.process.stdout:
            self.lines.append(line.rstrip("\n"))
            if line.startswith("http://"):
                break
        else:
            raise RuntimeError(self.process.stderr.read())
        self.url = self.lines[-1]
        self.port = int(re.match(r"http://127\.0\.0\.1:(\d+)/[\w-]+/$", self.url).group(1))
        self.origin = f"http://127.0.0.1:{self.port}"

    def socket(self, **options):
        """Returns a socket like that of the page; options such as the origin may differ."""
        options = {"origin": self.origin, "max_size": None, **options}
        return websockets.connect(self.url.replace("http:", "ws:") + "socket", **options)

    def end(self, sign=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(sign)
        errors = self.process.communicate(timeout=30)[1]
        return self.process.returncode, errors

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()


async def receive(client, wanted):
    """Returns the first message that `wanted` accepts, and skips pictures before it."""
    while True:
        data = await asyncio.wait_for(client.recv(), 30)
        if isinstance(data, str) and wanted(json.loads(data)):
            return json.loads(data)


async def ask(client, command, number=1):
    await client.send(json.dumps({"id": number, **command}))
    return await receive(client, lambda message: message.get("id") == number)


class Browser:
    """One page in its own Chromium; `async with Browser(program) as page`. options: more of the command line. By
    default the page has no WebGL, because software WebGL stops the page for minutes on a busy machine."""

    def __init__(self, program, size=(1280, 800), options=("--disable-3d-apis",)):
        self.program, self.size, self.options = program, size, options
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.downloads = os.path.join(self.folder.name, "downloads")
        self.waiting, self.number, self.complaints = {}, 0, []
        self.tasks, self.handlers = [], {}  # coroutines for events, by the events' names

    async def __aenter__(self):
        self.process = subprocess.Popen(
            [self.program, "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-extensions",
             "--disable-background-networking", "--remote-debugging-port=0", f"--user-data-dir={self.folder.name}",
             f"--window-size={self.size[0]},{self.size[1]}", *self.options, "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port = await self._debugging_port()
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list") as answer:
            target = next(t for t in json.load(answer) if t["type"] == "page")
        self.connection = await websockets.connect(target["webSocketDebuggerUrl"], max_size=None)
        self.reader = asyncio.create_task(self._read())
        for domain in ("Page", "Runtime", "Log"):
            await self.send(f"{domain}.enable")
        await self.send("Emulation.setDeviceMetricsOverride", width=self.size[0], height=self.size[1],
                        deviceScaleFactor=1, mobile=False)
        await self.send("Browser.setDownloadBehavior", behavior="allow", downloadPath=self.downloads)
        return self

    async def __aexit__(self, *_):
        self.reader.cancel()
        await self.connection.close()
        self.process.terminate()
        self.process.wait(30)
        self.folder.cleanup()

    async def _debugging_port(self):
        path = os.path.join(self.folder.name, "DevToolsActivePort")
        for _ in range(300):
            if os.path.exists(path):
                with open(path) as file:
                    words = file.read().split()
                if words:
                    return int(words[0])
            await asyncio.sleep(0.1)
        raise RuntimeError("Chromium does not start")

    async def _read(self):
        async for text in self.connection:
            message = json.loads(text)
            if "id" in message:
                self.waiting.pop(message["id"]).set_result(message)
            elif message["method"] == "Runtime.exceptionThrown":
                self.complaints.append(message["params"]["exceptionDetails"].get("text", "") + str(
                    message["params"]["exceptionDetails"].get("exception", {}).get("description")))
            elif message["method"] == "Log.entryAdded" and message["params"]["entry"]["level"] == "error":
                self.complaints.append(message["params"]["entry"]["text"])
            elif message["method"] in self.handlers:
                self.tasks.append(asyncio.create_task(self.handlers[message["method"]](message["params"])))

    async def send(self, method, **parameters):
        self.number += 1
        self.waiting[self.number] = asyncio.get_running_loop().create_future()
        answer = self.waiting[self.number]
        await self.connection.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        message = await asyncio.wait_for(answer, 120)  # software GL may need so long to draw
        if "error" in message:
            raise RuntimeError(f"{method}: {message['error']}")
        return message["result"]

    async def evaluate(self, script):
        result = await self.send("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(str(result["exceptionDetails"]))
        return result["result"].get("value")

    async def until(self, script, seconds=60):
        """Waits until the script returns something true, and returns it; a page that loads returns nothing."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if value := await self.evaluate(script):
                    return value
            except RuntimeError as error:
                if "navigated" not in str(error):
                    raise
            await asyncio.sleep(0.05)
        raise AssertionError(f"never true: {script}; the page says: "
                             + str(await self.evaluate("document.getElementById('message').textContent")))

    async def navigate(self, url):
        await self.send("Page.navigate", url=url)

    async def open(self, url):
        await self.navigate(url)
        await self.at_rest()

    async def at_rest(self, seconds=60):
        await self.until("document.querySelector('#picture')?.dataset.rest === 'true'", seconds)

    async def mouse(self, kind, x, y, **more):
        await self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    async def drag(self, path, button="left", modifiers=0, pause=0.0):
        """Presses at the first point, moves along the path, and releases at the last."""
        held = {"left": 1, "right": 2}[button]
        await self.mouse("mouseMoved", *path[0])
        await self.mouse("mousePressed", *path[0], button=button, buttons=held, clickCount=1, modifiers=modifiers)
        for point in path[1:]:
            await self.mouse("mouseMoved", *point, button=button, buttons=held, modifiers=modifiers)
            if pause:
                await asyncio.sleep(pause)
        await self.mouse("mouseReleased", *path[-1], button=button, buttons=0, clickCount=1, modifiers=modifiers)

    async def click(self, selector):
        await self.evaluate(f"document.querySelector({json.dumps(selector)}).click()")

    async def screenshot(self, path):
        shot = await self.send("Page.captureScreenshot", format="png")
        with open(path, "wb") as file:
            file.write(base64.b64decode(shot["data"]))
