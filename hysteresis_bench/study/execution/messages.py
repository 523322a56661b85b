"""Messages between processes over a socket: eight bytes of length, then a pickle."""

from __future__ import annotations

import pickle
import socket
import struct
from typing import Any

LENGTH = struct.Struct("!Q")
LARGEST = 1 << 31
"""Bytes beyond which a length is no length: somebody else has written into the socket."""


class Unreadable(Exception):
    """What came was no message."""


def send(to: socket.socket, message: Any) -> None:
    """Raises OSError where nobody is there to read it, and whatever the message raises when it is pickled."""
    content = pickle.dumps(message)
    to.sendall(LENGTH.pack(len(content)) + content)


def receive(source: socket.socket) -> Any:
    """The next message. Waits for it; raises EOFError where there is none to come."""
    (length,) = LENGTH.unpack(_exactly(source, LENGTH.size))
    return pickle.loads(_exactly(source, length))


def _exactly(source: socket.socket, length: int) -> bytes:
    found = bytearray()
    while len(found) < length:
        if not (part := source.recv(length - len(found))):
            raise EOFError
        found += part
    return bytes(found)


class Inbox:
    """What arrives at a socket, without ever waiting for the rest of a message: its writer may hang in the middle.

    closed : nothing more will come
    """

    def __init__(self, source: socket.socket) -> None:
        self._source = source
        self._found = bytearray()
        self.closed = False

    def read(self) -> list[Any]:
        """The messages that are complete by now. Raises Unreadable."""
        try:
            while part := self._source.recv(1 << 20, socket.MSG_DONTWAIT):
                self._found += part
            self.closed = True
        except BlockingIOError:
            pass
        except OSError:
            self.closed = True
        messages = []
        while len(self._found) >= LENGTH.size:
            (length,) = LENGTH.unpack_from(self._found)
            if length > LARGEST:
                raise Unreadable
            end = LENGTH.size + length
            if len(self._found) < end:
                break
            try:
                messages.append(pickle.loads(self._found[LENGTH.size : end]))
            except Exception as error:
                raise Unreadable from error
            del self._found[:end]
        return messages
