"""ci.py SOURCE WORK: runs the steps of action.yml and docs/ci on a sample repository, as GitHub and GitLab would; one line a result.

What a step that `uses` another action does (checkout, cache) is done here by hand: a folder is kept between runs. GitHub's command
`gh` is a stand-in that keeps comments in a file. The wheel is the one in WORK/wheel.
"""
import html
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

# A key of an earlier version is refused.
REFUSED = 'base = "cognifly"\n[limits]\nwall_extrusions = 2\n'
# The longest bridge of ABS, the sleeve's of 18.6 mm, keeps the catalogue's 20 mm and warns at less. The next smallest margin of all
# bridges, in TPU, is larger than its margin was.
LIMITS_OF_ABS = {"main": ""} | {branch: f"[override.materials.abs]\nbridge_mm = {most}\n" for branch, most in (("long", 18.0), ("longer", 17.0))}


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


def sample(folder, branches):
    """A repository with a branch for each list of files; main comes first, and the others change it."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    git(folder, "init", "--quiet")
    for branch, files in branches.items():
        if branch != "main":
            git(folder, "checkout", "--quiet", "main")
            git(folder, "checkout", "--quiet", "-b", branch)
        for path, text in files.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text)
        git(folder, "add", ".")
        git(folder, "commit", "--quiet", "-m", branch)


def own_repository(folder):
    """This source tree as a repository of its own; its only commit."""
    folder.mkdir(parents=True)
    git(folder, "init", "--quiet")
    tree = [f"--git-dir={folder / '.git'}", f"--work-tree={SOURCE}"]
    git(SOURCE, *tree, "add", "--all", ".")
    git(SOURCE, *tree, "commit", "--quiet", "-m", "source")
    return run(["git", "rev-parse", "HEAD"], folder).stdout.strip()


def expression(text, values):
    """The value of ${{ ... }}: only what the action asks for is known."""
    return re.sub(r"\$\{\{\s*(.+?)\s*\}\}", lambda match: values[match[1]], text)


def condition(text, values):
    """The value of an `if:` of comparisons, `&&` and `always()`."""
    words = text.replace("always()", "True").replace("&&", "and").replace("||", "or")
    return eval(re.sub(r"'[^']*'|\b(?:inputs|steps|github)\.[\w.-]+", lambda word: word[0] if word[0][0] == "'" else repr(values[word[0]]), words))


# Keeps a comment in $COMMENTS/NUMBER.md: POST writes the first, PATCH another text of it, GET lists the number if there is one.
STAND_IN_FOR_GH = """#!/bin/bash
body=${@: -1}
case "$*" in
    *"--method POST repos/o/frames/issues/7/comments "*) cp "${body#body=@}" "$COMMENTS/11.md" ;;
    *"--method PATCH repos/o/frames/issues/comments/11 "*) [[ -f $COMMENTS/11.md ]] && cp "${body#body=@}" "$COMMENTS/11.md" && touch "$COMMENTS/edited" ;;
    *"repos/o/frames/issues/7/comments --jq "*) [[ ! -f $COMMENTS/11.md ]] || echo 11 ;;
    *) exit 1 ;;
esac
"""


def github(folder, kept, base, frames="frames/*.toml", wheel="", event="push"):
    """The action's own steps; their exit code, what they print, and the seconds they take."""
    steps = yaml.safe_load((SOURCE / "action.yml").read_text())["runs"]["steps"]
    temp = kept.parent
    summary, output, commands = temp / "summary.md", temp / "output.txt", temp / "commands"
    summary.write_text("")
    output.write_text("")
    commands.mkdir(exist_ok=True)
    (commands / "gh").write_text(STAND_IN_FOR_GH)
    (commands / "gh").chmod(0o755)
    values = {"inputs.frames": frames, "inputs.wheel": wheel, "inputs.baseline": "", "inputs.strict": "false", "inputs.strength": "false", "inputs.base": base,
              "inputs.fail-on-increase": "mass=2g", "inputs.comment": "true", "inputs.plates": str(event == "pull_request").lower(),
              "inputs.token": "none", "github.event_name": event, "github.event.pull_request.number": "7", "github.repository": "o/frames",
              "steps.kept.outputs.cache-hit": "true", "steps.install.outcome": "skipped", "steps.plates.outcome": "skipped"}
    env = {"GITHUB_ACTION_PATH": str(SOURCE), "GITHUB_OUTPUT": str(output), "GITHUB_STEP_SUMMARY": str(summary), "RUNNER_TEMP": str(temp),
           "COMMENTS": str(temp), "PATH": f"{commands}:{os.environ['PATH']}"}
    said, code, begun = "", 0, processor_s()
    for step in steps:
        asked = step.get("if", "True")
        if (code and "always()" not in asked) or not condition(asked, values) or "run" not in step:
            continue
        assert step["shell"] == "bash"
        own = {key: expression(value, values) for key, value in step.get("env", {}).items()}
        done = run(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]], folder, {**env, **own})
        said, code = said + done.stdout + done.stderr, code or done.returncode
        values[f"steps.{step['id']}.outcome"] = "failure" if done.returncode else "success"
    return code, said, summary.read_text(), processor_s() - begun


def gitlab(folder, base, url, revision):
    job = yaml.safe_load((SOURCE / "docs/ci/gitlab-ci.yml").read_text())
    frames = job["frames"]
    told = {"FLEXFRAME_URL": str(url), "FLEXFRAME_REVISION": revision, "CI_MERGE_REQUEST_DIFF_BASE_SHA": base}
    assert {"FLEXFRAME_URL", "FLEXFRAME_REVISION"} <= job["variables"].keys()
    # A job without rules is in no pipeline of a merge request, where alone there is something to compare with.
    assert any("merge_request_event" in rule["if"] for rule in frames["rules"]), frames.get("rules")
    env = {**job["variables"], **frames["variables"], **told}
    done = run("set -eo pipefail\n" + "\n".join(frames["script"]), folder, env, shell=True)
    return done.returncode, done.stdout + done.stderr


def script(name, folder, kept, *arguments, **variables):
    """A script of docs/ci by itself, with the kept program: exit code, what it prints."""
    interpreter = "python3" if name.endswith(".py") else "bash"
    env = {"FLEXFRAME": str(kept / "bin/flexframe"), **variables}
    done = run([interpreter, str(SOURCE / "docs/ci" / name), *arguments], folder, env)
    return done.returncode, done.stdout + done.stderr


def mended(kept):
    """Frames that check refuses in the base revision: in their own text, in that of a base, and because they cannot close."""
    cannot_close = 'base = "cognifly"\n[rods]\ncage_rod_length_mm = 319.0\n'
    first = {"shared/base.toml": REFUSED, "frames/heir.toml": 'base = "../shared/base.toml"\n', "frames/old.toml": REFUSED,
             "frames/wide.toml": cannot_close, "frames/right.toml": LIGHT}
    right = {path: LIGHT for path in ("shared/base.toml", "frames/old.toml", "frames/wide.toml")}
    repository = WORK / "ci/mended"
    branches = {"right": right, "heavy": {**right, "frames/right.toml": HEAVY}, "wrong": {"frames/old.toml": REFUSED + "# still\n"}}
    sample(repository, {"main": first, **branches})

    git(repository, "checkout", "--quiet", "right")
    code, said, _, _ = github(repository, kept, "main")
    told = re.findall(r"^::notice file=frames/(\w+)\.toml,", said, re.MULTILINE)
    result("gate.sh: frames that are refused in the base revision count as new", code == 0 and told == ["heir", "old", "wide"], f"exit code {code}: {said}")
    trees = run(["git", "worktree", "list"], repository).stdout
    result("gate.sh: no work tree is left", len(trees.splitlines()) == 1, trees)
    code, said = script("gate.sh", repository, kept, FRAMES="frames/old.toml", BASE="main", FAIL_ON_INCREASE="weight=2g")
    told = "no measure `weight`" in said and "counts as new" not in said
    result("gate.sh: an option that is wrong fails with such a frame, too", code == 2 and told, f"exit code {code}: {said}")
    git(repository, "checkout", "--quiet", "heavy")
    code, said, _, _ = github(repository, kept, "main")
    result("gate.sh: another frame that grows fails beside them", code == 1 and "mass grew by 32.00 g" in said, f"exit code {code}: {said}")
    git(repository, "checkout", "--quiet", "wrong")
    code, said, _, _ = github(repository, kept, "main", "frames/old.toml")
    result("gate.sh: a frame that is still refused fails", code == 2 and "::notice" not in said, f"exit code {code}: {said}")


def reports(kept):
    """Reports of a check that is refused, where an earlier run left some, and of one that is not."""
    repository = WORK / "ci/reports"
    sample(repository, {"main": {"frames/light.toml": LIGHT}})
    files = [repository / "frames.xml", repository / "frames.sarif"]
    for why, variables in {"no file matches": {"FRAMES": "nothing/*.toml"}, "the baseline is not there": {"BASELINE": "nothing.json"}}.items():
        for file in files:
            file.write_text("of an earlier run\n")
        code, said = script("gate.sh", repository, kept, JUNIT="frames.xml", SARIF="frames.sarif", **variables)
        gone = [file.name for file in files if not file.exists() and f"{file.name} is not written" in said]
        result(f"gate.sh: no reports where {why}", code == 2 and len(gone) == 2, f"exit code {code}, gone {gone}: {said}")
    code, said = script("gate.sh", repository, kept, JUNIT="frames.xml", SARIF="frames.sarif")
    result("gate.sh: reports of a frame that passes", code == 0 and all(file.stat().st_size for file in files), f"exit code {code}: {said}")


def machine(kept):
    """What is not a frame's fault: no program, and files that cannot be written."""
    repository = WORK / "ci/machine"
    sample(repository, {"main": {"frames/light.toml": LIGHT, "...toml": 'name = "evil"\n' + LIGHT}})
    for file in ("JUNIT", "SARIF", "SUMMARY"):
        code, said = script("gate.sh", repository, kept, **{file: "nowhere/file"})
        result(f"gate.sh: {file} in a folder that is not there is exit code 3", code == 3 and "cannot be written" in said, f"exit code {code}: {said}")
    for name in ("gate.sh", "plates.sh"):
        code, said = script(name, repository, kept, "plates", FLEXFRAME="/nowhere/flexframe")
        result(f"{name}: no program is exit code 3", code == 3, f"exit code {code}: {said}")
    (repository / "file").write_text("no folder")
    code, said = script("plates.sh", repository, kept, "file/plates")
    result("plates.sh: a folder that cannot be made is exit code 3", code == 3, f"exit code {code}: {said}")
    code, said = script("plates.sh", repository, kept, "inside/plates", FRAMES="...toml")
    written = sorted(str(path.relative_to(repository)) for path in repository.glob("inside/**/*.3mf"))
    result("plates.sh: a frame named ...toml has its plates in the folder", code == 0 and written == ["inside/plates/..-frame/abs_1.3mf", "inside/plates/..-frame/tpu_1.3mf"], f"{written}: {said}")


def from_anywhere(kept):
    """Frames and lists that are named by an absolute path, and names that a forge would take for links."""
    repository = WORK / "ci/anywhere"
    name = "frames/a`[fix](http:x.example)`.toml"
    link = 'base = "cognifly"\nbought.battery = "__b__ @root www.x.example http://a.b.c/"\n'
    sample(repository, {"main": {"frames/light.toml": LIGHT}, "heavy": {"frames/light.toml": HEAVY, "frames/link.toml": link, name: "wrong"}})
    git(repository, "checkout", "--quiet", "heavy")
    absolute = f"{repository}/frames/light.toml"
    code, said = script("gate.sh", repository, kept, FRAMES=absolute, BASE="main", FAIL_ON_INCREASE="mass=2g")
    result("gate.sh: a frame by its absolute path is compared", code == 1 and "mass grew by 32.00 g" in said, f"exit code {code}: {said}")
    code, said = script("gate.sh", repository, kept, FRAMES=absolute, BASE="main", STRENGTH="true", FAIL_ON_INCREASE="design_drop.travel=100mm")
    rows = [line for line in said.splitlines() if line.startswith("| design_drop.")]
    result("gate.sh: the design drop is compared where it is asked for", code < 2 and len(rows) > 0, f"exit code {code}: {said}")
    outside = repository.parent / "outside.json"
    code, said = script("changes.py", repository, kept, "main", FRAMES=absolute, BASELINE=str(outside))
    result("changes.py: a list outside of the work tree is named, where it is not there", code == 0 and "not checked" in said and "outside.json" in said, said)
    outside.write_text('{"format": 1, "accepted": []}')
    code, said = script("changes.py", repository, kept, "main", FRAMES=absolute)
    result("changes.py: a frame by its absolute path is compared", code == 0 and "+32.00" in said, f"exit code {code}: {said}")
    _, said = script("changes.py", repository, kept, "main")
    markup = [sign for sign in ("__b__", "@root", "://", "www.x") if sign in said]
    result("changes.py: text of a frame file is no link and no mention", "refused" in said and not markup, f"{markup}: {said}")
    code, said = script("gate.sh", repository, kept, FORMAT="github", SUMMARY="page.md")
    page = (repository / "page.md").read_text()
    result("gate.sh: a file's name with backticks is code", code == 2 and f"(``{name}:1:" in page, page)


def adopted(kept):
    """The first frame of a repository: the base revision has none, and a pattern matches nothing."""
    repository = WORK / "ci/adopted"
    sample(repository, {"main": {"README.md": "frames to come\n"}, "first": {"frames/light.toml": LIGHT}})
    code, said = script("changes.py", repository, kept, "main", FRAMES="frame/*.toml frames/*.toml")
    rows = [row for row in table_rows(said) if "no file matches" in row[2] and row[-2] == "not checked"]
    told = "frames/light.toml" in said and "new; limits violated: 0" in said and len(rows) == 1
    result("changes.py: the first frame is new, and a pattern that matches nothing is told", code == 0 and told, f"exit code {code}: {said}")


def warnings(kept):
    """A warning is compared with itself, and the other bridges with each other."""
    repository = WORK / "ci/warnings"
    sample(repository, {branch: {"frames/span.toml": 'base = "cognifly"\n' + limit} for branch, limit in LIMITS_OF_ABS.items()})

    def is_told(branch, base, row, word, strict=""):
        git(repository, "checkout", "--quiet", branch)
        _, said = script("changes.py", repository, kept, base, STRICT=strict)
        found = re.findall(r"margin of (bridge.*?) \| *(\S+) \| *(\S+) \| *\S+ \| (.*) \|", html.unescape(said))
        result(f"changes.py: {'strict: ' if strict else ''}a bridge, {word}", found == [("bridge: battery_sleeve, mm", *row, word)], said)

    is_told("long", "main", ("1.39", "-0.61"), "warns now")
    is_told("long", "main", ("1.39", "-0.61"), "limit violated", strict="true")
    is_told("main", "long", ("-0.61", "1.39"), "warned before")
    is_told("main", "long", ("-0.61", "1.39"), "limit kept again", strict="true")
    is_told("longer", "long", ("-0.61", "-1.61"), "still warns")


def accepted(kept):
    """A violation that the list of the work tree accepts, and one that is worse than there."""
    def weighs(mass_g):
        return f'base = "cognifly"\n[battery]\nbattery_mass_g = {mass_g}\n'

    repository = WORK / "ci/accepted"
    sample(repository, {"main": {"frames/heavy.toml": weighs(58.0)}, "heavy": {"frames/heavy.toml": weighs(90.0)}, "heavier": {"frames/heavy.toml": weighs(95.0)}})
    git(repository, "checkout", "--quiet", "heavy")
    listed = run([str(kept / "bin/flexframe"), "check", "-q", "frames/heavy.toml", "--baseline", "accepted.json", "--update-baseline"], repository)
    for branch, variables, word in [("heavy", {"BASELINE": "accepted.json"}, "limit violated, accepted"),
                                    ("heavy", {}, "limit violated"), ("heavier", {"BASELINE": "accepted.json"}, "limit violated")]:
        git(repository, "checkout", "--quiet", branch)
        _, said = script("changes.py", repository, kept, "main", **variables)
        found = re.findall(r"margin of mass_budget.*\| ([^|]*) \|", said)
        result(f"changes.py: {branch} with {list(variables) or 'no list'} is told as {word}", found == [word], f"{listed.stdout}{listed.stderr}{said}")
    git(repository, "checkout", "--quiet", "heavy")
    _, said = script("changes.py", repository, kept, "HEAD", BASELINE="accepted.json")
    result("changes.py: what is accepted in both revisions is no change", "mass_budget" not in said and "No mass and no margin" in said, said)


def grown(kept):
    """What grows although no file that FRAMES names by its first letters has changed."""
    def weighs(mass_g):
        return f'base = "cognifly"\n[battery]\nbattery_mass_g = {mass_g}\n'

    repository, heir = WORK / "ci/grown", 'base = "../shared/base.toml"\n'
    first = {"shared/base.toml": weighs(58.0), "frames/heir.toml": heir, "frames/other.toml": LIGHT, "frames2/a/b/nested.toml": weighs(58.0)}
    branches = {"main": first, "base": {"shared/base.toml": weighs(63.0)}, "nested": {"frames2/a/b/nested.toml": weighs(63.0)}}
    sample(repository, branches)

    git(repository, "checkout", "--quiet", "base")
    code, said, summary, _ = github(repository, kept, "main")
    result("gate.sh: a base that grows by 5 g fails its heir", code == 1 and "mass grew by 5.00 g" in said, f"exit code {code}: {said}")
    result("gate.sh: what is the same is not told", "heir@" in summary and "other@" not in summary, summary)

    git(repository, "checkout", "--quiet", "nested")
    code, said, _, _ = github(repository, kept, "main", "cognifly frames2/**/*.toml")
    result("gate.sh: a file two folders down that grows by 5 g fails", code == 1 and "mass grew by 5.00 g" in said, f"exit code {code}: {said}")
    code, said, _, _ = github(repository, kept, "main", "cognifly")
    result("gate.sh: a preset by its name passes", code == 0, f"exit code {code}: {said}")
    code, said, _, _ = github(repository, kept, "nowhere", "cognifly")
    result("gate.sh: a base revision that is not there fails", code == 2 and "there is no revision nowhere" in said, f"exit code {code}: {said}")


def table_rows(text):
    """The rows of Markdown tables, each as its cells."""
    return [[cell.strip() for cell in line.split("|")] for line in text.splitlines() if line.startswith("|")]


def pull_request(repository, kept):
    """On a pull request whose frame fails: the comment, written and then edited, and the plates; the program is that of a wheel."""
    wheels = sorted((WORK / "wheel").glob("*.whl"))
    if not wheels:
        result("action.yml: there is a wheel to install", False, f"none in {WORK / 'wheel'}")
        return
    temp = kept.parent.parent / "pull-request"
    temp.mkdir()
    documented = table_rows((SOURCE / "docs/gate.md").read_text().split("The comment has one row")[1].split("\n\n")[1])
    for edited in (False, True):
        code, said, _, _ = github(repository, temp / "flexframe", "main", wheel=str(wheels[0]), event="pull_request")
        result(f"action.yml: with a wheel, run {1 + edited}: a battery of 90 g fails", code == 1 and "::error file=frames/light.toml" in said, f"exit code {code}: {said}")
        comment = (temp / "11.md").read_text()
        right = comment.startswith("<!-- flexframe") and table_rows(comment) == documented
        result(f"action.yml: the comment, run {1 + edited}, is the one of docs/gate.md", right and (temp / "edited").exists() == edited, comment)
    plates = sorted(path.name for path in (temp / "plates/frames/light").iterdir())
    result("action.yml: the plates of a frame that fails", plates == ["abs_1.3mf", "print-settings.md", "tpu_1.3mf"], str(plates))


def main():
    repository, kept = WORK / "ci/sample", WORK / "ci/temp/flexframe"
    shutil.rmtree(WORK / "ci", ignore_errors=True)
    shutil.rmtree(WORK / "findings", ignore_errors=True)
    kept.parent.mkdir(parents=True)
    sample(repository, {"main": {"frames/light.toml": LIGHT}, "heavy": {"frames/light.toml": HEAVY}})

    git(repository, "checkout", "--quiet", "main")
    code, said, _, _ = github(repository, kept, "")
    result("GitHub action: main passes", code == 0, said)

    git(repository, "checkout", "--quiet", "heavy")
    code, said, summary, seconds = github(repository, kept, "main")
    errors = [line for line in said.splitlines() if line.startswith("::error ")]
    grew = [line for line in errors if "grew by" in line]
    errors = [line for line in errors if line not in grew]
    result("GitHub action: a battery of 90 g fails", code == 1, f"exit code {code}: {said}")
    documented = next(line for line in (SOURCE / "docs/gate.md").read_text().splitlines() if line.startswith("::error "))
    right = len(errors) == 1 and re.fullmatch(".*".join(map(re.escape, documented.split("…"))), errors[0])
    result("GitHub action: the reason stands in one line, at the battery, as docs/gate.md has it", bool(right), str(errors))
    beside = len(grew) == 1 and grew[0].startswith("::error file=frames/light.toml,") and "mass grew by" in grew[0]
    result("GitHub action: what may not grow is told, in a line of its own", beside and "bought.battery" in summary, said)
    result(f"GitHub action: with a kept program in under {MOST_S} s", "was kept" in said and seconds < MOST_S, f"{seconds:.1f} s")

    pull_request(repository, kept)
    # What the job's cache keeps was built by the action already. The program is asked for by a commit, which no clone takes.
    shutil.copytree(kept, repository / ".flexframe/kept")
    source = WORK / "ci/source"
    commit = own_repository(source)
    code, said = gitlab(repository, "main", source, commit)
    result("GitLab job: the program of a commit, as it was kept", "was kept" in said, said)
    result("GitLab job: a battery of 90 g fails", code == 1 and "takes off with" in said, f"exit code {code}: {said}")
    result("GitLab job: its report is there", "<failure" in (repository / "frames.xml").read_text(), "no failure in frames.xml")
    git(repository, "checkout", "--quiet", "main")
    code, said = gitlab(repository, "", source, "main")
    result("GitLab job: main passes", code == 0, said)

    (repository / "frames/old.toml").write_text('base = "cognifly"\n[limits]\nwall_extrusions = 2\n')
    code, said, _, _ = github(repository, kept, "")
    hint = [line for line in said.splitlines() if line.startswith("::error ") and "min_wall_nozzles" in line]
    result("GitHub action: a renamed key gives a hint", code == 2 and len(hint) == 1, said)
    grown(kept)
    mended(kept)
    reports(kept)
    machine(kept)
    from_anywhere(kept)
    adopted(kept)
    warnings(kept)
    accepted(kept)


if __name__ == "__main__":
    main()
