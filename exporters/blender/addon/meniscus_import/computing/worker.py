# SPDX-License-Identifier: GPL-3.0-or-later
"""The program that computes for the add-on in a process of its own: it takes tasks from a connection and returns
results.

process.py starts it. A message is a tuple of a word, plain values and numpy arrays. The program receives "begin"
(sys.path, package, program, folder for temporary files), "do" (number, owner, urgency, kind of work, its arguments) and
"forget" (owner). It sends "stage" (number, text), "done" (number, result) and "failed" (number, text)."""

import os
import signal
import sys
import threading
import types

#: The number of surfaces that are computed at a time. The mesh of each is made by one core.
THREADS = min(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1, 4)
_sending = threading.Lock()


def main(descriptor=""):
    adopt(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    from meniscus_import.computing import messages

    connection = messages.of_descriptor(int(descriptor)) if descriptor else messages.of_share(sys.stdin.buffer.read())
    _, sys.path[:], package, program, folder = connection.receive()
    from meniscus_import.computing import jobs  # needs sys.path to find numpy

    tools = jobs.Tools(package, program, folder)
    worker = jobs.Worker(lambda task: send(connection, *outcome(task)), THREADS)
    while True:
        try:
            word, *rest = connection.receive()
        except (EOFError, OSError):
            leave()
        if word == "do":
            worker.submit(task_of(jobs.Task, tools, connection, *rest))
        elif word == "forget":
            worker.cancel(*rest)


def adopt(folder):
    """Makes the modules of the add-on importable under its name without importing the add-on, which needs Blender."""
    package = types.ModuleType("meniscus_import")
    package.__path__ = [folder]
    sys.modules["meniscus_import"] = package


def task_of(kind_of_task, tools, connection, number, owner, urgency, kind, about):
    task = kind_of_task(owner, number, lambda task: getattr(tools, kind)(task, **about), urgency)
    task.report = lambda stage: send(connection, "stage", number, stage)
    return task


def send(connection, *message):
    try:
        with _sending:  # messages of several threads must not mix
            connection.send(message)
    except OSError:
        leave()


def leave():
    """Ends this process and the programs that it started, because Blender has ended."""
    if os.name == "nt":  # it starts no programs on Windows
        os._exit(1)
    os.killpg(0, signal.SIGKILL)


def outcome(task):
    if task.error is not None:
        return "failed", task.key, str(task.error) or type(task.error).__name__
    return "done", task.key, task.result


if __name__ == "__main__":
    main(*sys.argv[1:])
