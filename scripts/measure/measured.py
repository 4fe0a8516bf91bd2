# SPDX-License-Identifier: BSD-3-Clause
"""Runs a program once and says what it cost."""

import os
import subprocess
import sys
import threading
import time
from dataclasses import dataclass


@dataclass
class Cost:
    """Of one process: seconds on the clock, CPU seconds, its largest memory in MB, and what it printed."""
    wall: float
    busy: float
    peak: float
    output: str


def measured(command, *, log=None, patience=None, **options):
    """The cost of a command; None after `patience` seconds. Messages go to the file `log`, as does output then. Ends this
    program if the command fails. options: of subprocess.Popen, such as cwd and env."""
    begin = time.perf_counter()
    with open(log or os.devnull, "w", encoding="utf-8") as messages:
        process = subprocess.Popen(command, stdout=messages if log else subprocess.PIPE, stderr=messages, text=True, **options)
    late = threading.Event()
    timer = threading.Timer(patience or 0, lambda: (late.set(), process.kill()))
    if patience:
        timer.start()
    output = "" if log else process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - begin
    timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    if late.is_set():
        return None
    if status:
        sys.exit(f"{os.path.basename(sys.argv[0])}: error: {' '.join(map(str, command))} ended with {process.returncode}"
                 + (f"; see {log}" if log else ""))
    return Cost(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, output)
