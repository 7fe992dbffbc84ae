"""Tests that photons, irradiance and brickmake, which make folders of several files, leave nothing that could be taken for a
whole folder when they are killed."""
import os
import signal
import subprocess
import time

from program import Suite

t = Suite()
MAPS = 12
t.write("room.rib", """Format 16 16 1
Projection "perspective" "fov" [60]
WorldBegin
LightSource "indirectlight" 1
LightSource "pointlight" 2 "from" [0 0 0] "intensity" [2]
Sides 2
Surface "matte"
""" + "".join(f'Attribute "photon" "string globalmap" "map{k}"\nPolygon "P" [{k - 6} -1 3 {k - 5} -1 3 {k - 5} 1 3 {k - 6} 1 3]\n' for k in range(MAPS)) + "WorldEnd\n")
photons = ["photons", "room.rib", "-o", "photons", "--photons", "20000"]
irradiance = ["irradiance", "photons", "-o", "irradiance"]
bricks = ["brickmake", "irradiance", "-o", "bricks"]
lit = ["room.rib", "--gi", "atlas", "--atlas", "bricks", "-o", "lit.exr"]


def files(folder):
    return sorted(p.name for p in (t.folder / folder).glob("*") if not p.name.startswith("."))


def killed(arguments, folder, count):
    """Kills the command as soon as the folder has this number of files. Returns False if the folder was whole before."""
    process = subprocess.Popen([t.program, *arguments], cwd=t.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None and len(files(folder)) < count:
        time.sleep(0.0005)
    process.send_signal(signal.SIGKILL)
    process.wait()
    return process.returncode == -signal.SIGKILL and "unfinished" in files(folder)


def expect_not_taken(what, command, folder, count, reader, code):
    """Tests that a reader refuses what a killed command leaves, and that the command, run again, makes the folder whole."""
    for _ in range(20):
        if killed(command, folder, count):
            break
        for name in files(folder):
            os.remove(t.folder / folder / name)
    else:
        return t.expect(False, f"{what}: was never caught before its end")
    t.expect_run(f"{what} killed with {len(files(folder))} files: its folder is not taken for whole", reader, code, folder, "is not whole")
    t.expect_run(f"{what} again", command, 0)
    t.expect("unfinished" not in files(folder), f"{what}: the mark is gone")
    t.expect_run(f"{what}: the folder is taken", reader, 0)


expect_not_taken("photons", photons, "photons", 2, irradiance, 2)
expect_not_taken("irradiance", irradiance, "irradiance", 2, bricks, 2)
expect_not_taken("brickmake", bricks, "bricks", 2, lit, 3)
t.write("photons/unfinished", "")
t.expect_run("points with irradiance of a folder that is not whole", ["room.rib", "--gi", "points", "--atlas", "photons", "-o", "lit.exr"], 3, "is not whole")
t.finish()
