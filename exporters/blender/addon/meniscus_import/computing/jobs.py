# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads that compute one surface after another. Only the latest request of each object is computed."""

import collections
import threading

from . import engines


class Task:
    """A task for a thread. owner: identifies the object that needs the result. key: identifies the task. work: a
    function of the task that returns the result. urgency: waiting tasks are done in this order."""

    def __init__(self, owner, key, work, urgency=0):
        self.owner, self.key, self.work, self.urgency = owner, key, work, urgency
        self.result = self.error = None
        self.finished = threading.Event()
        self._unwanted = threading.Event()

    def report(self, stage):
        """Receives the name of the current stage for the user. It does nothing by default."""

    def cancel(self):
        self._unwanted.set()

    def check(self):
        """Raises engines.Cancelled if the result is no longer needed."""
        if self._unwanted.is_set():
            raise engines.Cancelled()

    @property
    def is_cancelled(self):
        return self._unwanted.is_set()

    def run(self):
        """Runs the task to its end, and sets result or error. A cancelled task has neither."""
        try:
            self.check()
            self.result = self.work(self)
            self.check()
        except engines.Cancelled:
            self.result = None
        except Exception as error:  # reported where the result is used
            self.error = error
        finally:
            self.finished.set()


class Worker:
    """A pool of threads that live while there are tasks. They do one task of each owner at a time."""

    def __init__(self, give, threads=1):
        """give: a function that receives each finished task on its thread, except cancelled ones. threads: their
        greatest number."""
        self._give, self._most = give, threads
        self._lock = threading.Lock()
        self._waiting = collections.OrderedDict()  # owner -> Task
        self._running = []
        self._threads = 0

    def submit(self, task):
        """Adds a task after waiting ones of the same urgency. A waiting task of the same owner is dropped, and a
        running one continues."""
        with self._lock:
            self._waiting.pop(task.owner, None)
            self._waiting[task.owner] = task
            if self._threads < self._most:
                self._threads += 1
                threading.Thread(target=self._work, name="meniscus", daemon=True).start()

    def cancel(self, owner):
        """Cancels the tasks of an owner. Returns True if there was one that waited or ran."""
        with self._lock:
            found = [
                task for task in (self._waiting.pop(owner, None), *self._running)
                if task is not None and task.owner == owner]
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
        """Removes and returns the most urgent waiting task whose owner has none running, or returns None."""
        busy = {task.owner for task in self._running}
        free = [task for task in self._waiting.values() if task.owner not in busy]
        return self._waiting.pop(min(free, key=lambda task: task.urgency).owner) if free else None
