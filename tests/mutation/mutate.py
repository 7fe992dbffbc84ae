"""Mutation testing: this puts one-line faults into a unit's sources, and lists those that its tests do not notice.

    mutate.py UNIT [--faults N] [--seed N] [--build build/release] [--jobs 2]
    mutate.py UNIT --at FILE:LINE --as 'the line with the fault'

The build folder must have the unit's test programs. tests/README.md says what the figures mean."""
import argparse
import concurrent.futures
import fnmatch
import itertools
import json
import pathlib
import re
import resource
import subprocess
import threading
from dataclasses import dataclass, field

import faults
import programs

ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclass
class Owner:
    """The tests of a unit."""
    library: str  # The library tomales_<library> has the unit's objects.
    files: str    # These sources are given faults.
    program: str  # These are the unit tests.
    only: str = "*"                # These patterns of GoogleTest choose the tests that can notice a fault.
    slow: str = ""                 # These tests run after all others.
    pictures: list = field(default_factory=list)  # The faults that survive are tried with these tests of ctest.


# The headers of rib, prim and shade hold declarations, and a fault in one costs a compilation of all files that include it.
UNITS = {
    "rib": Owner("rib", "reyes/rib/*.cpp", "test_rib",
                 slow="ZipMember.OfAZip*:RunProgram.That*:Interning.Many*:ByteStream.StopsAt*:Writer.*:Number.*:Objects.That*:SearchPath.That*"),
    "prim": Owner("prim", "reyes/prim/*.cpp", "test_prim"),
    "shade": Owner("shade", "reyes/shade/*.cpp", "test_shade", slow="Sl.TheExamples*:Plugins.*"),
    "cache": Owner("gi", "gi/cache/**/*.*", "test_gi", only="*Cache*:RecordCells.*:SharesOfARecord.*:Records.*:BrightSpots.*:SpotAim.*", slow="Gather.*"),
}


def equivalents():
    """Returns the rows of equivalent.txt: file, pattern of the line, pattern of the fault, and why nothing can notice it."""
    rows = (ROOT / "tests/mutation/equivalent.txt").read_text().splitlines()
    return [[part.strip() for part in row.split(" | ")] for row in rows if row.strip() and not row.startswith("#")]


def reason_of(fault, rows):
    for path, old, new, reason in rows:
        if fnmatch.fnmatchcase(fault.path, path) and fnmatch.fnmatchcase(fault.old.strip(), old) and fnmatch.fnmatchcase(fault.new.strip(), new):
            return reason
    return None


def children_s():
    """Returns the CPU time of all programs that have run."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Bench:
    """Tries faults in a unit."""

    def __init__(self, owner, build, jobs):
        self.owner, self.build = owner, build
        wanted = [owner.program] + (["tomales"] if owner.pictures else [])
        subprocess.run(["ninja", "-C", str(build), *wanted], check=True, stdout=subprocess.DEVNULL)
        self.unit = programs.Unit(ROOT, build, owner.library, jobs)
        self.local = threading.local()
        self.folders = itertools.count()
        objects = [self.unit.object_of(source) for source in self.unit.sources]
        self.limit_s = {}
        # `a:b-c:d` means a and b without c and d.
        self.stages = [f"{owner.only}-{owner.slow}" if owner.slow else owner.only] + ([owner.slow] if owner.slow else [])
        if not self.unit.linked(owner.program, objects, self._folder()):
            raise SystemExit(f"{owner.program} cannot be linked")
        for stage in self.stages:
            start = children_s()
            if failed := self._failing(stage, 600):
                raise SystemExit(f"{owner.program} fails without a fault: {failed}")
            self.limit_s[stage] = 3 * (children_s() - start) + 10

    def _folder(self):
        if not hasattr(self.local, "folder"):
            self.local.folder = self.unit.folder / str(next(self.folders))
            self.local.folder.mkdir(exist_ok=True)
        return self.local.folder

    def _failing(self, stage, limit_s):
        """Returns the first test of the linked program that fails, or None if all pass."""
        env = {"GTEST_FAIL_FAST": "1", "GTEST_BRIEF": "1", "TOMALES_TEXTURE_CACHE": str(self._folder() / "textures")}
        code, text = programs.run([str(self._folder() / self.owner.program), f"--gtest_filter={stage}"], self.build / "tests", limit_s, env)
        failed = re.search(r"^\[  FAILED  \] (\S+)", text, re.M)
        return None if code == 0 else failed[1] if failed else "time limit" if code is None else f"exit code {code}"

    def tried(self, fault):
        """Returns `no program`, `same program`, `survives`, or the test that found the fault."""
        objects = self.unit.objects_with(fault, self._folder())
        if not objects:
            return "no program" if objects is None else "same program"
        if not self.unit.linked(self.owner.program, objects, self._folder()):
            return "no program"
        for stage in self.stages:
            if failed := self._failing(stage, self.limit_s[stage]):
                return failed
        return self._picture_that_fails(objects) or "survives"

    def _picture_that_fails(self, objects):
        if not self.owner.pictures:
            return None
        program = self.unit.linked("tomales", objects, self._folder())
        listed = json.loads(subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.build, capture_output=True, text=True, check=True).stdout)
        for test in listed["tests"]:
            if test["name"] in self.owner.pictures:
                command = [str(program) if word == str(self.build / "tomales") else word for word in test["command"]]
                if programs.run(command, self._folder(), 300)[0] != 0:
                    return test["name"]
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("unit", choices=UNITS)
    parser.add_argument("--faults", type=int, default=25, help="how many to try")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", default="build/release", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--at", help="FILE:LINE of one fault")
    parser.add_argument("--as", dest="new", help="the line with that fault")
    options = parser.parse_args()
    owner = UNITS[options.unit]
    bench = Bench(owner, (ROOT / options.build).resolve(), options.jobs)
    if options.at:
        path, line = options.at.rsplit(":", 1)
        old = (ROOT / path).read_text().split("\n")[int(line) - 1]
        print(bench.tried(faults.Fault(path, int(line), old, options.new)))
        return
    paths = sorted(str(path.relative_to(ROOT)) for path in ROOT.glob(owner.files) if str(path.relative_to(ROOT)) in bench.unit.sources or path.suffix == ".h")
    rows = equivalents()
    source = faults.drawn(ROOT, paths, options.seed)
    lock = threading.Lock()
    counted, survivors = [], []

    def work():
        while True:
            with lock:
                fault = next(source, None) if len(counted) < options.faults else None
            if fault is None:
                return
            if reason_of(fault, rows):
                continue
            outcome = bench.tried(fault)
            with lock:
                if outcome in ("no program", "same program") or len(counted) == options.faults:
                    continue
                counted.append(fault)
                if outcome == "survives":
                    survivors.append(fault)
                print(f"{len(counted):3} {outcome}: {fault.diff()}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for done in [pool.submit(work) for _ in range(options.jobs)]:
            done.result()
    print(f"\n{len(survivors)} of {len(counted)} faults in {owner.files} survive (seed {options.seed})")
    for fault in survivors:
        print(fault.diff())


if __name__ == "__main__":
    main()
