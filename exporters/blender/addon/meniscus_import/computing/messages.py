# SPDX-License-Identifier: GPL-3.0-or-later
"""Messages between two processes over a socket: plain values and numpy arrays, each whole.

As multiprocessing.connection has them, which Blender cannot do with: that module keeps `__main__` of the script that imports it in
sys.modules, Blender 3.4 frees that script's, and crashes when it looks through sys.modules at its end."""

import pickle
import select
import socket
import struct

LENGTH = struct.Struct("<Q")


class Messages:
    """One end."""

    def __init__(self, end):
        self._socket = end
        self._socket.setblocking(True)

    def send(self, message):
        """Raises OSError if the other end is closed."""
        data = pickle.dumps(message, protocol=pickle.HIGHEST_PROTOCOL)
        self._socket.sendall(LENGTH.pack(len(data)))
        self._socket.sendall(data)

    def receive(self):
        """Waits for the next. Raises EOFError or OSError if the other end is closed."""
        (length,) = LENGTH.unpack(self._read(LENGTH.size))
        return pickle.loads(self._read(length))

    def is_there(self, seconds=0.0):
        """Whether one comes within this time, or the other end is gone."""
        return bool(select.select([self._socket], [], [], seconds)[0])

    def fileno(self):
        return self._socket.fileno()

    def share(self, process):
        """Bytes by which the process with this number has this end, too; only Windows has such."""
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
    """Two ends."""
    return tuple(Messages(end) for end in socket.socketpair())


def of_descriptor(number):
    """The end that was handed to this process."""
    return Messages(socket.socket(fileno=number))


def of_share(data):
    """The same on Windows."""
    return Messages(socket.fromshare(data))
