"""A viewer of the tev protocol, which puts the picture together."""
import socket
import struct
import threading
import time


def text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


class Viewer(threading.Thread):
    """Puts together the parts that arrive."""

    def __init__(self, reads=True):
        super().__init__(daemon=True)
        self.server = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self.server.getsockname()[1]
        self.reads, self.name, self.pixels, self.updates, self.sketches = reads, None, {}, 0, []
        self.start()

    def run(self):
        connection, _ = self.server.accept()
        data = b""
        while self.reads and (part := connection.recv(1 << 16)):
            data += part
            while len(data) >= 4 and len(data) >= (size := struct.unpack_from("<I", data)[0]):
                self.take(data[:size])
                data = data[size:]
        if not self.reads:
            time.sleep(60)

    def take(self, packet):
        kind, (name, at) = packet[4], text(packet, 6)
        if kind == 4:
            self.name = name
            self.width, self.height, self.channels = struct.unpack_from("<3i", packet, at)
            return
        assert kind == 6 and name == self.name
        self.updates += 1
        (channels,), at = struct.unpack_from("<i", packet, at), at + 4
        names = []
        for _ in range(channels):
            one, at = text(packet, at)
            names.append(one)
        assert names == ["R", "G", "B", "A"]
        x, y, width, height = struct.unpack_from("<4i", packet, at)
        offsets = struct.unpack_from(f"<{channels}q", packet, at + 16)
        strides = struct.unpack_from(f"<{channels}q", packet, at + 16 + 8 * channels)
        floats = struct.unpack_from(f"<{width * height * channels}f", packet, at + 16 + 16 * channels)
        for i in range(width * height):
            self.pixels[x + i % width, y + i // width] = tuple(floats[offsets[c] + i * strides[c]] for c in range(channels))
        if height == self.height > 64:  # This is more than the rows of a finished picture that come at once.
            self.sketches.append(dict(self.pixels))
