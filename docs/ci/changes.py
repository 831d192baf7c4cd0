"""changes.py BASE: prints a Markdown table of the masses and margins that changed since the revision BASE.

Variables: FLEXFRAME, the program, and FRAMES, files or patterns separated by spaces, as in gate.sh. The frames are checked in the
work tree and in a checkout of BASE. A margin is the smallest of a rule's findings: how far the worst of them is from its limit;
it is negative where the limit is violated. Exit code: 0, or 2 when there is no such revision.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

FLEXFRAME = os.environ.get("FLEXFRAME", "flexframe")
FRAMES = (os.environ.get("FRAMES") or "frames/*.toml").split()


def git(*arguments):
    return subprocess.run(["git", *arguments], capture_output=True, text=True)


def plain(text):
    """Text of a frame file as text of a table's cell: nothing in it is markup, a link or a mention."""
    return re.sub(r"[^\w .,:+/-]", lambda sign: f"&#{ord(sign[0])};", " ".join(str(text).split()))


def checked(folder):
    """The frames of a folder by the name they were asked for; a pattern that matches nothing gives none."""
    frames = {}
    for pattern in FRAMES:
        done = subprocess.run([FLEXFRAME, "check", "--json", "--", pattern], cwd=folder, capture_output=True, text=True)
        if done.stdout:
            frames.update((frame["asked"], frame) for frame in json.loads(done.stdout)["frames"])
        elif folder == Path():
            print(f"changes.py: {pattern}: {done.stderr.strip()}", file=sys.stderr)
    return frames


def quantities(frame):
    """Quantity to (value, limit kept): the mass, g, and the smallest margin of each rule and unit. Notes have no limit to keep."""
    found = {"take-off mass, g": (frame["masses"]["total_g"], True)}
    for finding in frame["findings"]:
        if finding["verdict"] == "note" or finding["margin"] is None:
            continue
        unit = f", {finding['unit']}" if finding["unit"] else ""
        name = f"margin of {finding['rule']}{unit}"
        margin, kept = found.get(name, (float("inf"), True))
        found[name] = (min(margin, finding["margin"]), kept and finding["verdict"] == "holds")
    return found


def number(value):
    """Two decimals; what rounds to nothing has no sign."""
    return "" if value is None else f"{value:.2f}".replace("-0.00", "0.00")


def change(name, before, after):
    """What is to be said of a quantity: more mass and less margin are worse."""
    if not before[1] or not after[1]:
        return "limit violated" if not after[1] else "limit kept again"
    worse = (after[0] > before[0]) == name.startswith("take-off mass")
    return "worse" if worse else "better"


def rows(asked, before, after):
    """The table's rows of one frame, none when nothing of it changed."""
    name = f"`{asked}`" if re.fullmatch(r"[\w ./+-]+", asked) else plain(asked)
    if after is None:
        return [[name, "", "", "", "", "removed"]]
    if "refused" in after:
        return [[name, plain(after["refused"]), "", "", "", "refused"]]
    now = quantities(after)
    if before is None or "refused" in before:
        violated = sum(not kept for _, kept in now.values())
        mass = now["take-off mass, g"][0]
        return [[name, "take-off mass, g", "", number(mass), "", f"new; limits violated: {violated}"]]
    former = quantities(before)
    found = []
    for quantity in former | now:
        was, is_now = former.get(quantity, (None, True)), now.get(quantity, (None, True))
        if (number(was[0]), was[1]) == (number(is_now[0]), is_now[1]):
            continue
        known = was[0] is not None and is_now[0] is not None
        difference = f"{is_now[0] - was[0]:+.2f}" if known else ""
        what = change(quantity, was, is_now) if known else "new" if was[0] is None else "gone"
        found.append([name, quantity, number(was[0]), number(is_now[0]), difference, what])
        name = ""
    return found


def page(revision, before, after):
    lines = ["### flexframe: masses and margins", ""]
    table = [row for asked in sorted(before | after) for row in rows(asked, before.get(asked), after.get(asked))]
    if table:
        lines += [f"| frame | | {plain(revision)} | now | change | |", "|---|---|---:|---:|---:|---|"]
        lines += [f"| {' | '.join(row)} |" for row in table]
    else:
        lines.append(f"No mass and no margin of {len(after)} frames differs from {plain(revision)}.")
    return "\n".join(lines)


def refuse(why):
    print(f"changes.py: {why}", file=sys.stderr)
    sys.exit(2)


def main(revision):
    commit = git("rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}").stdout.strip()
    if not commit:
        refuse(f"there is no revision {revision} to compare with; a shallow clone does not contain it")
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "base"
        added = git("worktree", "add", "--quiet", "--detach", str(tree), commit)
        if added.returncode:
            refuse(added.stderr.strip())
        try:
            inside = tree / git("rev-parse", "--show-prefix").stdout.strip()
            before = checked(inside) if inside.is_dir() else {}
        finally:
            git("worktree", "remove", "--force", str(tree))
    print(page(revision, before, checked(Path())))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
