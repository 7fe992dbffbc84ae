"""Error of indirect light against CPU seconds, ours beside POV-Ray's radiosity and Cycles' path tracing, on the same rooms.

    tests/bench/peers.py build/release/tomales [--size 256] [--rooms cornell interior] [--programs tomales povray cycles] [--json out.json]

Debian's packages: povray blender time python3-numpy python3-openimageio. One thread each. Seconds: user and system time above the same program's
render of direct light alone (of Cycles, which has no use for direct light alone: above its start). Error: mean |test - truth| / (truth + 1 % of the mean) of the indirect light, over the pixels that see one shape;
the truth is ours of many samples, and how far the other programs' own best is from it is printed first, a check on the physics.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO

sys.path.insert(0, str(pathlib.Path(__file__).parent / "peers"))
import programs  # noqa: E402
import rooms  # noqa: E402

POV_SETTINGS = [(40, 0.6, 5), (100, 0.4, 6), (250, 0.25, 8)]  # count, error_bound, nearest_count


def run(command, cwd):
    """CPU seconds and peak MB."""
    usage = cwd / "usage.txt"
    done = subprocess.run(["/usr/bin/time", "-q", "-f", "%U %S %M", "-o", usage, *command], cwd=cwd, stdin=subprocess.DEVNULL, capture_output=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr.decode(errors='replace')[-2000:]}")
    user, system, kB = map(float, usage.read_text().split())
    return user + system, kB / 1024


def read(path, prefix=""):
    file = OpenImageIO.ImageInput.open(str(path))  # an ImageBuf would remember what an earlier file of this name held
    names = list(file.spec().channelnames)
    return file.read_image(OpenImageIO.FLOAT)[..., [names.index(prefix + c) for c in "RGB"]]


class Bench:
    def __init__(self, tomales, room, size, folder):
        self.tomales, self.room, self.size, self.folder = tomales, room, size, folder
        self.mask = room.mask(size)
        (folder / "room.rib").write_text(programs.rib(room, size))

    def ours(self, *options):
        cpu, memory = run([self.tomales, "render", "room.rib", "-t", "1", "-o", "out.exr", *map(str, options)], self.folder)
        return read(self.folder / "out.exr"), cpu, memory

    def povray(self, radiosity, lamps=6):
        (self.folder / "room.pov").write_text(programs.povray(self.room, radiosity, lamps))
        cpu, memory = run(["povray", "+Iroom.pov", "+Oout_pov.exr", "+FE", f"+W{self.size}", f"+H{self.size}", "-A", "+WT1", "-D", "File_Gamma=1"], self.folder)
        return read(self.folder / "out_pov.exr"), cpu, memory

    def cycles(self, samples, bounces):
        (self.folder / "room.py").write_text(programs.cycles(self.room, self.size, samples, bounces, str(self.folder / "out_cycles.exr")))
        cpu, memory = run(["blender", "-b", "--factory-startup", "-P", str(self.folder / "room.py")], self.folder)
        parts = {k: read(self.folder / "out_cycles.exr", f"ViewLayer.{k}.") for k in ("DiffDir", "DiffInd", "DiffCol")}
        return parts["DiffDir"] * parts["DiffCol"], parts["DiffInd"] * parts["DiffCol"], cpu, memory

    def error(self, test, truth):
        test, truth = test[self.mask], truth[self.mask]
        return float(numpy.mean(numpy.abs(test - truth) / (truth + 0.01 * truth.mean())))

    def bias(self, test, truth):
        return float(test[self.mask].mean() / truth[self.mask].mean() - 1)


def radiosity(count, error_bound, nearest, bounces):
    return (f"count {count} error_bound {error_bound} nearest_count {nearest} recursion_limit {bounces} gray_threshold 0 normal off low_error_factor 0.5 "
            "pretrace_start 0.08 pretrace_end 0.005 always_sample off brightness 1")


def measure(bench, bounces, who, truth_samples):
    rows = []
    reference = ["--gi", "reference", "--bounces", bounces]
    truth = bench.ours(*reference, "--samples", truth_samples, "--indirect-only", "--seed", 7)[0]

    def add(program, setting, indirect, cpu, memory):
        rows.append({"room": bench.room.name, "bounces": bounces, "program": program, "setting": setting, "error": bench.error(indirect, truth),
                     "bias": bench.bias(indirect, truth), "cpu_s": cpu, "memory_MB": memory})
        r = rows[-1]
        print(f"| {r['room']} | {bounces} | {program} | {setting} | {100 * r['error']:.2f} % | {100 * r['bias']:+.2f} % | {cpu:.2f} | {memory:.0f} |", flush=True)

    if "tomales" in who:
        _, direct_cpu, _ = bench.ours("--gi", "none")

        def ours(name, *options):
            image = bench.ours(*options, "--indirect-only")[0]
            _, cpu, memory = bench.ours(*options)
            add(f"tomales {name}", " ".join(map(str, options[2:])), image, cpu - direct_cpu, memory)

        for samples in (16, 64, 256):
            ours("reference", *reference, "--samples", samples)
        for max_error, samples in ((2, 150), (1, 300), (0.5, 600), (0.25, 1200)):
            if bounces == 1:
                ours("gather", "--gi", "gather", "--samples", samples, "--max-error", max_error)
            else:
                ours("atlas", "--gi", "atlas", "--samples", samples, "--max-error", max_error, "--photons", samples * 2000)
    if "povray" in who:
        direct, direct_cpu, _ = bench.povray(None)
        for setting in POV_SETTINGS:
            image, cpu, memory = bench.povray(radiosity(*setting, min(bounces, 20)))
            add("POV-Ray radiosity", "count {} error_bound {} nearest_count {}".format(*setting), image - direct, cpu - direct_cpu, memory)
    if "cycles" in who:
        start_cpu = bench.cycles(1, 0)[2]
        for samples in (16, 64, 256):
            _, indirect, cpu, memory = bench.cycles(samples, bounces)
            add("Cycles", f"{samples} samples", indirect, cpu - start_cpu, memory)
    return rows


def agreement(bench, bounces, samples):
    """Means of direct and indirect light, all at their best."""
    direct = bench.ours("--gi", "none")[0]
    indirect = bench.ours("--gi", "reference", "--bounces", bounces, "--samples", samples, "--indirect-only")[0]
    c_direct, c_indirect, _, _ = bench.cycles(samples, bounces)
    p_direct = bench.povray(None, lamps=16)[0]
    for name, test, truth in (("Cycles, direct", c_direct, direct), ("Cycles, indirect", c_indirect, indirect), ("POV-Ray, direct", p_direct, direct)):
        print(f"{bench.room.name}, {bounces} bounces: {name}: mean {100 * bench.bias(test, truth):+.3f} %, mean absolute relative difference {100 * bench.error(test, truth):.2f} %",
              flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tomales", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--rooms", nargs="+", default=["cornell", "interior"])
    parser.add_argument("--programs", nargs="+", default=["tomales", "povray", "cycles"])
    parser.add_argument("--bounces", nargs="+", type=int, default=[1, 12])
    parser.add_argument("--truth", type=int, default=2048, help="samples of our reference")
    parser.add_argument("--json", type=pathlib.Path)
    given = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in given.rooms:
            bench = Bench(given.tomales.resolve(), getattr(rooms, name)(), given.size, pathlib.Path(folder))
            for bounces in given.bounces:
                if {"povray", "cycles"} <= set(given.programs):
                    agreement(bench, bounces, given.truth)
                print("| room | bounces | program | setting | error | bias | CPU s above direct | MB |\n|---|---|---|---|---|---|---|---|")
                rows += measure(bench, bounces, given.programs, given.truth)
    if given.json:
        given.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
