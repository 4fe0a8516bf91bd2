# SPDX-License-Identifier: BSD-3-Clause
"""Packs the Python package and a libmeniscus of this machine into a wheel for tests: LIBRARY PACKAGE FOLDER."""

import base64
import hashlib
import os
import re
import sys
import zipfile

LIBRARY, PACKAGE, FOLDER = sys.argv[1:]
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), *[os.pardir] * 3)


def text_of(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


version = re.search(r"project\(meniscus VERSION ([0-9.]+)", text_of("CMakeLists.txt")).group(1)
tag, info = f"py3-none-linux_{os.uname().machine}", f"meniscus_ses-{version}.dist-info"
contents = {f"{info}/METADATA": f"Metadata-Version: 2.1\nName: meniscus-ses\nVersion: {version}\n".encode(),
            f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: native_wheel\nRoot-Is-Purelib: false\nTag: {tag}\n".encode(),
            f"{info}/licenses/LICENSE": text_of("LICENSE").encode()}
paths = [os.path.join(PACKAGE, name) for name in os.listdir(PACKAGE) if name.endswith((".py", ".typed"))]
for name, path in [("libmeniscus.so", LIBRARY), *((os.path.basename(path), path) for path in paths)]:
    with open(path, "rb") as file:
        contents["meniscus/" + name] = file.read()
rows = [f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip('=')},{len(data)}"
        for name, data in contents.items()]
contents[f"{info}/RECORD"] = "\n".join([*rows, f"{info}/RECORD,,", ""]).encode()
os.makedirs(FOLDER, exist_ok=True)
with zipfile.ZipFile(os.path.join(FOLDER, f"meniscus_ses-{version}-{tag}.whl"), "w", zipfile.ZIP_DEFLATED) as wheel:
    for name, data in contents.items():
        wheel.writestr(name, data)
