"""Receives the unfinished picture, which the renderer sends to viewers (`tomales render --preview`,
displays/tev.cpp)."""
from __future__ import annotations

import socket
import struct
import threading

import numpy

_CREATE, _UPDATE = 4, 6  #: The kinds of packets.


class Preview:
    """Listens at a free port of this machine, and reads in a thread of its own."""

    def __init__(self) -> None:
        self._listening = socket.create_server(("127.0.0.1", 0))
        self._place = self._listening.getsockname()
        self._lock = threading.Lock()
        self._picture: numpy.ndarray | None = None
        self._is_new = False
        threading.Thread(target=self._listen, daemon=True).start()

    @property
    def address(self) -> str:
        return f"{self._place[0]}:{self._place[1]}"

    def take(self) -> numpy.ndarray | None:
        """Returns RGBA of shape (height, width, 4) with the top row first, or None if nothing has come since the
        last call."""
        with self._lock:
            if self._picture is None or not self._is_new:
                return None
            self._is_new = False
            return self._picture.copy()

    def close(self) -> None:
        """Stops listening. If no renderer has connected, the thread still waits for one."""
        try:
            socket.create_connection(self._place).close()
        except OSError:
            pass

    def _listen(self) -> None:
        try:
            with self._listening:
                connection = self._listening.accept()[0]
            with connection, connection.makefile("rb") as stream:
                while length := stream.read(4):
                    self._read(stream.read(struct.unpack("<I", length)[0] - 4))
        except (OSError, ValueError, IndexError, struct.error):
            pass  # The renderer has been ended, and only its picture file counts.

    def _read(self, packet: bytes) -> None:
        at = packet.index(b"\0", 2) + 1  # These values follow the kind, a flag and the title.
        if packet[0] == _CREATE:
            width, height = struct.unpack_from("<2i", packet, at)
            with self._lock:
                self._picture = numpy.zeros((height, width, 4), "f4")
        elif packet[0] == _UPDATE and self._picture is not None:
            (channels,) = struct.unpack_from("<i", packet, at)
            at += 4
            for _ in range(channels):
                at = packet.index(b"\0", at) + 1
            x, y, width, height = struct.unpack_from("<4i", packet, at)
            rows = numpy.frombuffer(packet, "<f4", offset=at + 16 + 16 * channels).reshape(height, width, channels)
            with self._lock:
                self._picture[y : y + height, x : x + width] = rows[..., :4]
                self._is_new = True
