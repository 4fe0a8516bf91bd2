# SPDX-License-Identifier: GPL-3.0-or-later
"""A thread that computes one surface after the other, of each object only what was asked for last."""

import collections
import threading
import time

from . import engines


class Task:
    """owner: whose it is. key: what it is for. work: takes the task, gives the result. stage: what it does now, for people."""

    def __init__(self, owner, key, work):
        self.owner, self.key, self.work = owner, key, work
        self.stage = "Waiting"
        self.began = time.monotonic()
        self.result = self.error = None
        self.finished = threading.Event()
        self._unwanted = threading.Event()

    def say(self, stage):
        self.stage = stage

    def cancel(self):
        self._unwanted.set()

    def check(self):
        """Raises engines.Cancelled when nobody waits for it."""
        if self._unwanted.is_set():
            raise engines.Cancelled()

    @property
    def is_cancelled(self):
        return self._unwanted.is_set()

    def run(self):
        """To its end, whatever that is; result or error are set then, but of a cancelled one neither."""
        try:
            self.check()
            self.result = self.work(self)
            self.check()
        except engines.Cancelled:
            self.result = None
        except Exception as error:  # goes to whoever takes it
            self.error = error
        finally:
            self.finished.set()


class Worker:
    """One thread, which lives while there is something to do."""

    def __init__(self):
        self._lock = threading.Lock()
        self._waiting = collections.OrderedDict()  # owner -> Task
        self._running = None
        self._done = collections.deque()
        self._thread = None

    def ask(self, task):
        """Puts a task behind the others; what waits of the same owner falls away. What runs goes on, so that something shows
        while a slider moves on and on."""
        with self._lock:
            self._waiting.pop(task.owner, None)
            self._waiting[task.owner] = task
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="meniscus", daemon=True)
                self._thread.start()

    def task_of(self, owner):
        """What waits or runs for it, the newest; None: nothing."""
        with self._lock:
            running = self._running if self._running is not None and self._running.owner == owner else None
            return self._waiting.get(owner) or running

    def cancel(self, owner):
        """True if there was something."""
        with self._lock:
            waiting = self._waiting.pop(owner, None)
            running = self._running if self._running is not None and self._running.owner == owner else None
            for task in (waiting, running):
                if task is not None:
                    task.cancel()
            return waiting is not None or running is not None

    def is_busy(self):
        with self._lock:
            return self._thread is not None or bool(self._done)

    def take(self):
        """Finished tasks, the oldest first; none that was cancelled."""
        taken = []
        with self._lock:
            while self._done:
                taken.append(self._done.popleft())
        return [task for task in taken if not task.is_cancelled]

    def forget(self):
        """Cancels everything and waits for the thread."""
        with self._lock:
            for task in self._waiting.values():
                task.cancel()
            self._waiting.clear()
            if self._running is not None:
                self._running.cancel()
            thread = self._thread
        if thread is not None:
            thread.join()
        self.take()

    def _work(self):
        while True:
            with self._lock:
                if not self._waiting:
                    self._thread = None
                    return
                _, self._running = self._waiting.popitem(last=False)
            self._running.run()
            with self._lock:
                self._done.append(self._running)
                self._running = None
