"""Compares the error of indirect light against CPU seconds of this renderer, of POV-Ray's radiosity and of Cycles' path tracing, on the same rooms.

    tests/bench/peers.py build/release/tomales [--size 512] [--rooms cornell interior] [--programs tomales povray cycles] [--json out.json]

It needs Debian's packages povray blender time python3-numpy python3-openimageio. Each program has one thread. Seconds are user
and system time above the same program's render of direct light alone (for Cycles, which has no use for that, above its start).
The error is the mean of |test - truth| / (truth + 1 % of the mean) of the indirect light, over the pixels that see one shape, in
windows of 16 x 16 pixels. The truth is our picture with many paths, in two halves from which its noise is estimated. That noise
is subtracted from every squared error, because squares of independent noises add up. If a program whose only error is noise was
not rendered long enough, the seconds to an error are extrapolated along its last two points and marked ~.

With --agreement, the differences between the programs are printed first, as a check on the physics. These are the difference of
the means and its standard error, and the root mean square difference of blocks of 16 x 16 pixels beside the share of noise in it.
The latter shows differences at single places.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO

sys.path.insert(0, str(pathlib.Path(__file__).parent / "peers"))
import programs  # noqa: E402
import rooms  # noqa: E402

POV_SETTINGS = [(40, 0.6, 5), (100, 0.4, 6), (250, 0.25, 8), (500, 0.2, 12)]  # The columns are count, error_bound and nearest_count.
OUR_STEPS = [(100, 3, 30000), (200, 2, 100000), (400, 1.4, 300000), (800, 1, 600000)]  # The columns are samples, maxerror and photons.
WINDOW, WINDOWS_A_SIDE = 16, 5
ASKED_ERROR = 0.02


def run(command, cwd):
    """Returns CPU seconds and peak MB."""
    usage = cwd / "usage.txt"
    done = subprocess.run(["/usr/bin/time", "-q", "-f", "%U %S %M", "-o", usage, *command], cwd=cwd, stdin=subprocess.DEVNULL, capture_output=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr.decode(errors='replace')[-2000:]}")
    user, system, kB = map(float, usage.read_text().split())
    return user + system, kB / 1024


def read(path, prefix=""):
    file = OpenImageIO.ImageInput.open(str(path))  # An ImageBuf would remember the contents of an earlier file of this name.
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

    def corners(self):
        """Returns the upper left pixels of the windows. One lies in the middle of each cell of a lattice."""
        step = self.size / WINDOWS_A_SIDE
        return [(round((i + 0.5) * step - WINDOW / 2), round((j + 0.5) * step - WINDOW / 2)) for j in range(WINDOWS_A_SIDE) for i in range(WINDOWS_A_SIDE)]

    def in_windows(self, image):
        return numpy.concatenate([image[y:y + WINDOW, x:x + WINDOW][self.mask[y:y + WINDOW, x:x + WINDOW]] for x, y in self.corners()])

    def truth(self, bounces, paths):
        """Returns indirect light in the windows, and its noise."""
        halves = []
        for seed in (71, 72):
            image = numpy.zeros((self.size, self.size, 3), numpy.float32)
            for x, y in self.corners():
                crop = ",".join(f"{v / self.size:.9g}" for v in (x, x + WINDOW, y, y + WINDOW))
                part = self.ours("--gi", "reference", "--bounces", bounces, "--samples", paths // 2, "--indirect-only", "--light-seed", seed, "--crop", crop)[0]
                image[y:y + WINDOW, x:x + WINDOW] = part
            halves.append(self.in_windows(image))
        mean = (halves[0] + halves[1]) / 2
        return mean, relative(halves[0] - halves[1], mean) / 2

    def error(self, test, truth):
        """Returns the error with the truth's noise subtracted."""
        mean, noise = truth
        return math.sqrt(max(relative(self.in_windows(test) - mean, mean)**2 - noise**2, 0))

    def bias(self, test, truth):
        return float(self.in_windows(test).mean() / truth[0].mean() - 1)

    def difference(self, test, truth):
        """Returns the difference of the means, its standard error, the rms of blocks, and the noise in that. All are relative to the mean."""
        scale = truth[self.mask].mean()
        d = numpy.where(self.mask[..., None], test - truth, numpy.nan).mean(-1) / scale
        blocks = [d[y:y + WINDOW, x:x + WINDOW] for y in range(0, self.size, WINDOW) for x in range(0, self.size, WINDOW)]
        blocks = [b[~numpy.isnan(b)] for b in blocks]
        blocks = [b for b in blocks if b.size > WINDOW * WINDOW // 2]
        # Neighbouring pixels have the same light except for noise, so half of the square of their difference is the variance.
        variance = numpy.nanmean((d[:, 1:] - d[:, :-1])**2) / 2
        counts = numpy.array([b.size for b in blocks])
        return (float(numpy.nanmean(d)), math.sqrt(variance / self.mask.sum()), math.sqrt(numpy.mean([b.mean()**2 for b in blocks])), math.sqrt(numpy.mean(variance / counts)))


def relative(difference, truth):
    return float(numpy.mean(numpy.abs(difference) / (truth + 0.01 * truth.mean())))


def radiosity(count, error_bound, nearest, bounces):
    """Returns settings. Rays of level n have the weight 2^-n whatever they meet, so the default of adc_bailout, 0.01, would end
    at 6 bounces."""
    return (f"count {count} error_bound {error_bound} nearest_count {nearest} recursion_limit {bounces} gray_threshold 0 normal off low_error_factor 0.5 "
            "pretrace_start 0.08 pretrace_end 0.005 always_sample off brightness 1 adc_bailout 0.0001")


def measure(bench, bounces, who, truth_paths, paths, pov_settings):
    rows = []
    truth = bench.truth(bounces, truth_paths)
    print(f"\n{bench.room.name}, {bounces} bounces; the truth's own noise: {100 * truth[1]:.2f} %\n\n"
          "| room | bounces | program | setting | error | bias | CPU s above direct | MB |\n|---|---|---|---|---|---|---|---|")

    def add(program, setting, indirect, cpu, memory):
        rows.append({"room": bench.room.name, "bounces": bounces, "program": program, "setting": setting, "error": bench.error(indirect, truth),
                     "bias": bench.bias(indirect, truth), "cpu_s": cpu, "memory_MB": memory})
        r = rows[-1]
        print(f"| {r['room']} | {bounces} | {program} | {setting} | {100 * r['error']:.2f} % | {100 * r['bias']:+.2f} % | {cpu:.2f} | {memory:.0f} |", flush=True)

    if "tomales" in who:
        direct, direct_cpu, _ = bench.ours("--gi", "none")

        def ours(name, setting, *options):
            image, cpu, memory = bench.ours("--bounces", bounces, *options)
            add(f"tomales {name}", setting, image - direct, cpu - direct_cpu, memory)

        for samples in paths:
            ours("reference", f"{samples} paths", "--gi", "reference", "--samples", samples)
        for samples, max_error, photons in OUR_STEPS:
            ours("gather", f"`--samples {samples} --max-error {max_error}`", "--gi", "gather", "--samples", samples, "--max-error", max_error)
            if bounces > 1:
                ours("atlas", f"the same, `--photons {photons}`", "--gi", "atlas", "--samples", samples, "--max-error", max_error, "--photons", photons)
    if "povray" in who:
        direct, direct_cpu, _ = bench.povray(None)
        for setting in POV_SETTINGS[:pov_settings]:
            image, cpu, memory = bench.povray(radiosity(*setting, min(bounces, 20)))
            add("POV-Ray radiosity", "count {} error_bound {} nearest_count {}".format(*setting), image - direct, cpu - direct_cpu, memory)
    if "cycles" in who:
        start_cpu = bench.cycles(1, 0)[2]
        for samples in paths:
            _, indirect, cpu, memory = bench.cycles(samples, bounces)
            add("Cycles", f"{samples} samples", indirect, cpu - start_cpu, memory)
    return rows


def seconds_to(rows, error):
    """Interpolates on straight lines between points in logarithmic axes. Returns the seconds and whether they are extrapolated, or None if the
    error is not reached."""
    rows = sorted(({**r, "cpu_s": max(r["cpu_s"], 1e-3)} for r in rows), key=lambda r: r["cpu_s"])  # This is a difference, which noise may take below 0.
    for before, after in zip([None] + rows[:-1], rows):
        if after["error"] <= error:
            if before is None:
                return after["cpu_s"], False
            share = math.log(before["error"] / error) / math.log(before["error"] / max(after["error"], 1e-6))
            return before["cpu_s"] * (after["cpu_s"] / before["cpu_s"])**share, False
    if len(rows) < 2 or rows[0]["program"] not in ("tomales reference", "Cycles"):
        return None
    before, last = rows[-2:]
    slope = math.log(last["cpu_s"] / before["cpu_s"]) / math.log(before["error"] / last["error"])
    return last["cpu_s"] * (last["error"] / error)**slope, True


def compare(rows):
    """Prints the seconds to the requested error."""
    print(f"\n| room | bounces | program | CPU s to {100 * ASKED_ERROR:g} % |\n|---|---|---|---|")
    for key in dict.fromkeys((r["room"], r["bounces"], r["program"]) for r in rows):
        mine = [r for r in rows if (r["room"], r["bounces"], r["program"]) == key]
        reached = seconds_to(mine, ASKED_ERROR)
        text = f"{'~' if reached[1] else ''}{reached[0]:.2f}" if reached else f"not reached ({100 * min(r['error'] for r in mine):.1f} % in {max(r['cpu_s'] for r in mine):.1f} s)"
        print(f"| {key[0]} | {key[1]} | {key[2]} | {text} |", flush=True)


def agreement(bench, bounces, paths):
    """Prints the differences of direct and indirect light of all programs at their best."""
    def say(name, test, truth):
        mean, uncertain, blocks, noise = bench.difference(test, truth)
        print(f"| {bench.room.name} | {name} | {100 * mean:+.3f} ± {100 * uncertain:.3f} % | {100 * blocks:.2f} % | {100 * noise:.2f} % |", flush=True)

    print("\n| room | compared with ours | mean | rms of blocks | of these, noise |\n|---|---|---|---|---|")
    direct = bench.ours("--gi", "none")[0]
    say("POV-Ray, direct", bench.povray(None, lamps=16)[0], direct)
    pov_direct = bench.povray(None)[0]
    for b in bounces:
        indirect = bench.ours("--gi", "reference", "--bounces", b, "--samples", paths, "--indirect-only")[0]
        c_direct, c_indirect, _, _ = bench.cycles(paths, b)
        if b == bounces[0]:
            say("Cycles, direct", c_direct, direct)
        say(f"Cycles, {b} bounces", c_indirect, indirect)
        say(f"POV-Ray, {b} bounces", bench.povray(radiosity(*POV_SETTINGS[-1], min(b, 20)))[0] - pov_direct, indirect)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tomales", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--rooms", nargs="+", default=["cornell", "interior"])
    parser.add_argument("--programs", nargs="*", default=["tomales", "povray", "cycles"], help="to measure; none: only whether they agree")
    parser.add_argument("--bounces", nargs="+", type=int, default=[1, 12])
    parser.add_argument("--truth", type=int, default=8192, help="paths of a pixel of the truth")
    parser.add_argument("--paths", nargs="+", type=int, default=[16, 64, 256], help="of a pixel, our reference's and Cycles'")
    parser.add_argument("--pov-settings", type=int, default=len(POV_SETTINGS), help="how many, cheapest first")
    parser.add_argument("--agreement", type=int, default=0, help="paths of a pixel to see whether the programs agree; 0: not asked")
    parser.add_argument("--json", type=pathlib.Path)
    given = parser.parse_args()
    if given.size < WINDOW * WINDOWS_A_SIDE:
        parser.error(f"--size: the windows need {WINDOW * WINDOWS_A_SIDE}")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in given.rooms:
            bench = Bench(given.tomales.resolve(), getattr(rooms, name)(), given.size, pathlib.Path(folder))
            if given.agreement:
                agreement(bench, given.bounces, given.agreement)
            if given.programs:
                for bounces in given.bounces:
                    rows += measure(bench, bounces, given.programs, given.truth, given.paths, given.pov_settings)
        if rows:
            compare(rows)
    if given.json:
        given.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
