"""Tests that every command, scene, shader and script of the guide does what the page says. Each page is a session in a folder."""
import os
import re
import shutil
import stat
import subprocess
import sys
import time

from guide import ROOT, blocks, pages
from program import GOOD, Suite

t = Suite()
# A session has small pictures and few rays, so that it takes seconds. The program refuses an option that is given twice, so these take the place of
# the page's options.
SMALL = {"render": "--format 32x32 --samples 16 --pixel-samples 2x2 -t 2", "hide": "--format 32x32 --pixel-samples 2x2", "gather": "--samples 16",
         "batch": "--format 32x32 --samples 16 --pixel-samples 2x2",
         "photons": "--photons 5000", "chart": "--format 16x16 --budget 30s --batches 2 -t 2"}
# These options choose the number of rays themselves, so none is given beside them.
CHOOSING = {"--target-error": "20%", "--time-budget": "3s"}
SHIM = f"""#!{sys.executable}
import subprocess, sys
small = {SMALL!r}
given = sys.argv[1:]
command = next((a for a in given[:1] if a in small), "render" if given and (given[0].endswith(".rib") or given[0] == "-") else "")
mine = small.get(command, "").split()
for option, value in {CHOOSING!r}.items():
    if option in given:
        given[given.index(option) + 1] = value
        mine = [word for word in mine if word not in ("--samples", "16")]
for option, value in zip(mine[::2], mine[1::2]):
    while option in given:
        at = given.index(option)
        del given[at:at + 2]
code = subprocess.call([{str(t.program)!r}, *given, *mine])
sys.exit(0 if command == "chart" and code == 3 else code)  # so short a budget leaves points out
"""
# These files stand for the reader's own ones.
OWN = {"scene.rib": (ROOT / "scenes/cornell/cornell.rib").read_text(), "model.obj": "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3 4\n"}
# A session cannot do these commands, for the reason given.
LEFT_OUT = {"./dev": "it builds the program", "sudo ": "it changes the machine", "git ": "it needs a network", "--watch": "it never ends", "tomales relight": "likewise"}


def new_folder(name):
    folder = t.folder / name.replace("/", "_")
    folder.mkdir()
    (folder / "bin").mkdir()
    shim = folder / "bin/tomales"
    shim.write_text(SHIM)
    shim.chmod(shim.stat().st_mode | stat.S_IXUSR)
    for part in ("scenes", "docs"):
        shutil.copytree(ROOT / part, folder / part, ignore=shutil.ignore_patterns("measured", "decisions", "images"))
    for name, text in OWN.items():
        (folder / name).write_text(text)
    return folder


def run(block, folder):
    lines = [line for line in block.text.splitlines() if not any(word in line for word in LEFT_OUT)]
    for verb in re.findall(r"^\./dev (\w+)", block.text, re.M):
        t.expect(f"verb_{verb}()" in (ROOT / "dev").read_text(), f"{block.place}: ./dev {verb} exists")
    script = "\n".join(lines); script = re.sub(r"\bPREFIX\b", str(prefix), script)
    environment = {**os.environ, "PATH": f"{folder / 'bin'}:/usr/bin:{os.environ['PATH']}", "TOMALES": str(folder / "bin/tomales"),
                   "PYTHONPATH": str(ROOT / "reyes/bindings/python"), "TOMALES_RENDER_OPTIONS": "--format 32x32 --samples 16",
                   "TOMALES_TEXTURE_CACHE": str(t.folder / "textures"), "XDG_CACHE_HOME": str(t.folder / "cache")}
    began = time.monotonic()
    result = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, env=environment, capture_output=True, text=True, errors="replace", timeout=300)
    t.expect(result.returncode == 0, f"{block.place}: its commands end well ({time.monotonic() - began:.0f} s)")
    if result.returncode != 0:
        print(f"        exit {result.returncode}\n        {script[:300]}\n        {result.stderr[-700:]}")


def parse(block, folder):
    (folder / "fragment.rib").write_text(block.text)
    result = subprocess.run([t.program, "catrib", "fragment.rib"], cwd=folder, capture_output=True, text=True)
    t.expect(result.returncode == 0 and ": warning" not in result.stderr, f"{block.place}: its requests are RIB" + result.stderr[:300])


prefix = t.folder / "prefix"  # Only readers who write plugins need the installation.
subprocess.run(["cmake", "--install", t.program.parent, "--prefix", prefix, "--component", "dev"], check=True, stdout=subprocess.DEVNULL)

only = sys.argv[3:]  # Whoever writes a page may name it, such as docs/light.md.
for page in [page for page in pages() if not only or page in only]:
    folder = new_folder(page)
    for block in blocks(page):
        if block.file:
            (folder / block.file).write_text(block.text)
        elif block.language == "sh":
            run(block, folder)
        elif block.language == "rib":
            parse(block, folder)
        elif block.language in ("sl", "python"):
            t.expect(False, f"{block.place}: a comment in its first line names the file")
        else:
            t.expect(not re.search(r"^ *(tomales|g\+\+|python3|\./dev) ", block.text, re.M), f"{block.place}: commands stand in blocks of sh")
    shutil.rmtree(folder)

# These are the options and commands that pages name in running text.
helps = {command: t.run(command, "--help-all").stdout for command in re.findall(r"^  (\w+) +[A-Z]", t.run("--help").stdout.split("Subcommands:")[1], re.M)}
known = set(re.findall(r"--[a-z][a-z-]*", "".join(helps.values()) + t.run("--help").stdout))
others = {"--preset", "--build", "--test-dir", "--all"}  # These belong to cmake, to ctest and to scripts of the tree.
for page in pages():
    quoted = " ".join(re.findall(r"`([^`\n]+)`", (ROOT / page).read_text()))
    t.expect(not (unknown := set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", quoted)) - known - others), f"{page}: its options exist {unknown or ''}")
    commands = {word for word in re.findall(r"`tomales ([a-z]+)(?=[ `])", (ROOT / page).read_text())}
    t.expect(commands <= set(helps), f"{page}: its commands exist {commands - set(helps) or ''}")
t.finish()
