"""Runs every script below a folder that imports prman, unchanged but with small pictures, and counts those that end with a picture.

    python3 tests/python/course_scripts.py FOLDER [-j 2] [--only PART] [--keep FOLDER]

The folder is copied, because scripts write files beside themselves. A script that writes a RIB file instead of rendering has its
file rendered. A module that scripts import, and that begins no stream itself, passes if it can be imported. PYTHONPATH finds the
modules that scripts ask for. A program that makes an empty file stands in for oslc, which comes with RenderMan, because the
renderer uses other shaders anyway.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

PICTURES = {".exr", ".tif", ".tiff", ".png"}
FRAMES = 3  # Only this number of RIB files of a script is rendered, because animations write hundreds.
bindings = pathlib.Path(__file__).resolve().parent.parent.parent / "reyes/bindings/python"
sys.path.insert(0, str(bindings))
sys.dont_write_bytecode = True
import tomales  # noqa: E402

options = argparse.ArgumentParser()
options.add_argument("folder", type=pathlib.Path)
options.add_argument("-j", type=int, default=2, help="scripts at the same time")
options.add_argument("--only", default="", help="scripts whose path has this in it")
options.add_argument("--keep", type=pathlib.Path, help="leave the copy here")
options.add_argument("--timeout", type=float, default=180, help="seconds for a script")
given = options.parse_args()

temporary = tempfile.TemporaryDirectory()
copy = given.keep or pathlib.Path(temporary.name, "copy")
shutil.copytree(given.folder, copy, dirs_exist_ok=True)
programs = pathlib.Path(temporary.name, "programs")
programs.mkdir()
(programs / "oslc").write_text('#!/bin/sh\nfor file; do :; done\n: > "${file%.osl}.oso"\n')
(programs / "oslc").chmod(0o755)
small = "-t 1 --draft --format 64x48"
environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(bindings), os.environ.get("PYTHONPATH", "")]), "PATH": os.pathsep.join([str(programs), os.environ["PATH"]]),
               "PYTHONDONTWRITEBYTECODE": "1", "TOMALES_RENDER_OPTIONS": small, "TOMALES": tomales.program.find(), "TOMALES_TEXTURE_CACHE": str(pathlib.Path(temporary.name, "textures"))}


def files_of(folder, endings, since):
    return [f for f in folder.rglob("*") if f.suffix in endings and f.is_file() and f.stat().st_mtime >= since]


def run(script):
    """Returns the kind of end, and the reason for it."""
    text = script.read_text(errors="replace")
    begins = re.search(r"^[^#\n]*\bBegin\(", text, re.M)
    # Each script runs in a copy of its folder's files under its own name, because scripts of one folder write files of the same names.
    since = time.time() - 1
    command = [sys.executable, script.name]
    try:
        done = subprocess.run(command, cwd=script.parent, env=environment, capture_output=True, text=True, errors="replace", timeout=given.timeout, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return "time", f"not done after {given.timeout:g} s"
    lines = done.stderr.strip().splitlines() or [""]
    last = ([line for line in lines if re.match(r"\w+(Error|Exception)\b", line)] or lines)[-1]
    if done.returncode:
        return "script", last
    if not begins:
        return "module", "imports"
    if not files_of(script.parent, PICTURES, since):
        ribs = sorted(files_of(script.parent, {".rib"}, since))
        if ribs and not any(b"WorldBegin" in rib.read_bytes() for rib in ribs):
            return "archive", "writes geometry for other scenes"
        for rib in ribs[:FRAMES]:
            one = subprocess.run([environment["TOMALES"], "render", rib.name, "-o", rib.stem + ".exr", *small.split()], cwd=rib.parent, env=environment, capture_output=True, text=True, errors="replace", timeout=given.timeout)
            done.stderr += one.stderr
    if not files_of(script.parent, PICTURES, since):
        return "none", last or "no picture"
    missing = sorted({re.sub(r"^.*?: missing: ", "", line) for line in done.stderr.splitlines() if ": missing: " in line or ": error: " in line})
    return ("missing", "; ".join(missing)) if missing else ("whole", "")


def all_of(folder):
    """Runs the scripts of one folder one after the other. Returns how each of them ends."""
    ends = []
    for script in sorted(folder.glob("*.py")):
        if given.only in str(script) and "import prman" in script.read_text(errors="replace"):
            kind, reason = run(script)
            print(f"{kind:<8} {script.relative_to(copy)}: {reason[:300]}", flush=True)
            ends.append(kind)
    return ends


folders = sorted({f.parent for f in copy.rglob("*.py")})
with concurrent.futures.ThreadPoolExecutor(given.j) as pool:
    ends = [end for some in pool.map(all_of, folders) for end in some]
counts = {kind: ends.count(kind) for kind in ("whole", "missing", "module", "archive", "script", "time", "none")}
print(f"{len(ends)} scripts import prman: {counts['whole']} rendered whole, {counts['missing']} with something missing, {counts['module']} modules imported, {counts['archive']} archives written; "
      f"{counts['script']} raised, {counts['time']} took too long, {counts['none']} left no picture")
