"""Tests that the error that --audit states is near the true one, on rooms of tests/stability and a random one. It is a small
tests/bench/error_rooms.py."""
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "bench"))
from error_rooms import Rooms, true_error  # noqa: E402

failures = 0
with tempfile.TemporaryDirectory() as folder:
    rooms = Rooms(pathlib.Path(sys.argv[1]).resolve(), folder, 20, "2")
    for room, paths in {"box_ball": 1024, "random1": 1024}.items():
        truth = rooms.truth(room, paths)
        for settings in (["--samples", "100"], ["--samples", "400", "--max-error", "3"]):
            picture, audit = rooms.render(room, "--audit=200", *settings)
            true, _ = true_error(picture, truth)
            stated = audit["indirect"]["mean"]
            good = 1 / 1.5 < stated / true < 1.5
            failures += not good
            print(f"{'ok     ' if good else 'FAILED '} {room} {' '.join(settings)}: true {100 * true:.2f} %, stated {100 * stated:.2f} % "
                  f"({100 * audit['indirect']['low']:.2f} to {100 * audit['indirect']['high']:.2f})")
sys.exit(bool(failures))
