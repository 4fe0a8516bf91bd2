# SPDX-License-Identifier: GPL-3.0-or-later
"""Exchanges messages of plain values and numpy arrays between two processes over a socket.

It replaces multiprocessing.connection, which makes Blender crash: that module keeps `__main__` of the script that
imports it in sys.modules, Blender 3.4 frees the script's module, and crashes when it walks sys.modules at its end."""

import pickle
import select
import socket
import struct

LENGTH = struct.Struct("<Q")


class Messages:
    """One end of a connection."""

    def __init__(self, end):
        self._socket = end
        self._socket.setblocking(True)

    def send(self, message):
        """Sends a message. Raises OSError if the other end is closed."""
        data = pickle.dumps(message, protocol=pickle.HIGHEST_PROTOCOL)
        self._socket.sendall(LENGTH.pack(len(data)))
        self._socket.sendall(data)

    def receive(self):
        """Waits for the next message and returns it. Raises EOFError or OSError if the other end is closed."""
        (length,) = LENGTH.unpack(self._read(LENGTH.size))
        return pickle.loads(self._read(length))

    def is_there(self, seconds=0.0):
        """Returns True if a message arrives within this time, or if the other end is closed."""
        return bool(select.select([self._socket], [], [], seconds)[0])

    def fileno(self):
        return self._socket.fileno()

    def share(self, process):
        """Returns bytes by which the process with this identifier can open this end, too. It exists on Windows only."""
        return self._socket.share(process)

    def close(self):
        self._socket.close()

    def _read(self, length):
        data = bytearray(length)
        view = memoryview(data)
        while len(view):
            count = self._socket.recv_into(view)
            if not count:
                raise EOFError
            view = view[count:]
        return data


def pair():
    """Returns the two ends of a new connection."""
    return tuple(Messages(end) for end in socket.socketpair())


def of_descriptor(number):
    """Returns the end with a file descriptor that this process inherited."""
    return Messages(socket.socket(fileno=number))


def of_share(data):
    """Returns the end that another process shared by Messages.share() on Windows."""
    return Messages(socket.fromshare(data))
