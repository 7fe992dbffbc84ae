"""Tests --progress on a terminal: it says what is being done, and it moves also during long steps."""
import os
import pty
import re
import select
import subprocess
import time

from program import GOOD, Suite

t = Suite()


def shown_until(master, process, wanted, seconds=60):
    """Returns what the terminal shows, up to the wanted text."""
    text, end = "", time.time() + seconds
    while time.time() < end and not re.search(wanted, text):
        if select.select([master], [], [], .1)[0]:
            try:
                text += os.read(master, 4096).decode()
            except OSError:  # The other side is closed.
                break
        elif process.poll() is not None:
            break
    return text


def start(*line, stdin=subprocess.DEVNULL):
    master, slave = pty.openpty()
    process = subprocess.Popen([t.program, *line, "--progress", "-t", "1"], cwd=t.folder, stdout=slave, stderr=subprocess.DEVNULL, stdin=stdin)
    os.close(slave)
    return master, process


# The scene comes slowly.
reader, writer = os.pipe()
master, process = start("-", stdin=reader)
os.write(writer, GOOD[:60].encode())
shown = shown_until(master, process, "reading 0:02")
t.expect("reading 0:01" in shown and "reading 0:02" in shown, f"reading: {shown!r}")
os.write(writer, GOOD[60:].encode())
os.close(writer)
shown = shown_until(master, process, "100%")
t.expect("100%" in shown and process.wait(timeout=60) == 0, "and goes on to the end")

# Procedurals that rays may meet are opened before anything is hidden.
t.write("program.sh", "#!/bin/sh\nread line\nsleep 3\necho 'Sphere 1 -1 1 360'\nprintf '\\377'\n")
os.chmod(t.folder / "program.sh", 0o755)
slow = 'Attribute "visibility" "transmission" 1\nProcedural "RunProgram" ["./program.sh" "1"] [-1 1 -1 1 -1 1]'
shadows = 'Attribute "light" "shadows" "on"\nLightSource "distantlight" 1'
t.write("procedural.rib", GOOD.replace("Sphere 1 -1 1 360", slow).replace('LightSource "distantlight" 1', shadows))
master, process = start("procedural.rib", "-o", "procedural.exr", "--allow-system")
shown = shown_until(master, process, "100%")
seconds = set(re.findall(r"opening procedurals 0:0(\d)", shown))  # A busy machine may skip some.
t.expect(len(seconds) >= 2, f"procedurals: {shown!r}")
t.expect(process.wait(timeout=60) == 0, "and goes on to the end")

# The shares of a frame need no clock.
t.write("good.rib", GOOD)
master, process = start("good.rib", "-o", "good.exr", "--format", "300x300")
shown = shown_until(master, process, "100%")
t.expect(re.search(r"\[#+ *\] +\d+%  \d+:\d\d left  hiding and shading \d+ % \d+:\d\d", shown), "what is done stands beside the bar")
process.wait(timeout=60)

t.finish()
