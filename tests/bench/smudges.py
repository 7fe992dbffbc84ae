"""Measures mean error, smudges and perceptual differences of pictures that `--target-error` makes: the true figures and those
that the audit states.

    tests/bench/smudges.py build/release/tomales [--scenes interior cornell] [--targets 8 4 2] [--smudges 0 1] [--format 128x96] [--paths 1024] [-t 1]

If the target of smudges is 0, only the mean error has a target. The truth is a picture by `--gi reference`. Two more figures stand beside those of
`tomales compare`. One is the share of pixels that Yee's model of the eye (in OpenImageIO, 0.2 m of picture seen from 0.5 m) finds different. The
other is the mean FLIP error of Andersson et al., if the package flip-evaluator is installed. It writes the table in docs/measured/error.md.
"""
import argparse
import json
import pathlib
import re
import subprocess
import tempfile

import numpy
import OpenImageIO as oiio

ROOT = pathlib.Path(__file__).parents[2]


def flip(test, truth):
    """Returns the mean FLIP error of two pictures as an sRGB display of range [0, 1] shows them, or None without the package."""
    try:
        import flip_evaluator
    except ImportError:
        return None

    def shown(path):
        return numpy.clip(oiio.ImageBufAlgo.colorconvert(oiio.ImageBuf(str(path)), "linear", "sRGB").get_pixels(oiio.FLOAT)[:, :, :3], 0, 1)
    return float(flip_evaluator.evaluate(shown(truth), shown(test), "LDR")[1])


def seen(test, truth):
    """Returns the share of pixels that Yee's model finds different."""
    result = oiio.CompareResults()
    a, b = (oiio.ImageBufAlgo.channels(oiio.ImageBuf(str(p)), ("R", "G", "B")) for p in (test, truth))
    failed = oiio.ImageBufAlgo.compare_Yee(a, b, result, 100.0, 45.0)
    return int(failed) / (a.spec().width * a.spec().height)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tomales", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--scenes", nargs="+", default=["interior"])
    parser.add_argument("--targets", nargs="+", type=float, default=[8, 4, 2])
    parser.add_argument("--smudges", nargs="+", type=float, default=[0, 1])
    parser.add_argument("--format", default="128x96")
    parser.add_argument("--paths", default="1024")
    parser.add_argument("-t", dest="threads", default="1")
    given = parser.parse_args()
    print("| scene | asked | mean: true | stated | smudges of 8, 16, 32: true | stated | Yee | FLIP | CPU s | chosen |\n" + "|---" * 10 + "|", flush=True)
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)

        def render(scene, out, *arguments):
            return subprocess.run([given.tomales, "render", ROOT / "scenes" / scene / f"{scene}.rib", "-t", given.threads, "--format", given.format,
                                   "--pixel-samples", "2x2", "--bucket-size", "16", "-o", folder / out, *arguments], check=True, capture_output=True, text=True, cwd=folder).stderr
        for scene in given.scenes:
            render(scene, "truth.exr", "--gi", "reference", "--ray-geometry", "scene", "--samples", given.paths)
            for target in given.targets:
                for even in given.smudges:
                    limit = ["--target-smudges", f"{even}%"] if even else []
                    said = render(scene, "test.exr", "--target-error", f"{target}%", *limit, "--light-seed", "1", "--stats", folder / "stats.json")
                    stats = json.loads((folder / "stats.json").read_text())
                    true = json.loads(subprocess.run([given.tomales, "compare", folder / "test.exr", folder / "truth.exr", "--json"], check=True, capture_output=True, text=True).stdout)
                    audit = stats["audit"]

                    def percents(values):
                        return ", ".join("-" if v is None else f"{100 * v:.2f}" for v in values)
                    stated = [audit.get(f"smudges_{size}", {}).get("mean") for size in (8, 16, 32)]
                    chosen = (re.search(r"chose (.*?) for", said) or ["", "the scene's"])[1]
                    mean_flip = flip(folder / "test.exr", folder / "truth.exr")
                    missed = ", missed" if "[target-missed]" in said else ""
                    print(f"| {scene} | {target:g} %{f', smudges {even:g} %' if even else ''} | {100 * true['mean_absolute_relative_error']:.2f} | {100 * audit['picture']['mean']:.2f} | "
                          f"{percents([true['smudges'], true['smudges_16'], true['smudges_32']])} | {percents(stated)} | {100 * seen(folder / 'test.exr', folder / 'truth.exr'):.1f} | "
                          f"{'' if mean_flip is None else f'{mean_flip:.4f}'} | {stats['cpu_s']:.1f} | `{chosen}`{missed} |", flush=True)


if __name__ == "__main__":
    main()
