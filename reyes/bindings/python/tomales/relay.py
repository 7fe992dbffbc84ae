"""The program that the renderer starts for a procedural that is a Python function: `python3 relay.py SOCKET`.

It speaks RunProgram's protocol (RISpec 3.2, section 5.10) with the renderer, and asks the script that described the
scene, which waits at the other end of the socket: a line of detail and data there, eight bytes of length and as many
bytes back. They are RIB and the protocol's closing byte 0377, without which the script has failed: then this program
fails too. It is run as a file, so that it need not find the package.
"""
from __future__ import annotations

import socket
import sys


def main(path: str) -> None:
    with socket.socket(socket.AF_UNIX) as script:
        script.connect(path)
        answers = script.makefile("rb")
        for line in sys.stdin.buffer:
            script.sendall(line)
            answer = answers.read(int.from_bytes(answers.read(8), "big"))
            sys.stdout.buffer.write(answer)
            sys.stdout.buffer.flush()
            if not answer.endswith(b"\xff"):
                sys.exit(1)


if __name__ == "__main__":
    main(sys.argv[1])
