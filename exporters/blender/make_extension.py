# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes extensions for Blender 4.2 and later from the add-on: one zip file per platform with the wheel of the Python
package inside.

    make_extension.py WHEELS OUT [PLATFORM...]

WHEELS: a folder with meniscus_ses-VERSION-py3-none-*.whl in the version of the add-on. OUT: a folder, created if it
does not exist, for meniscus_import-VERSION-PLATFORM.zip. Without PLATFORM, all platforms are made. The same files give
the same bytes."""

import fnmatch
import os
import re
import sys
import zipfile

ADDON = os.path.join(os.path.dirname(os.path.abspath(__file__)), "addon", "meniscus_import")
MANIFEST = "blender_manifest.toml"
#: Blender's names of platforms, and patterns of the tags of their wheels.
PLATFORMS = {
    "linux-x64": ("*linux*_x86_64",), "linux-arm64": ("*linux*_aarch64",), "windows-x64": ("win_amd64",),
    "macos-arm64": ("macosx_*_arm64", "macosx_*_universal2"), "macos-x64": ("macosx_*_x86_64", "macosx_*_universal2")}
LICENSE = 'license = ["SPDX:GPL-3.0-or-later"]'
LICENSES = 'license = ["SPDX:GPL-3.0-or-later", "SPDX:BSD-3-Clause"]'


class Refusal(Exception):
    """An error of the user. Its text is one sentence."""


def find_wheel(folder, platform, version):
    """Returns the path of the wheel for a platform. Raises Refusal if there is none or more than one, or if it has
    another version or no licence."""
    found = [name for name in sorted(os.listdir(folder)) if name.startswith("meniscus_ses-") and name.endswith(".whl")
             and any(fnmatch.fnmatch(name[:-len(".whl")].split("-")[-1], tag) for tag in PLATFORMS[platform])]
    if not found:
        raise Refusal(f"{folder}: there is no wheel of meniscus for {platform}")
    if len(found) > 1:
        raise Refusal(f"{folder}: there is more than one wheel of meniscus for {platform}: {', '.join(found)}")
    if found[0].split("-")[1] != version:
        raise Refusal(f"{os.path.join(folder, found[0])}: the add-on is of version {version}")
    path = os.path.join(folder, found[0])
    if not zipfile.is_zipfile(path):
        raise Refusal(f"{path}: it is not a wheel")
    with zipfile.ZipFile(path) as wheel:
        if not any("/LICENSE" in name for name in wheel.namelist()):
            raise Refusal(f"{path}: it has no file LICENSE")
    return path


def manifest_with(manifest, platform, wheel):
    """Returns the add-on's manifest for an extension with a wheel."""
    more = f'{LICENSES}\nplatforms = ["{platform}"]\nwheels = ["./wheels/{os.path.basename(wheel)}"]'
    assert manifest.count(LICENSE) == 1
    return manifest.replace(LICENSE, more)


def files_of_addon():
    """Returns the files of the add-on: names relative to its folder, with /, and their paths."""
    found = {}
    for folder, _, names in os.walk(ADDON):
        if os.path.basename(folder) != "__pycache__":
            for path in (os.path.join(folder, name) for name in names):
                found[os.path.relpath(path, ADDON).replace(os.sep, "/")] = path
    return found


def write(target, platform, wheel):
    """Writes the extension for one platform."""
    contents = {**files_of_addon(), f"wheels/{os.path.basename(wheel)}": wheel}
    with zipfile.ZipFile(target, "w") as archive:
        for name in sorted(contents):
            with open(contents[name], "rb") as file:
                data = file.read()
            if name == MANIFEST:
                data = manifest_with(data.decode(), platform, wheel).encode()
            entry = zipfile.ZipInfo(name)  # dated 1980, so that equal files give equal bytes
            entry.create_system, entry.external_attr = 3, 0o644 << 16  # the permissions of a Unix file
            entry.compress_type = zipfile.ZIP_STORED if name.endswith(".whl") else zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)


def make(wheels, out, platforms):
    """Makes the extensions and returns their paths. Raises Refusal before anything is written, or OSError."""
    unknown = [platform for platform in platforms if platform not in PLATFORMS]
    if unknown:
        raise Refusal(f"{unknown[0]} is not one of {', '.join(PLATFORMS)}")
    with open(os.path.join(ADDON, MANIFEST), encoding="utf-8") as file:
        version = re.search(r'^version = "(.+)"$', file.read(), re.M).group(1)
    found = {platform: find_wheel(wheels, platform, version) for platform in platforms or PLATFORMS}
    os.makedirs(out, exist_ok=True)
    made = []
    for platform, wheel in found.items():
        made.append(os.path.join(out, f"meniscus_import-{version}-{platform.replace('-', '_')}.zip"))
        write(made[-1], platform, wheel)
    return made


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("usage: make_extension.py WHEELS OUT [PLATFORM...]")
    try:
        print(*make(sys.argv[1], sys.argv[2], sys.argv[3:]), sep="\n")
    except Refusal as refusal:
        sys.exit(f"make_extension.py: {refusal}")
    except OSError as error:
        sys.exit(f"make_extension.py: {error.filename}: {error.strerror}")
