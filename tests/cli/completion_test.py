"""Tests what bash completes with the script that the program itself makes, and what --version prints."""
import re
import subprocess

from program import Suite

t = Suite()
script = t.expect_run("completion", ["completion"], 0, "complete ").stdout
t.write("tomales.bash", script)


def completed(*words):
    """Returns what bash offers for the last word of the command line."""
    line = f'source tomales.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _tomales; printf "%s\\n" "${{COMPREPLY[@]}}"'
    result = subprocess.run(["bash", "-euc", line, "bash", "tomales", *words], cwd=t.folder, capture_output=True, text=True)
    t.expect(not result.stderr, f"  bash reads it without a word {result.stderr}")
    return result.stdout.split()


t.expect(completed("sha") == ["shade", "shadetest"], "a command")
t.expect(completed("scene.rib", "--skip") == ["--skip-finished"], "an option of render, which needs no name")
t.expect(completed("import", "--sm") == ["--smooth"], "an option of another command")
t.expect(completed("import", "--sk") == [], "and none of render's there")
t.expect(completed("import", "--up", "") == ["y", "z"], "the words that an option takes")
t.expect("gather" in completed("render", "scene.rib", "--gi", ""), "methods of indirect light")
t.expect(completed("render", "-o", "pic") == [], "files are left to bash")

commands = re.findall(r"^  (\w+)", t.run("--help").stdout.split("Subcommands:")[1].split("\n\n")[0], re.M)
t.expect(len(commands) > 15 and completed("") == commands, f"all commands: {commands}")
for command in commands:
    options = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", t.run(command, "--help-all").stdout, re.M))
    offered = set(completed(command, "--"))
    t.expect(options == offered, f"all options of {command} {options ^ offered}")

version = t.run("--version").stdout
t.expect(re.search(r"^commit ([0-9a-f]{40}( with changes)?|unknown)$", version, re.M), "--version tells the commit")
libraries = re.findall(r"^  (.+) ([\d.]+) \((.+)\)$", version, re.M)
t.expect({"OpenSubdiv", "Embree", "OpenImageIO", "OpenEXR", "GLM"} <= {name for name, _, _ in libraries}, f"and every library {libraries}")
t.finish()
