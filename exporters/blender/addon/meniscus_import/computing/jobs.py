# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads that compute one surface after another; of each object only the latest request is computed."""

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
        """Raises engines.Cancelled when its result is no longer wanted."""
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
        except Exception as error:  # raised again where the result is taken
            self.error = error
        finally:
            self.finished.set()


class Worker:
    """Threads, which live while there is something to do; of one owner they do one task at a time."""

    def __init__(self, give, threads=1):
        """give: takes each task that is done, but cancelled ones, on its thread. threads: at most."""
        self._give, self._most = give, threads
        self._lock = threading.Lock()
        self._waiting = collections.OrderedDict()  # owner -> Task
        self._running = []
        self._threads = 0

    def ask(self, task):
        """Puts a task after those that are as urgent. Tasks of the same owner that still wait are dropped; one that runs goes on."""
        with self._lock:
            self._waiting.pop(task.owner, None)
            self._waiting[task.owner] = task
            if self._threads < self._most:
                self._threads += 1
                threading.Thread(target=self._work, name="meniscus", daemon=True).start()

    def cancel(self, owner):
        """True if there was something that waited or ran."""
        with self._lock:
            found = [task for task in (self._waiting.pop(owner, None), *self._running) if task is not None and task.owner == owner]
            for task in found:
                task.cancel()
            return bool(found)

    def _work(self):
        done = None
        while True:
            with self._lock:
                if done is not None:
                    self._running.remove(done)
                done = self._next()
                if done is None:
                    self._threads -= 1
                    return
                self._running.append(done)
            done.run()
            if not done.is_cancelled:
                self._give(done)

    def _next(self):
        """The most urgent that may begin, and waits no more; None: there is none."""
        busy = {task.owner for task in self._running}
        free = [task for task in self._waiting.values() if task.owner not in busy]
        return self._waiting.pop(min(free, key=lambda task: task.urgency).owner) if free else None
