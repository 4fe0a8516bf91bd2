# SPDX-License-Identifier: BSD-3-Clause
"""Runs long calls of the library on a thread of their own, so that Ctrl-C interrupts the main thread while it waits."""
from __future__ import annotations

import _thread
import atexit
import os
import sys
import threading
from typing import Any, Callable


def _wait_for(done: Any) -> None:
    """Waits for an interrupted function before Python ends, because the library cannot end while it computes. Another
    Ctrl-C ends the process. done: the lock that is released when the function ends."""
    try:
        done.acquire()
    except KeyboardInterrupt:
        os._exit(130)


def interruptible(function: Callable[[], Any]) -> Any:
    """Returns the result of a function, which has to end by itself.

    In the main thread another thread runs it. After Ctrl-C this function raises KeyboardInterrupt at once. The other
    thread finishes the function and drops the result. Until then it keeps the variables of all callers alive, because
    the library reads their arrays."""
    if threading.current_thread() is not threading.main_thread():
        return function()
    done = _thread.allocate_lock()
    kept: list[Any] = []
    finished = False
    result: Any = None
    error: Any = None

    def run() -> None:
        nonlocal error, finished, result
        try:
            result = function()
        except BaseException as raised:
            error = raised
        finished = True
        kept.clear()
        done.release()

    done.acquire()
    try:
        _thread.start_new_thread(run, ())
        done.acquire()
    except BaseException:
        frame: Any = sys._getframe()
        while frame is not None and not finished:
            kept.append(frame)
            frame = frame.f_back
        if not finished:  # otherwise this thread may have the lock
            atexit.register(_wait_for, done)  # after those of the package, so that it is called before them
        raise
    if error is not None:
        raise error
    return result
