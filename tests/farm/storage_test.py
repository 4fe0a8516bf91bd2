# SPDX-License-Identifier: BSD-3-Clause
"""Machines that share no folder, but a store that they reach by WebDAV: rclone and nginx, on this machine's loopback.

The last line is what one film cost: bytes through the server, and the processor time of rclone and of the merge.
"""

import os
import pathlib
import re
import resource
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

from farm_case import SKIPPED, WorkCase, main, sums, wait_until

MODULE = pathlib.Path("/usr/lib/nginx/modules/ngx_http_dav_ext_module.so")
NGINX = shutil.which("nginx", path=f"{os.environ['PATH']}:/usr/sbin")
PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "how-to" / "farm-without-a-shared-folder.md"

CONFIGURATION = """
load_module {module};
daemon off; pid {place}/nginx.pid; error_log {place}/error.log; worker_processes 1;
events {{ worker_connections 64; }}
http {{
  log_format bytes '$request_method $request_length $bytes_sent';
  access_log {place}/access.log bytes;
  client_body_temp_path {place}/body; proxy_temp_path {place}/a; fastcgi_temp_path {place}/b;
  uwsgi_temp_path {place}/c; scgi_temp_path {place}/d;
  server {{
    listen 127.0.0.1:{port};
    root {place}/store; client_max_body_size 0; create_full_put_path on;
    dav_methods PUT DELETE MKCOL COPY MOVE; dav_ext_methods PROPFIND OPTIONS;
  }}
}}
"""


def scripts_of_page():
    """What a machine of the farm runs, and what is run at home: the two blocks of sh."""
    return re.findall(r"^```sh\n(.*?)^```", PAGE.read_text(), re.M | re.S)


class Storage(WorkCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.server_folder = cls.folder / "server"
        (cls.server_folder / "store").mkdir(parents=True)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        configuration = cls.server_folder / "nginx.conf"
        configuration.write_text(CONFIGURATION.format(module=MODULE, place=cls.server_folder, port=port))
        if os.getuid() == 0:  # its worker would be another user
            configuration.write_text("user root;" + configuration.read_text())
        cls.server = subprocess.Popen([NGINX, "-p", cls.server_folder, "-c", configuration], stderr=subprocess.DEVNULL)
        cls.addClassCleanup(cls.server.wait)
        cls.addClassCleanup(cls.server.terminate)
        cls.environment = {**os.environ, "RCLONE_CONFIG": "", "RCLONE_CONFIG_STORE_TYPE": "webdav",
                           "RCLONE_CONFIG_STORE_URL": f"http://127.0.0.1:{port}", "RCLONE_CONFIG_STORE_VENDOR": "other",
                           "NO_PROXY": "127.0.0.1", "no_proxy": "127.0.0.1"}
        place = cls.folder / "bin"
        place.mkdir()
        (place / "meniscus").symlink_to(os.path.abspath(sys.argv[1]))
        cls.environment["PATH"] = f"{place}:{cls.environment['PATH']}"

        def is_there():
            with socket.socket() as attempt:
                return attempt.connect_ex(("127.0.0.1", port)) == 0
        wait_until(is_there, 20, "the server")

    def run_in(self, folder, script, code=0, **variables):
        result = subprocess.run(["sh", "-e", "-c", script], cwd=folder, env={**self.environment, **variables}, text=True,
                                capture_output=True, timeout=240)
        self.assertEqual(result.returncode, code, f"{script}\n{result.stdout}\n{result.stderr}")
        return result.stdout + result.stderr

    def traffic(self):
        """Bytes that the server was sent, and that it sent."""
        rows = [line.split() for line in (self.server_folder / "access.log").read_text().splitlines()]
        return sum(int(row[1]) for row in rows), sum(int(row[2]) for row in rows)

    def test_three_machines_and_a_store(self):
        """The scripts of the page, with a worker killed on each machine, and a file that is cut short in the store."""
        machine, home = scripts_of_page()
        at_home = self.folder / "home"
        at_home.mkdir()
        folder = self.povray_bundle("home/film", options=("--chunk-frames", "5", "--film", "film.mp4"))
        begin, cpu = self.traffic(), resource.getrusage(resource.RUSAGE_CHILDREN)
        upload, collect = home.split("\n\n")
        self.run_in(at_home, upload)
        fetch, work, deliver = machine.strip().split("\n\n")
        for number in (1, 2, 3):
            place = self.folder / f"machine_{number}"
            place.mkdir()
            self.run_in(place, fetch, K=str(number), N="3")
            self.assertEqual(sums(place / "film", "bundle.json"), sums(folder, "bundle.json"))
            worker = self.start(place / "film", "--chunk", f"{number}/3")
            wait_until(lambda: self.records(place / "film", "render"), what="a picture")
            worker.kill()
            worker.wait()
            self.assertEqual(worker.returncode, -signal.SIGKILL)
            # What is there is seen at home already.
            self.run_in(place, deliver, K=str(number), N="3")
        self.run_in(at_home, collect, code=3)  # frames are missing
        some = len(self.records(folder, "render"))
        self.assertTrue(3 <= some < 8, some)
        for number in (1, 2, 3):
            place = self.folder / f"machine_{number}"
            self.run_in(place, work, K=str(number), N="3")
            self.run_in(place, deliver, K=str(number), N="3")
        stored = sorted((self.server_folder / "store" / "film_2" / "images").glob("*.png"))[-1]
        whole = stored.read_bytes()
        stored.write_bytes(whole[:-100])
        said = self.run_in(at_home, collect, code=3)
        self.assertRegex(said, rf"film_2: render frame {int(stored.stem[-5:])} is not taken: images/{stored.name}: has ")
        self.run_in(self.folder / "machine_2", deliver, K="2", N="3")
        self.assertEqual(stored.read_bytes(), whole)
        self.run_in(at_home, collect)
        self.assert_equals_reference(folder)
        self.meniscus("farm", "verify", self.reference)
        self.assertEqual(sums(folder, "film.mp4"), sums(self.reference, "film.mp4"))
        # Neither unfinished files nor claims are sent.
        self.assertEqual([path for path in (self.server_folder / "store").rglob(".*")], [])
        received, sent = (after - before for after, before in zip(self.traffic(), begin))
        made = sum(path.stat().st_size for place in ("images", "scene", "state") for path in (folder / place).rglob("*.*"))
        print(f"the bundle {sum(path.stat().st_size for path in (folder / 'inputs').iterdir()):,} bytes of inputs, "
              f"{made:,} bytes made; to the store {received:,}, from it {sent:,}", flush=True)


if __name__ == "__main__":
    if not (NGINX and MODULE.exists() and shutil.which("rclone")):
        print("skipped: there is no nginx with WebDAV, or no rclone; Debian's nginx-light, libnginx-mod-http-dav-ext and rclone are")
        sys.exit(SKIPPED)
    main()
