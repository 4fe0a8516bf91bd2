# SPDX-License-Identifier: BSD-3-Clause
"""Runs long calls of the library on a second thread, so that Ctrl-C interrupts the main thread while it waits."""
from __future__ import annotations

import os
import queue
import sys
import threading
from typing import Any, Callable, Optional


class _Job:
    """A call that another thread runs. result: what the function returned, after `done` is released."""

    __slots__ = ("done", "function", "kept", "result")

    def __init__(self, function: Callable[[], Any]) -> None:
        self.function = function
        self.done = threading.Lock()
        self.done.acquire()
        self.result: Any = None
        self.kept: list[Any] = []


class _Worker:
    """A thread that runs one job after the other. It ends with Python."""

    def __init__(self) -> None:
        self.process = os.getpid()
        self.jobs: queue.SimpleQueue[_Job] = queue.SimpleQueue()
        threading.Thread(target=self._run, name="meniscus", daemon=True).start()

    def _run(self) -> None:
        while True:
            job = self.jobs.get()
            job.result = job.function()
            job.done.release()
            del job  # before the thread waits, so that what an interrupted job keeps is freed


_worker: Optional[_Worker] = None


def interruptible(function: Callable[[], Any]) -> Any:
    """Returns the result of a function, which must not raise and has to end by itself.

    In the main thread another thread runs it. After Ctrl-C this function raises KeyboardInterrupt at once; the other
    thread finishes the function, whose result is dropped, and keeps all variables of the callers alive until then,
    because the library reads their arrays."""
    global _worker
    if threading.current_thread() is not threading.main_thread():
        return function()
    if _worker is None or _worker.process != os.getpid():  # threads do not survive a fork
        _worker = _Worker()
    job = _Job(function)
    _worker.jobs.put(job)
    try:
        job.done.acquire()
    except BaseException:
        frame = sys._getframe()
        while frame is not None and job.done.locked():
            job.kept.append(frame)
            frame = frame.f_back  # type: ignore[assignment]
        _worker = None  # it is busy; the next call gets another one
        raise
    return job.result
