"""Builds test programs in which one file of a unit has a fault, without building the rest. Everything else comes from a build
folder."""
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import shlex
import signal
import subprocess

MOST_MEMORY = 12 << 30  # This limits the address space in bytes, so that a faulty loop does not take the machine with it.
INCLUDE = re.compile(r'^#include ("([^"]+)"|<[^>]+>)', re.M)


def run(command, cwd, limit_s, env=None):
    """Returns the exit code (None after the time limit) and the output. The limit is one of CPU time, so that slow tests on a
    busy machine do not count as failures. A program that waits has twenty times this limit by the clock."""
    def limits():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (int(limit_s), int(limit_s)))
        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    with subprocess.Popen(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                          start_new_session=True, env={**os.environ, **(env or {})}, preexec_fn=limits) as process:
        try:
            text = process.communicate(timeout=20 * limit_s)[0]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            return None, ""
        return None if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL) else process.returncode, text


class Unit:
    """The objects of a unit's files, each compiled alone, and the way to link its test programs."""

    def __init__(self, root, build, name, jobs):
        self.root, self.build, self.library = root, build, f"libtomales_{name}.a"
        self.folder = build.parent / "mutation" / name
        self.folder.mkdir(parents=True, exist_ok=True)
        self.sources, self.flags = self._read_commands(f"CMakeFiles/tomales_{name}.dir/")
        self._compile_prefix()
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for source, done in zip(self.sources, pool.map(self._compile_once, self.sources)):
                if not done:
                    raise SystemExit(f"{source} does not compile")

    def _read_commands(self, target):
        sources, flags = [], None
        for entry in json.loads((self.build / "compile_commands.json").read_text()):
            if target not in entry["command"]:
                continue
            words = shlex.split(entry["command"])
            flags = words[:words.index("-o")]
            file = pathlib.Path(entry["file"])
            text = file.read_text()
            sources += re.findall(r'#include "(/[^"]+)"', text) if "/Unity/" in str(file) else [str(file)]
        flags = [flag for flag in flags if not re.match(r"-(O\d|W)", flag)] + ["-O1", "-w"]
        return [os.path.relpath(source, self.root) for source in sources], flags

    def _compile_prefix(self):
        """Compiles the headers of other units that this one includes once, because reading them takes most of a file's time. The unit's own headers
        are left out, because some cannot be included together."""
        own_folders = {str(pathlib.Path(source).parent) for source in self.sources}
        found = set()
        for source in self.sources:
            for text, own in INCLUDE.findall((self.root / source).read_text()):
                if not own or (str(pathlib.Path(own).parent) not in own_folders and (self.root / own).is_file()
                               and "#pragma once" in (self.root / own).read_text()):
                    found.add(text)
        self.prefix = self.folder / "prefix.h"
        text = "".join(f"#include {text}\n" for text in sorted(found))
        if not self.prefix.exists() or self.prefix.read_text() != text:
            self.prefix.write_text(text)
        if not self._is_new(f"{self.prefix}.gch", [self.prefix, *(file for top in ("reyes", "raytrace", "gi", "shaders") for file in (self.root / top).rglob("*.h"))]):
            subprocess.run([*self.flags, "-x", "c++-header", str(self.prefix), "-o", f"{self.prefix}.gch"], check=True)

    @staticmethod
    def _is_new(file, sources):
        file = pathlib.Path(file)
        return file.exists() and all(source.stat().st_mtime < file.stat().st_mtime for source in map(pathlib.Path, sources))

    def object_of(self, source):
        return self.folder / (source.replace("/", "+") + ".o")

    def _compile_once(self, source):
        file, out = self.root / source, self.object_of(source)
        return self._is_new(out, [file, f"{self.prefix}.gch"]) or self.compiled(file, out)

    def compiled(self, file, out, overlay=None):
        """Compiles a file after the prefix, or with a folder whose headers shadow those of the project. Returns whether it compiles."""
        first = [f"-I{overlay}"] if overlay else ["-include", str(self.prefix)]
        return subprocess.run([self.flags[0], *first, *self.flags[1:], "-c", str(file), "-o", str(out)], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0

    def users_of(self, header):
        """Returns the sources of the unit that include the header, also by way of other headers."""
        known = {}

        def uses(path):
            if path not in known:
                known[path] = False
                own = [name for _, name in INCLUDE.findall((self.root / path).read_text()) if name and (self.root / name).is_file()]
                known[path] = header in own or any([uses(name) for name in own])
            return known[path]
        return [source for source in self.sources if uses(source)]

    def objects_with(self, fault, folder):
        """Returns the unit's objects with that fault: None if it does not compile, [] if no object differs."""
        overlay = folder / "overlay"
        file = overlay / fault.path
        file.parent.mkdir(parents=True, exist_ok=True)
        lines = (self.root / fault.path).read_text().split("\n")
        lines[fault.line - 1] = fault.new
        file.write_text("\n".join(lines))
        changed = {}
        header = not fault.path.endswith(".cpp")
        for source in self.users_of(fault.path) if header else [fault.path]:
            out = folder / self.object_of(source).name
            if not self.compiled(self.root / source if header else file, out, overlay if header else None):
                file.unlink()
                return None
            if out.read_bytes() != self.object_of(source).read_bytes():
                changed[source] = out
        file.unlink()
        # The objects with the fault come first, because a linker takes the first copy of a template or inline function.
        return changed and [*changed.values(), *(self.object_of(source) for source in self.sources if source not in changed)]

    def linked(self, program, objects, folder):
        """Links the program with these objects instead of the unit's library. Returns the program, or None if that fails, as
        when a fault changes the type of a function that other files call."""
        command = subprocess.run(["ninja", "-C", str(self.build), "-t", "commands", "-s", program], capture_output=True, text=True, check=True).stdout
        command = next(part for part in command.split("&&") if f" -o {program} " in part)
        words = shlex.split(command)
        words = [word for word in words if word != self.library]
        words[words.index("-o") + 1] = str(folder / program)
        words[1:1] = map(str, objects)
        if subprocess.run(words, cwd=self.build, stderr=subprocess.DEVNULL).returncode != 0:
            return None
        for beside in [*self.build.glob("tomales_*"), *self.build.glob("*.so")]:  # The program looks for these in its own folder.
            if not (folder / beside.name).exists():
                (folder / beside.name).symlink_to(beside)
        return folder / program
