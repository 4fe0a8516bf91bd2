# SPDX-License-Identifier: GPL-3.0-or-later
"""The process that computes for the add-on, and the requests sent to it; knows nothing of Blender.

Blender takes threads of Python badly: an operator that a script called looks things up in the script's context without the
interpreter's lock if any thread has it just then (BPY_context_member_get and PyC_IsInterpreterActive, seen in 3.4.1), and so do
drivers; it crashes. Its manual asks for threads to end with the script that began them. So there are none: what takes time
happens elsewhere, and is looked at from time to time."""

import os
import signal
import subprocess
import sys
import time

from . import engines, messages

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "worker.py")
#: Order among tasks that wait: what shall show now, what may show next.
NOW, NEXT = 0, 1


class Job:
    """What was asked for. owner: whose it is; of each the newest that has not begun is done. key: what it is for. stage: what is
    done now, for people. result or error (engines.EngineError) once it is done. make: what the result becomes, set by who asked."""

    def __init__(self, owner, key):
        self.owner, self.key = owner, key
        self.stage = "Waiting"
        self.began = time.monotonic()
        self.is_done = False
        self.result = self.error = self.make = None


class Process:
    """Started when it is first needed, and again if it ended."""

    def __init__(self, package="", program="", folder=None):
        """package, program: as of engines.find_tools. folder: for files that go again, or None."""
        self.package, self.program = package, program
        self._begin = ("begin", list(sys.path), package, program, folder)
        self._child = self._connection = self._told = None
        self._jobs = {}  # number -> Job that is not done
        self._over = []  # done, and nobody has taken them yet
        self._number = 0

    def ask(self, owner, key, kind, about, urgency=NOW):
        """A Job of one of works.Tools. What waits of the same owner falls away; what runs goes on, so that something shows while
        a slider moves on and on. Raises engines.EngineError if nothing can be computed."""
        self._start()
        self._number += 1
        self._jobs[self._number] = job = Job(owner, key)
        self._send(("do", self._number, owner, urgency, kind, about))
        return job

    def job_of(self, owner):
        """The newest that is not done, or None."""
        return next((job for job in reversed(self._jobs.values()) if job.owner == owner), None)

    def is_busy(self):
        return bool(self._jobs or self._over)

    def drop(self, owner):
        """Nobody waits for it any more: what has begun goes on to its next stage. True if there was something."""
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
        """The same at once, whatever it does; all others fail. True if there was something."""
        if self.job_of(owner) is None:
            return False
        self.drop(owner)
        self.end()
        return True

    def take(self, seconds=0.0):
        """Jobs that have been done meanwhile, the oldest first; waits so long for the first message."""
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
        """Until it is done; gives back all that are done then, it too."""
        done = []
        while not job.is_done and self.is_busy():
            done += self.take(1.0)
        return done

    def told(self):
        """The same as works.Tools.told(), of the process. Raises engines.EngineError if it does not start."""
        if self._told is None:
            job = self.ask(None, None, "told", {})
            self._over += [other for other in self.wait(job) if other is not job]
            if job.error is not None:
                raise job.error
            self._told = job.result
        return self._told

    def end(self):
        """Ends it and what it started; jobs that are not done fail."""
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
            pass  # it is gone, which take() notices

    def _hear(self, word, number, what):
        job = self._jobs.get(number)
        if job is None:  # nobody waits for it
            return None
        if word == "stage":
            job.stage = what
            return None
        for other in [other for other, older in self._jobs.items() if older.owner == job.owner and other <= number]:
            del self._jobs[other]  # older ones fell away for this one
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
        """How it ended; it has so long to do so, and what it started ends with it."""
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
    """The process at the other end of a connection."""
    words = [python(), "-B", SCRIPT]
    if os.name != "nt":
        return subprocess.Popen([*words, str(connection.fileno())], pass_fds=[connection.fileno()], stdin=subprocess.DEVNULL,
                                start_new_session=True)
    child = subprocess.Popen(words, stdin=subprocess.PIPE, creationflags=subprocess.CREATE_NO_WINDOW)
    with child.stdin:  # Windows hands a socket to a process that is there already
        child.stdin.write(connection.share(child.pid))
    return child


def _kill(child):
    """With what it started; on Windows, where it starts nothing, alone."""
    if os.name == "nt":
        child.kill()
        return
    try:
        os.killpg(child.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def python():
    """The interpreter that belongs to this one: Blender's own says where it lies, and outside of Windows names another of the path
    at times."""
    names = () if os.name == "nt" else (f"python{sys.version_info.major}.{sys.version_info.minor}", "python3")
    places = [*(os.path.join(sys.prefix, "bin", name) for name in names), sys.executable]
    return next((place for place in places if os.path.exists(place)), sys.executable)
