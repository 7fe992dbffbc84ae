"""Runs the renderer in a folder of its own, and collects what did not go as a test expects."""
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

PAGE = (pathlib.Path(__file__).parents[2] / "docs/messages.md").read_text()
REPORT = re.compile(r": (?:info|note|warning|missing|error|output error): .* \[([a-z0-9-]+)\]$", re.M)

GOOD = """Display "good.exr" "file" "rgba"
Format 24 24 1
Projection "perspective" "fov" [40]
Translate 0 0 4
WorldBegin
LightSource "distantlight" 1
Surface "matte"
Sphere 1 -1 1 360
WorldEnd
"""


class Suite:
    def __init__(self):
        self.program = pathlib.Path(sys.argv[1]).resolve()
        self.failures = 0
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def write(self, name, content):
        data = content if isinstance(content, bytes) else content.encode()
        (self.folder / name).write_bytes(data)
        return name

    def trust_shaders(self, folders):
        """Makes the renderer load plugins of these folders of the test, as --shaders does."""
        os.environ["TOMALES_SHADERS"] = folders

    def run(self, *arguments, stdin=None, cpu_s=None):
        """Runs the program. With `cpu_s`, it and its children may each take that much CPU time."""
        limit = cpu_s and (lambda: resource.setrlimit(resource.RLIMIT_CPU, (cpu_s, resource.RLIM_INFINITY)))
        result = subprocess.run([self.program, *arguments], cwd=self.folder, input=stdin, capture_output=True,
                              timeout=60, text=True, errors="replace", preexec_fn=limit,
                              env={"XDG_CONFIG_HOME": str(self.folder / "config"), **os.environ,
                                   "TOMALES_TEXTURE_CACHE": str(self.folder / "textures")})
        for code in REPORT.findall(result.stderr):
            if f"`{code}`" not in PAGE:
                self.expect(False, f"docs/messages.md explains {code}")
        return result

    def expect(self, condition, message):
        print(("ok      " if condition else "FAILED  ") + message)
        self.failures += not condition

    def expect_run(self, what, arguments, code, *says, stdin=None):
        """Expects an exit code, and every text of `says` among the messages."""
        result = self.run(*arguments, stdin=stdin)
        missing = [s for s in says if s not in result.stdout + result.stderr]
        good = result.returncode == code and not missing
        self.expect(good, what)
        if not good:
            print(f"        exit {result.returncode}, expected {code}; not said: {missing}\n        {result.stderr[:600]}")
        return result

    def finish(self):
        self.temporary.cleanup()
        sys.exit(bool(self.failures))
