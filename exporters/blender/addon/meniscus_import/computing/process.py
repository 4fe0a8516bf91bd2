# SPDX-License-Identifier: GPL-3.0-or-later
"""The process that computes for the add-on, and the requests sent to it. It does not use Blender.

The add-on uses no threads, because they make Blender crash. An operator that a script calls reads the script's context
without the interpreter's lock while another thread holds it (BPY_context_member_get and PyC_IsInterpreterActive, seen
in 3.4.1), and so do drivers. Blender's manual requires that threads end with the script that started them. Therefore
long computations run in another process, which is polled."""

import os
import signal
import subprocess
import sys
import time

from . import engines, messages

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "worker.py")
#: Urgencies of waiting tasks: surfaces to show now, and surfaces that may show next.
NOW, NEXT = 0, 1


class Job:
    """A request to the process.

    owner: identifies the object that needs the result. Only the newest waiting job of an owner is done.
    key: identifies the result.
    stage: the name of the current stage for the user.
    began: the time of the request by time.monotonic().
    is_done: True as soon as result or error (engines.EngineError) is set.
    make: a function that converts the result, set by the caller."""

    def __init__(self, owner, key):
        self.owner, self.key = owner, key
        self.stage = "Waiting"
        self.began = time.monotonic()
        self.is_done = False
        self.result = self.error = self.make = None


class Process:
    """A process that starts when it is first needed, and starts again if it ended."""

    def __init__(self, package="", program="", folder=None):
        """package, program: arguments of engines.find_tools(). folder: a folder for temporary files, or None."""
        self.package, self.program = package, program
        self._begin = ("begin", list(sys.path), package, program, folder)
        self._child = self._connection = self._tools = None
        self._jobs = {}  # number -> unfinished Job
        self._over = []  # finished jobs that take() has not returned yet
        self._number = 0

    def submit(self, owner, key, kind, about, urgency=NOW):
        """Sends a request and returns its Job. kind: the name of a function of jobs.Tools; about: its arguments.
        Waiting jobs of the same owner are dropped. A running one continues, so that surfaces show while a slider keeps
        moving. Raises engines.EngineError if the process does not start."""
        self._start()
        self._number += 1
        self._jobs[self._number] = job = Job(owner, key)
        self._send(("do", self._number, owner, urgency, kind, about))
        return job

    def job_of(self, owner):
        """Returns the newest unfinished job of an owner, or None."""
        return next((job for job in reversed(self._jobs.values()) if job.owner == owner), None)

    def is_busy(self):
        return bool(self._jobs or self._over)

    def drop(self, owner):
        """Drops the jobs of an owner. A running one continues to its next stage. Returns True if there was one."""
        numbers = [number for number, job in self._jobs.items() if job.owner == owner]
        for number in numbers:
            del self._jobs[number]
        if numbers:
            self._send(("forget", owner))
        return bool(numbers)

    def drop_all(self):
        for owner in {job.owner for job in self._jobs.values()}:
            self.drop(owner)

    def stop(self, owner):
        """Stops the jobs of an owner immediately by ending the process, so that all other jobs fail. Returns True if
        there was one."""
        if self.job_of(owner) is None:
            return False
        self.drop(owner)
        self.end()
        return True

    def take(self, seconds=0.0):
        """Returns the jobs that were finished meanwhile, the oldest first. seconds: the time to wait for the first
        message."""
        done, self._over = self._over, []
        try:
            while self._connection is not None and self._connection.is_there(seconds):
                seconds = 0.0
                job = self._hear(*self._connection.receive())
                if job is not None:
                    done.append(job)
        except (EOFError, OSError):
            self._lost()
            done, self._over = done + self._over, []
        return done

    def wait(self, job):
        """Waits until a job is done, and returns all jobs that were finished meanwhile, including it."""
        done = []
        while not job.is_done and self.is_busy():
            done += self.take(1.0)
        return done

    def describe_tools(self):
        """Returns the result of jobs.Tools.describe_tools() in the process. Raises engines.EngineError if the process
        does not start."""
        if self._tools is None:
            job = self.submit(None, None, "describe_tools", {})
            self._over += [other for other in self.wait(job) if other is not job]
            if job.error is not None:
                raise job.error
            self._tools = job.result
        return self._tools

    def end(self):
        """Ends the process and its children. Unfinished jobs fail."""
        self._close(0.0)
        self._fail_all("computing was stopped")

    def _start(self):
        if self._connection is not None:
            return
        connection, theirs = messages.pair()
        try:
            self._child = _started(theirs)
        except OSError as error:
            raise engines.EngineError(f"the process that computes does not start: {error}") from None
        finally:
            theirs.close()
        self._connection = connection
        self._send(self._begin)

    def _send(self, message):
        try:
            self._connection.send(message)
        except (OSError, AttributeError):
            pass  # the process has ended, which take() notices

    def _hear(self, word, number, what):
        job = self._jobs.get(number)
        if job is None:  # it was dropped
            return None
        if word == "stage":
            job.stage = what
            return None
        for other in [other for other, older in self._jobs.items() if older.owner == job.owner and other <= number]:
            del self._jobs[other]  # the process dropped older ones for this one
        job.is_done = True
        if word == "done":
            job.result = what
        else:
            job.error = engines.EngineError(what)
        return job

    def _lost(self):
        code = self._close(1.0)
        self._fail_all(f"the process that computes ended {f'by signal {-code}' if code < 0 else f'with {code}'}")

    def _close(self, seconds):
        """Closes the connection, waits up to `seconds` for the end of the process, kills it with its children, and
        returns its exit code."""
        child, connection = self._child, self._connection
        self._child = self._connection = None
        if connection is not None:
            connection.close()
        if child is None:
            return 0
        try:
            child.wait(seconds)
        except subprocess.TimeoutExpired:
            pass
        _kill(child)
        return child.wait()

    def _fail_all(self, text):
        for job in self._jobs.values():
            job.is_done, job.error = True, engines.EngineError(text)
        self._over += self._jobs.values()
        self._jobs.clear()


def _started(connection):
    """Starts the process at the other end of a connection, and returns it."""
    words = [python(), "-B", SCRIPT]
    if os.name != "nt":
        return subprocess.Popen([*words, str(connection.fileno())], pass_fds=[connection.fileno()],
                                stdin=subprocess.DEVNULL, start_new_session=True)
    child = subprocess.Popen(words, stdin=subprocess.PIPE, creationflags=subprocess.CREATE_NO_WINDOW)
    with child.stdin:  # Windows can share a socket only with a process that exists already
        child.stdin.write(connection.share(child.pid))
    return child


def _kill(child):
    """Kills a process with its children. On Windows it has none."""
    if os.name == "nt":
        child.kill()
        return
    try:
        os.killpg(child.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def python():
    """Returns the path of the Python interpreter that belongs to this one. Blender's sys.executable may name another
    interpreter of the path outside of Windows, so sys.prefix is tried first there."""
    names = () if os.name == "nt" else (f"python{sys.version_info.major}.{sys.version_info.minor}", "python3")
    places = [*(os.path.join(sys.prefix, "bin", name) for name in names), sys.executable]
    return next((place for place in places if os.path.exists(place)), sys.executable)
