"""Prints how renders of other people's scenes end: exit codes, messages for each scene, and silent failures.

    tests/bench/public_scenes.py build/release/tomales FOLDER ... [--seconds 20] [--list] [--keep FOLDER] [-- -t 1 ...]

Every RIB file in the folders that has a world is rendered at 160 x 120 in a copy of its folder, from where it lies, as one would
do by hand, and is stopped after the given CPU seconds (exit code "stopped"). Files of the same bytes count once. All folders of a
repository that hold shaders are on the path, in TOMALES_SHADERS, unless that is set. Arguments after -- go to the renderer. --keep
keeps the pictures, as PNG. A message is a line that ends with its code in brackets. Each cause counts once, however often it
came. A failure is silent if the exit code is 0 and there is no message, though no picture was written or every pixel of the first
is black or empty. --list prints a line for each scene.
"""
import argparse
import collections
import gzip
import hashlib
import json
import pathlib
import os
import re
import resource
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile

MESSAGE = re.compile(r"\[([a-z][a-z0-9-]*)\]$")
SIZE = "160x120"


def text_of(file):
    data = file.read_bytes()
    try:
        return gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data
    except (OSError, EOFError):
        return data


def scenes_of(folder):
    """Returns the paths in the folder, one for each content."""
    seen = {}
    for file in sorted(p for p in folder.rglob("*") if p.is_file() and (p.suffix.lower() == ".rib" or p.name.lower().endswith(".rib.gz"))):
        text = text_of(file)
        if b"WorldBegin" in text:
            seen.setdefault(hashlib.sha256(text).hexdigest(), file)
    return sorted(seen.values())


def is_dark(program, picture):
    channels = json.loads(subprocess.run([program, "info", "--json", picture], capture_output=True, text=True, check=True).stdout)["channels"]
    colors = [c["max"] for c in channels if c["name"] in "RGB"]
    return bool(colors) and max(colors) <= 0


def keep(picture, kept):
    kept.parent.mkdir(parents=True, exist_ok=True)
    if picture.exists():
        subprocess.run(["oiiotool", picture, "--ch", "R,G,B", "--colorconvert", "linear", "sRGB", "-o", kept], capture_output=True, check=False)


def render(program, scene, arguments, seconds, scratch, environment):
    picture = scratch / "picture.exr"
    picture.unlink(missing_ok=True)
    command = [program, scene.name, "-o", picture, "--format", SIZE, *arguments]
    done = subprocess.run(command, cwd=scene.parent, capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL, env=environment,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5)))
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return {"code": "stopped", "codes": [], "silent": False}
    codes = [m.group(1) for m in map(MESSAGE.search, done.stderr.splitlines()) if m]
    silent = done.returncode == 0 and not codes and (not picture.exists() or is_dark(program, picture))
    return {"code": done.returncode, "codes": codes, "silent": silent}


def row(name, results):
    codes = collections.Counter(str(r["code"]) for r in results)
    counts = [len(r["codes"]) for r in results]
    others = ", ".join(f"{k}: {v}" for k, v in sorted(codes.items()) if k not in ("0", "2", "3"))
    return (f"| {name} | {len(results)} | {codes['0']} | {codes['3']} | {codes['2']} | {others or 'none'} | {statistics.median(counts):g} | "
            f"{max(counts)} | {sum(r['silent'] for r in results)} |")


def command_line(description, seconds, *options):
    """Returns what the command line gives, and the renderer's arguments, which follow --. An option is its name and keywords of add_argument()."""
    arguments = sys.argv[1:]
    end = arguments.index("--") if "--" in arguments else len(arguments)
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    parser.add_argument("--seconds", type=int, default=seconds)
    for name, keywords in options:
        parser.add_argument(name, **keywords)
    return parser.parse_args(arguments[:end]), arguments[end + 1:]


def main():
    given, rest = command_line(__doc__, 20, ("--keep", {"type": pathlib.Path}), ("--list", {"action": "store_true"}))
    program = given.program.resolve()
    everything, rows, kinds = [], [], collections.Counter()
    for folder in given.folders:
        with tempfile.TemporaryDirectory() as temporary:
            copy = pathlib.Path(temporary) / folder.name
            shutil.copytree(folder, copy, symlinks=True, ignore=shutil.ignore_patterns(".git"))
            results = []
            environment = {"TOMALES_SHADERS": ":".join(sorted({str(file.parent) for file in copy.rglob("*.sl")})), **os.environ}
            for scene in scenes_of(copy):
                results.append(render(program, scene, rest, given.seconds, pathlib.Path(temporary), environment))
                if given.keep:
                    keep(pathlib.Path(temporary) / "picture.exr", given.keep / ("_".join(scene.relative_to(copy.parent).parts) + ".png"))
                kinds.update(set(results[-1]["codes"]))
                if given.list:
                    r = results[-1]
                    print(r["code"], len(r["codes"]), "SILENT" if r["silent"] else "", scene.relative_to(copy), collections.Counter(r["codes"]).most_common(4), flush=True)
        if results:
            rows.append(row(folder.name, results))
            everything += results
    print("| scenes of | scenes | exit 0 | exit 3 | exit 2 | other ends | messages a scene, median | most | silent failures |\n|---|---|---|---|---|---|---|---|---|")
    print("\n".join([*rows, row("all", everything)]))
    print("\nscenes with a message of the code: " + ", ".join(f"{code} {n}" for code, n in kinds.most_common(25)))


if __name__ == "__main__":
    main()
