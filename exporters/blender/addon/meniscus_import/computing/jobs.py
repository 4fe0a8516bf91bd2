# SPDX-License-Identifier: GPL-3.0-or-later
"""A thread that computes one surface after the other, of each object only what was asked for last."""

import collections
import threading

from . import engines


class Task:
    """owner: whose it is. key: what it is for. work: takes the task, gives the result. urgency: what waits is done in this order."""

    def __init__(self, owner, key, work, urgency=0):
        self.owner, self.key, self.work, self.urgency = owner, key, work, urgency
        self.result = self.error = None
        self.finished = threading.Event()
        self._unwanted = threading.Event()

    def say(self, stage):
        """What it does now, for people."""

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

    def __init__(self, give):
        """give: takes each task that is done, but cancelled ones, on that thread."""
        self._give = give
        self._lock = threading.Lock()
        self._waiting = collections.OrderedDict()  # owner -> Task
        self._running = None
        self._thread = None

    def ask(self, task):
        """Puts a task behind those that are as urgent; what waits of the same owner falls away, what runs goes on."""
        with self._lock:
            self._waiting.pop(task.owner, None)
            self._waiting[task.owner] = task
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="meniscus", daemon=True)
                self._thread.start()

    def cancel(self, owner):
        """True if there was something that waited or ran."""
        with self._lock:
            found = [task for task in (self._waiting.pop(owner, None), self._running) if task is not None and task.owner == owner]
            for task in found:
                task.cancel()
            return bool(found)

    def _work(self):
        while True:
            with self._lock:
                if not self._waiting:
                    self._thread = None
                    return
                first = min(self._waiting.values(), key=lambda task: task.urgency)
                self._running = self._waiting.pop(first.owner)
            self._running.run()
            with self._lock:
                done, self._running = self._running, None
            if not done.is_cancelled:
                self._give(done)
