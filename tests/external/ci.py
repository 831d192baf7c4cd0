"""ci.py SOURCE WORK: runs the steps of docs/ci on a sample repository, as GitHub and GitLab would; one line a result.

What a step that `uses` another action does (checkout, cache) is done here by hand: a folder is kept between runs.
"""
import os
import re
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import yaml

SOURCE, WORK = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
# Most that a gate with a kept program may take, s: of processor time, for a machine may have other work; with nothing else to do
# it takes no longer than that.
MOST_S = 30

LIGHT = 'base = "cognifly"\n\n[limits]\nmass_budget_g = 240.0\n'
HEAVY = LIGHT + """
[bought]
battery = "battery-of-mine"

[override.parts.battery-of-mine]
kind = "battery"
size_mm = [58.0, 31.0, 16.0]
mass_g = 90.0
mass_basis = "measured"
source = "kitchen scale"
"""


def run(command, folder, env=None, shell=False):
    full = {**os.environ, "FLEXFRAME_CACHE": str(WORK / "findings"), **(env or {})}
    return subprocess.run(command, cwd=folder, env=full, shell=shell, executable="/bin/bash" if shell else None, capture_output=True, text=True)


def processor_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def result(name, good, why=""):
    why = " ".join(why.split())[:300]
    print(f"ok {name}" if good else f"FAILED {name}: {why}", flush=True)


def git(folder, *arguments):
    identity = ["-c", "user.name=a", "-c", "user.email=a@example.com", "-c", "init.defaultBranch=main"]
    done = run(["git", *identity, *arguments], folder)
    assert done.returncode == 0, done.stderr


def sample(folder):
    """A repository whose main branch keeps its limits, and a branch that adds a battery of 90 g."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "frames").mkdir(parents=True)
    git(folder, "init", "--quiet")
    for text, branch in ((LIGHT, "main"), (HEAVY, "heavy")):
        if branch != "main":
            git(folder, "checkout", "--quiet", "-b", branch)
        (folder / "frames/light.toml").write_text(text)
        git(folder, "add", ".")
        git(folder, "commit", "--quiet", "-m", branch)


def expression(text, values):
    """The value of ${{ ... }}: only what the action asks for is known."""
    return re.sub(r"\$\{\{\s*(.+?)\s*\}\}", lambda match: values[match[1]], text)


def github(folder, kept, base):
    """The action's own steps; their exit code, what they print, and the seconds they take."""
    action = SOURCE / "docs/ci/github"
    steps = yaml.safe_load((action / "action.yml").read_text())["runs"]["steps"]
    temp = kept.parent
    summary, output = temp / "summary.md", temp / "output.txt"
    summary.write_text("")
    output.write_text("")
    inputs = {"inputs.frames": "frames/*.toml", "inputs.baseline": "", "inputs.strict": "false", "inputs.base": base, "inputs.fail-on-increase": "mass=2g"}
    env = {"GITHUB_ACTION_PATH": str(action), "GITHUB_OUTPUT": str(output), "GITHUB_STEP_SUMMARY": str(summary), "RUNNER_TEMP": str(temp)}
    said, code, begun = "", 0, processor_s()
    for step in (step for step in steps if "run" in step):
        assert step["shell"] == "bash"
        own = {key: expression(value, inputs) for key, value in step.get("env", {}).items()}
        done = run(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]], folder, {**env, **own})
        said, code = said + done.stdout + done.stderr, done.returncode
        if code:
            break
    return code, said, summary.read_text(), processor_s() - begun


def gitlab(folder, base):
    job = yaml.safe_load((SOURCE / "docs/ci/gitlab-ci.yml").read_text())
    frames = job["frames"]
    source = folder / ".flexframe/source"
    source.parent.mkdir(exist_ok=True)
    if not source.exists():
        source.symlink_to(SOURCE)
    env = {**job["variables"], **frames["variables"], "CI_MERGE_REQUEST_DIFF_BASE_SHA": base}
    done = run("set -eo pipefail\n" + "\n".join(frames["script"]), folder, env, shell=True)
    return done.returncode, done.stdout + done.stderr


def main():
    repository, kept = WORK / "ci/sample", WORK / "ci/temp/flexframe"
    shutil.rmtree(WORK / "ci", ignore_errors=True)
    shutil.rmtree(WORK / "findings", ignore_errors=True)
    kept.parent.mkdir(parents=True)
    sample(repository)

    git(repository, "checkout", "--quiet", "main")
    code, said, _, _ = github(repository, kept, "")
    result("GitHub action: main passes", code == 0, said)

    git(repository, "checkout", "--quiet", "heavy")
    code, said, summary, seconds = github(repository, kept, "main")
    errors = [line for line in said.splitlines() if line.startswith("::error ")]
    result("GitHub action: a battery of 90 g fails", code == 1, f"exit code {code}: {said}")
    right = len(errors) == 1 and re.match(r"::error file=frames/light\.toml,line=12,.*title=light%3A mass_budget::the frame takes off with 26[0-9.]+ g .*battery 90\.0 g", errors[0])
    result("GitHub action: the reason stands in one line, at the battery", bool(right), str(errors))
    result("GitHub action: what may not grow is told", "mass grew by" in said and "bought.battery" in summary, said)
    result(f"GitHub action: with a kept program in under {MOST_S} s", "was kept" in said and seconds < MOST_S, f"{seconds:.1f} s")

    code, said = gitlab(repository, "main")
    result("GitLab job: a battery of 90 g fails", code == 1 and "takes off with" in said, f"exit code {code}: {said}")
    result("GitLab job: its report is there", "<failure" in (repository / "frames.xml").read_text(), "no failure in frames.xml")
    git(repository, "checkout", "--quiet", "main")
    code, said = gitlab(repository, "")
    result("GitLab job: main passes", code == 0, said)

    (repository / "frames/old.toml").write_text('base = "cognifly"\n[limits]\nwall_extrusions = 2\n')
    code, said, _, _ = github(repository, kept, "")
    hint = [line for line in said.splitlines() if line.startswith("::error ") and "min_wall_nozzles" in line]
    result("GitHub action: a renamed key gives a hint", code == 2 and len(hint) == 1, said)


main()
