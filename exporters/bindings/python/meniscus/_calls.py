# SPDX-License-Identifier: BSD-3-Clause
"""Runs long calls of the library on a thread of their own, so that Ctrl-C interrupts the main thread while it waits."""
from __future__ import annotations

import _thread
import sys
import threading
from typing import Any, Callable


def interruptible(function: Callable[[], Any]) -> Any:
    """Returns the result of a function, which has to end by itself.

    In the main thread another thread runs it. After Ctrl-C this function raises KeyboardInterrupt at once. The other
    thread finishes the function and drops the result. Until then it keeps the variables of all callers alive, because
    the library reads their arrays."""
    if threading.current_thread() is not threading.main_thread():
        return function()
    done = _thread.allocate_lock()
    kept: list[Any] = []
    result: Any = None
    error: Any = None

    def run() -> None:
        nonlocal result, error
        try:
            result = function()
        except BaseException as raised:
            error = raised
        done.release()
        kept.clear()

    done.acquire()
    _thread.start_new_thread(run, ())
    try:
        done.acquire()
    except BaseException:
        frame: Any = sys._getframe()
        while frame is not None and done.locked():
            kept.append(frame)
            frame = frame.f_back
        raise
    if error is not None:
        raise error
    return result
