# SPDX-License-Identifier: BSD-3-Clause
"""`python -m meniscus`: runs the program of this installation, or the one on the PATH."""
import os
import shutil
import subprocess
import sys
import sysconfig


def main() -> int:
    """Runs the program with the arguments, and returns its exit code."""
    program = shutil.which("meniscus", path=sysconfig.get_path("scripts")) or shutil.which("meniscus")
    if program is None:
        sys.exit("python -m meniscus: the program is not installed, only the library; see docs/how-to/install.md")
    if os.name == "posix":
        os.execv(program, ["meniscus", *sys.argv[1:]])
    return subprocess.call([program, *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
