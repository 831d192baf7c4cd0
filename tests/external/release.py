"""release.py SOURCE WORK PROGRAM: what a release is made of, as far as it can be run here; one line a result.

Workflows and the action by actionlint, the container file by hadolint, the archives' plan, installers and bill of materials by `dist`,
the bill by the schema of CycloneDX, the hook by pre-commit in a sample repository, and the example in Python. The installer downloads
from a server on this machine. Nothing is compiled: PROGRAM is the one that goes into the archive.
"""
import functools
import hashlib
import http.server
import json
import os
import shutil
import subprocess
import sys
import tarfile
import threading
from pathlib import Path

from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

SOURCE, WORK, PROGRAM = (Path(argument).resolve() for argument in sys.argv[1:4])
TOOLS = Path(sys.executable).parent
TARGET = "x86_64-unknown-linux-gnu"
LIGHT = 'base = "cognifly"\n'
HEAVY = 'base = "cognifly"\n\n[limits]\nmass_budget_g = 200.0\n'


def run(command, folder, **environment):
    path = f"{TOOLS}:{PROGRAM.parent}:{os.environ['PATH']}"
    return subprocess.run([str(word) for word in command], cwd=folder, env={**os.environ, "PATH": path, **environment}, capture_output=True, text=True)


def result(name, good, why=""):
    print(f"ok {name}" if good else f"FAILED {name}: {' '.join(why.split())[:400]}", flush=True)


def succeeds(name, done):
    result(name, done.returncode == 0, f"exit code {done.returncode}: {done.stdout} {done.stderr}")
    return done.returncode == 0


def git(folder, *arguments):
    done = run(["git", "-c", "user.name=a", "-c", "user.email=a@example.com", "-c", "init.defaultBranch=main", *arguments], folder)
    assert done.returncode == 0, done.stderr


def copy_of_sources():
    """The tracked and the new files as a repository of its own, which a release changes."""
    copy = WORK / "source"
    copy.mkdir(parents=True)
    files = run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"], SOURCE).stdout.split("\0")
    for name in filter(None, files):
        if (SOURCE / name).exists():
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(SOURCE / name, copy / name)
    git(copy, "init", "--quiet")
    git(copy, "add", "--all")
    git(copy, "commit", "--quiet", "-m", "source")
    return copy


def workflows(copy):
    """Each workflow; the action as a workflow sees it that uses it; and an action with a fault."""
    succeeds("actionlint on every workflow", run(["actionlint", *sorted((copy / "docs/ci/github").glob("*.yml"))], copy))
    user = WORK / "user"
    (user / ".github/workflows").mkdir(parents=True)
    git(user, "init", "--quiet")
    text = (copy / "docs/ci/github/workflow.yml").read_text().replace("OWNER/flexframe@main", "./")
    (user / ".github/workflows/frames.yml").write_text(text)
    action = (copy / "action.yml").read_text()
    (user / "action.yml").write_text(action)
    succeeds("actionlint on the action and a workflow that uses it", run(["actionlint"], user))
    (user / "action.yml").write_text(action.replace("  frames:\n", "  drawings:\n", 1))
    done = run(["actionlint"], user)
    result("actionlint finds an input that the action does not have", done.returncode == 1 and '"frames"' in done.stdout, done.stdout)


def container(copy):
    """The container file's style; and that what .dockerignore lets through is a package of cargo."""
    succeeds("hadolint on the container file", run(["hadolint", "Dockerfile"], copy))
    context = WORK / "context"
    for line in (copy / ".dockerignore").read_text().splitlines():
        if line.startswith("!"):
            source, place = copy / line[1:].rstrip("/"), context / line[1:].rstrip("/")
            shutil.copytree(source, place) if source.is_dir() else (context.mkdir(exist_ok=True), shutil.copyfile(source, place))
    succeeds("the container's context is a whole package", run(["cargo", "metadata", "--no-deps", "--locked", "--format-version", "1"], context))


def archive(folder):
    """An archive as `dist` makes it, of the program that was built already."""
    name = f"flexframe-{TARGET}"
    with tarfile.open(folder / f"{name}.tar.gz", "w:gz") as tar:
        tar.add(PROGRAM, f"{name}/flexframe")


def installer(made):
    """The shell installer, as a person runs it who has no Rust: from a server that holds the archive."""
    archive(made)
    quiet = type("Quiet", (http.server.SimpleHTTPRequestHandler,), {"log_message": lambda *_: None})
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(quiet, directory=str(made)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    home = WORK / "home"
    home.mkdir()
    address = f"http://127.0.0.1:{server.server_port}"
    done = run(["sh", made / "flexframe-installer.sh"], home, HOME=str(home), CARGO_HOME=str(home / "cargo"), FLEXFRAME_DOWNLOAD_URL=address)
    server.shutdown()
    installed = home / "cargo/bin/flexframe"
    same = installed.exists() and hashlib.sha256(installed.read_bytes()).digest() == hashlib.sha256(PROGRAM.read_bytes()).digest()
    result("the shell installer installs the program", done.returncode == 0 and same, done.stdout + done.stderr)
    succeeds("the installed program runs", run([installed, "--version"], home))


def valid(text):
    return JsonStrictValidator(SchemaVersion.V1_6).validate_str(text)


def bill(made, copy):
    """The bill of materials: valid, complete, and the same again."""
    text = (made / "flexframe.cdx.json").read_text()
    fault = valid(text)
    result("the bill of materials fits the schema of CycloneDX", fault is None, str(fault))
    content = json.loads(text)
    nameless = {key: value for key, value in content["components"][0].items() if key != "name"}
    result("a bill with a component without a name does not", valid(json.dumps({**content, "components": [nameless], "dependencies": []})) is not None)
    listed = {component["purl"] for component in content["components"]}
    tree = run(["cargo", "tree", "--locked", "--edges", "normal", "--prefix", "none", "--format", "{p}", "--target", TARGET], copy)
    used = {"pkg:cargo/" + "@".join(line.split()[:2]).replace("@v", "@") for line in tree.stdout.splitlines() if not line.startswith("flexframe ")}
    result(f"the bill lists all {len(used)} crates of this platform", tree.returncode == 0 and len(used) > 100 and used <= listed, f"{used - listed} {tree.stderr}")
    again = WORK / "again.json"
    succeeds("the bill is written again", run([sys.executable, "docs/ci/sbom.py", again], copy))
    result("the bill has the same bytes again", again.read_text() == text)


def archives(copy):
    succeeds("the address is stated for a release", run(["bash", "docs/ci/address.sh", "https://github.com/OWNER/flexframe"], copy))
    plan = run(["dist", "plan", "--tag=v0.1.0", "--output-format=json"], copy)
    if not succeeds("dist has a plan", plan):
        return
    artifacts = json.loads(plan.stdout)["artifacts"]
    targets = sorted(target for artifact in artifacts.values() if artifact["kind"] == "executable-zip" for target in artifact["target_triples"])
    result("dist plans archives of five platforms", len(targets) == 5 and TARGET in targets, str(targets))
    made = copy / "target/distrib"
    if succeeds("dist makes installers, sources and the bill", run(["dist", "build", "--artifacts=global", "--tag=v0.1.0"], copy)):
        bill(made, copy)
        installer(made)
    succeeds("cargo could publish the package", run(["cargo", "publish", "--dry-run", "--no-verify", "--allow-dirty", "--locked"], copy))


def hook(copy):
    """pre-commit with the hook that takes the installed program; the other one would compile it."""
    repository = WORK / "hooked"
    (repository / "frames").mkdir(parents=True)
    git(repository, "init", "--quiet")
    revision = run(["git", "rev-parse", "HEAD"], copy).stdout.strip()
    (repository / ".pre-commit-config.yaml").write_text(
        f"repos:\n  - repo: {copy}\n    rev: {revision}\n    hooks:\n      - id: flexframe-check-installed\n")
    succeeds("the hooks' manifest is valid", run(["pre-commit", "validate-manifest", ".pre-commit-hooks.yaml"], copy))
    for name, text, code in [("a frame that keeps its limits", LIGHT, 0), ("a frame that is too heavy", HEAVY, 1)]:
        (repository / "frames/mine.toml").write_text(text)
        git(repository, "add", "--all")
        done = run(["pre-commit", "run"], repository, PRE_COMMIT_HOME=str(WORK / "pre-commit"))
        right = done.returncode == code and ("budget" in done.stdout) == bool(code)
        result(f"pre-commit: {name}", right, f"exit code {done.returncode}: {done.stdout} {done.stderr}")


def example(copy):
    picture = WORK / "presets.png"
    done = run([sys.executable, "examples/python/compare_presets.py", picture], copy, FLEXFRAME=str(PROGRAM))
    if succeeds("the example in Python", done):
        result("the example drew its picture", picture.stat().st_size > 20_000 and "cognifly-mini" in done.stdout, done.stdout)


def main():
    shutil.rmtree(WORK, ignore_errors=True)
    copy = copy_of_sources()
    workflows(copy)
    container(copy)
    hook(copy)
    example(copy)
    archives(copy)


main()
