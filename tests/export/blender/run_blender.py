# SPDX-License-Identifier: BSD-3-Clause
"""Exports samples, then runs a script inside Blender: arguments BLENDER PROGRAM ADDON_FOLDER SCRIPT."""

import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import samples  # noqa: E402

blender, program, addon, script = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    for name in samples.MOLECULES:
        samples.export(program, folder, name, "--size", "160x120", "--tolerance", "0.004")
    samples.export_run(program, os.path.join(folder, "run"))
    samples.export_run(program, os.path.join(folder, "turning"), "1-5:2", "--turntable", "0.6")
    scripts = os.path.join(folder, "scripts")
    os.makedirs(os.path.join(scripts, "addons"))
    os.symlink(os.path.join(addon, "meniscus_import"), os.path.join(scripts, "addons", "meniscus_import"))
    done = subprocess.run(
        [blender, "-b", "--factory-startup", "--addons", "meniscus_import", "--python-exit-code", "3", "--python", script,
         "--", folder, addon, os.path.dirname(os.path.abspath(__file__)), blender, program],
        env={**os.environ, "BLENDER_USER_SCRIPTS": scripts, "PYTHONDONTWRITEBYTECODE": "1"}, check=False)
    sys.exit(done.returncode)
