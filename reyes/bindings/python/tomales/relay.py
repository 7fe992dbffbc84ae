"""The program that the renderer starts for a procedural that is a Python function: `python3 relay.py SOCKET`.

It speaks RunProgram's protocol (RISpec 3.2, section 5.10) with the renderer. For each question it asks the script that
described the scene, which waits at the other end of the socket. It sends a line of detail and data, and receives eight
bytes of length and as many bytes of answer. The answer is RIB and the protocol's closing byte 0377. If that byte is
missing, the script has failed, and this program fails too. Python runs it as a file, so it need not find the package.
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
