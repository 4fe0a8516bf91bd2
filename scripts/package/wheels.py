#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Packs the libraries and programs that scripts/package/targets.sh built into wheels, one a system, with the notices of all that is in
them.

    wheels.py OUT [TARGET...]      targets as in targets.sh; all that are built by default

The same files give the same bytes. MENISCUS_URL is the address of the project, for the wheels' metadata; by default it is that of
the repository in which GitHub runs this. Each wheel has the package, its library, the programs as scripts, which installers put
beside Python, LICENSE, THIRD_PARTY.txt with the licences of what is linked into them, and a bill of materials (CycloneDX 1.5;
PEP 770)."""

import base64
import glob
import hashlib
import json
import os
import re
import stat
import subprocess
import sys
import tomllib
import urllib.parse
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILT = os.path.join(ROOT, "build", "targets")
PACKAGE = os.path.join(ROOT, "exporters", "bindings", "python", "meniscus")
#: The name for installers and wheels. On PyPI "meniscus" is another project; Python imports meniscus.
DISTRIBUTION, WHEEL = "meniscus-ses", "meniscus_ses"
#: For each target its tag, and the name of its library.
TARGETS = {"x86_64-linux": ("manylinux_2_28_x86_64", "libmeniscus.so"),
           "aarch64-linux": ("manylinux_2_28_aarch64", "libmeniscus.so"),
           "x86_64-windows": ("win_amd64", "meniscus.dll"),
           "aarch64-macos": ("macosx_13_0_arm64", "libmeniscus.dylib"),
           "x86_64-macos": ("macosx_13_0_x86_64", "libmeniscus.dylib")}
#: The programs in all wheels, and their files; a wheel has no links, so two names are two copies.
PROGRAMS = {"meniscus": "meniscus", "meniscus-msms": "meniscus-msms", "meniscus-nanoshaper": "meniscus-nanoshaper",
            "meniscus-pdb_to_xyzr": "meniscus-pdb_to_xyzr", "meniscus-pdb_to_xyzrn": "meniscus-pdb_to_xyzr"}
#: Parts that are linked or compiled into the library and the programs: name, licence, and the file with its text, below
#: build/targets/sources or in the system. The first file that exists counts.
PARTS = [("oneTBB", "Apache-2.0", "onetbb-*/LICENSE.txt"), ("FreeType", "FTL", "freetype-*/docs/FTL.TXT"),
         ("zlib", "Zlib", "zlib-*/LICENSE"), ("libdeflate", "MIT", "libdeflate-*/COPYING"),
         ("libjpeg-turbo", "IJG AND BSD-3-Clause", "libjpeg-turbo-*/LICENSE.md"), ("libtiff", "libtiff", "tiff-*/LICENSE.md"),
         ("Boost", "BSL-1.0", "/usr/share/doc/libboost1.74-dev/copyright"),
         ("fmt", "MIT", "fmtlib-*/LICENSE.rst"), ("musl", "MIT", "musl-*/COPYRIGHT"), ("gemmi", "MPL-2.0", "gemmi-*/LICENSE*"),
         ("PEGTL", "MIT", "/usr/share/doc/tao-pegtl-dev/copyright"), ("GLM", "MIT", "/usr/share/doc/libglm-dev/copyright"),
         ("Liberation Sans", "OFL-1.1", "/usr/share/doc/fonts-liberation2/copyright"),
         ("nlohmann-json", "MIT", "/usr/share/doc/nlohmann-json3-dev/copyright"),
         ("CLI11", "BSD-3-Clause", "/usr/share/doc/libcli11-dev/copyright"),
         ("LLVM libc++", "Apache-2.0 WITH LLVM-exception", "../tools/lib/python3*/site-packages/ziglang-*.dist-info/licenses/ziglang/lib/libcxx/LICENSE.TXT")]


def version():
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\(meniscus VERSION ([0-9.]+)", file.read())[1]


def text_of(name, pattern):
    found = sorted(glob.glob(os.path.join(BUILT, "sources", pattern)))
    if not found:
        sys.exit(f"wheels.py: the licence of {name} is not at {pattern}; run scripts/package/targets.sh first")
    with open(found[0], encoding="utf-8", errors="replace") as file:
        return file.read()


def origin_of(pattern):
    """Returns the version of a part and its package URL, by which scanners know it."""
    package = pattern.removeprefix("/usr/share/doc/").split("/")[0].removesuffix("-*")
    folder = os.path.join(BUILT, "sources")
    if pattern.startswith("/"):
        number = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], check=True, capture_output=True, text=True).stdout
        return number, f"pkg:deb/debian/{package}@{urllib.parse.quote(number, safe='')}?distro=bookworm"
    described = sorted(glob.glob(os.path.join(folder, f"{package}_*.dsc")))
    if described:  # a Debian source has the number of its patches
        number = os.path.basename(described[0]).removesuffix(".dsc").partition("_")[2]
        return number, f"pkg:deb/debian/{package}@{urllib.parse.quote(number, safe='')}?arch=source&distro=bookworm"
    path = sorted(glob.glob(os.path.join(folder, pattern)))[0]
    package, number = re.search(r"([a-z]+)-([0-9][0-9.]*[0-9])", os.path.relpath(path, folder)).groups()
    return number, f"pkg:pypi/{package}@{number}"


def third_party():
    begin = "What is linked or compiled into the library and the programs of this package, in addition to Meniscus itself.\n"
    for name, licence, pattern in PARTS:
        number, source = origin_of(pattern)
        begin += f"\n{'=' * 80}\n{name} {number} ({licence}), from {source}\n{'=' * 80}\n\n{text_of(name, pattern)}"
    return begin


def materials():
    components = []
    for name, licence, pattern in PARTS:
        number, source = origin_of(pattern)
        components.append({"type": "library", "name": name, "version": number, "purl": source, "licenses": [{"expression": licence}]})
    return json.dumps({"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
                       "metadata": {"component": {"type": "library", "name": DISTRIBUTION, "version": version(),
                                                  "purl": f"pkg:pypi/{DISTRIBUTION}@{version()}",
                                                  "licenses": [{"expression": "BSD-3-Clause"}]}},
                       "components": components}, indent=1) + "\n"


def address():
    """Returns the address of the project; nothing if it is unknown."""
    on_github = "{GITHUB_SERVER_URL}/{GITHUB_REPOSITORY}".format_map(os.environ) if "GITHUB_REPOSITORY" in os.environ else ""
    return os.environ.get("MENISCUS_URL", on_github)


def metadata():
    with open(os.path.join(ROOT, "pyproject.toml"), "rb") as file:
        project = tomllib.load(file)["project"]
    with open(os.path.join(ROOT, project["readme"]), encoding="utf-8") as file:
        description = file.read()
    licences = [project["license"], *sorted({licence for _, licence, _ in PARTS} - {project["license"]})]
    rows = [("Metadata-Version", "2.4"), ("Name", DISTRIBUTION), ("Version", version()), ("Summary", project["description"]),
            ("Author", project["authors"][0]["name"]), ("License-Expression", " AND ".join(licences)), ("License-File", "LICENSE"),
            ("License-File", "THIRD_PARTY.txt"), ("Keywords", ",".join(project["keywords"])),
            *(("Classifier", words) for words in project["classifiers"]), ("Requires-Python", project["requires-python"]),
            *(("Requires-Dist", words) for words in project["dependencies"]), ("Description-Content-Type", "text/markdown")]
    if address():
        rows += [("Project-URL", f"{name}, {address()}{path}") for name, path in
                 (("Homepage", ""), ("Documentation", "/tree/main/docs"), ("Changelog", "/blob/main/CHANGELOG.md"), ("Issues", "/issues"))]
    return "".join(f"{name}: {value}\n" for name, value in rows) + "\n" + description


def read(path):
    with open(path, "rb") as file:
        return file.read()


def programs(target):
    """Returns the paths of programs by their names in the wheel, which installers make commands."""
    suffix = ".exe" if "windows" in target else ""
    return {f"{WHEEL}-{version()}.data/scripts/{name}{suffix}": os.path.join(BUILT, target, file + suffix)
            for name, file in PROGRAMS.items()}


def contents(target):
    """Returns the bytes of all files by their names in the wheel."""
    tag, library = TARGETS[target]
    info = f"{WHEEL}-{version()}.dist-info"
    files = {f"meniscus/{name}": read(os.path.join(PACKAGE, name)) for name in os.listdir(PACKAGE)
             if name.endswith(".py") or name == "py.typed"}
    files[f"meniscus/{library}"] = read(os.path.join(BUILT, target, library))
    files.update({name: read(path) for name, path in programs(target).items()})
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = ("Wheel-Version: 1.0\nGenerator: meniscus scripts/package/wheels.py\nRoot-Is-Purelib: false\n"
                              f"Tag: py3-none-{tag}\n").encode()
    files[f"{info}/licenses/LICENSE"] = read(os.path.join(ROOT, "LICENSE"))
    files[f"{info}/licenses/THIRD_PARTY.txt"] = third_party().encode()
    files[f"{info}/sboms/meniscus.cdx.json"] = materials().encode()
    record = "".join(f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},"
                     f"{len(data)}\n" for name, data in sorted(files.items()))
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    return files


def pack(target, out):
    """Writes the wheel of a target, completely or not at all, and returns its path."""
    path = os.path.join(out, f"{WHEEL}-{version()}-py3-none-{TARGETS[target][0]}.whl")
    files = contents(target)
    with zipfile.ZipFile(path + ".part", "w", zipfile.ZIP_DEFLATED) as wheel:
        for name in sorted(files, key=lambda name: (".dist-info/" in name, name)):
            entry = zipfile.ZipInfo(name)  # its default date is 1980
            executable = "libmeniscus" in name or ".data/scripts/" in name
            entry.create_system, entry.external_attr = 3, (stat.S_IFREG | (0o755 if executable else 0o644)) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, files[name], compresslevel=9)
    os.replace(path + ".part", path)
    return path


def main(arguments):
    if not arguments or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    out, *targets = arguments
    for target in targets:
        if target not in TARGETS:
            sys.exit(f"wheels.py: there is no target {target}; there are {', '.join(TARGETS)}")
    targets = targets or [t for t, (_, name) in TARGETS.items() if os.path.exists(os.path.join(BUILT, t, name))]
    if not targets:
        sys.exit("wheels.py: nothing is built; run scripts/package/targets.sh first")
    os.makedirs(out, exist_ok=True)
    for target in targets:
        path = pack(target, out)
        print(f"{path}  {os.path.getsize(path) / 1e6:.2f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
