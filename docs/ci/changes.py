"""changes.py BASE: prints a Markdown table of the masses and margins that changed since the revision BASE.

Variables: FLEXFRAME, the program, FRAMES, files or patterns separated by spaces, STRICT, and BASELINE, a list of accepted findings, as in
gate.sh. The frames are checked in
the work tree and in a checkout of BASE. A margin is the smallest of a rule's findings: how far the worst of them is from its limit;
it is negative where the limit is violated. What warns in one of the two has a row of its own, so that it is compared with itself, and
does not hide the rule's other findings. Exit code: 0, or 2 when there is no such revision. What could not be checked has a row that says why.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FLEXFRAME = os.environ.get("FLEXFRAME", "flexframe")
FRAMES = [pattern.removeprefix(f"{Path.cwd()}/") for pattern in (os.environ.get("FRAMES") or "frames/*.toml").split()]
STRICT = os.environ.get("STRICT") == "true"
BASELINE = os.environ.get("BASELINE")

# How a quantity stands to its limit, from good to bad.
KEPT, WARNS, ACCEPTED, VIOLATED = range(4)


def git(*arguments):
    return subprocess.run(["git", *arguments], capture_output=True, text=True)


# A space without width: behind an @, and within what a forge makes a link of.
APART = "\u200b"


def plain(text):
    """Text of a frame file as text of a table's cell: nothing in it is markup, a link or a mention."""
    line = re.sub(r"@|:(?=//)|(?<=\bwww)(?=\.)", lambda sign: sign[0] + APART, " ".join(str(text).split()))
    return re.sub(rf"[^\w .,:+/{APART}-]|_", lambda sign: f"&#{ord(sign[0])};", line)


def listed(folder):
    """Options that judge a folder by the list of the work tree. A list names files by the way from its own folder, so that of another checkout is a copy
    in the same place."""
    if not BASELINE:
        return []
    own = Path(BASELINE).absolute()
    if folder == Path() or not own.is_file():
        return ["--baseline", str(own)]
    way = os.path.relpath(own)
    # A list outside of this folder is none of the revision's files.
    if way.startswith(os.pardir):
        return ["--baseline", str(own)]
    copy = folder / way
    copy.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(own, copy)
    return ["--baseline", str(copy)]


def checked(folder):
    """The frames of a folder by the name they were asked for, a pattern that matches nothing gives none; and by pattern why nothing was checked."""
    frames, reasons = {}, {}
    options = listed(folder)
    for pattern in FRAMES:
        done = subprocess.run([FLEXFRAME, "check", "--json", *options, "--", pattern], cwd=folder, capture_output=True, text=True)
        report = json.loads(done.stdout) if done.stdout else {}
        frames.update((frame["asked"], frame) for frame in report.get("frames", []))
        if "frames" not in report:
            reasons[pattern] = report.get("error", {}).get("message") or done.stderr.strip()
    return frames, reasons


def standing(finding):
    """A note has no limit to keep; beyond its figure it is a warning, which fails in strict mode. What is accepted does not fail."""
    if finding.get("accepted"):
        return ACCEPTED
    if finding["verdict"] != "note":
        return KEPT if finding["verdict"] == "holds" else VIOLATED
    if finding["margin"] is None or finding["margin"] >= 0:
        return KEPT
    return VIOLATED if STRICT else WARNS


def subject(finding):
    return finding["rule"], finding["subject"], finding["unit"]


def warned(frame):
    """The subjects of a frame's warnings."""
    beyond = (f for f in frame["findings"] if f["verdict"] == "note" and standing(f) != KEPT)
    return {subject(finding) for finding in beyond}


def quantities(frame, alone):
    """Quantity to (value, standing): the mass, g, and the smallest margin of each rule and unit; subjects in `alone` have their own."""
    found = {"take-off mass, g": (frame["masses"]["total_g"], KEPT)}
    for finding in frame["findings"]:
        own = subject(finding) in alone
        if finding["margin"] is None or finding["verdict"] == "note" and not own:
            continue
        unit = f", {finding['unit']}" if finding["unit"] else ""
        name = f"margin of {finding['rule']}{': ' + plain(finding['subject']) if own else ''}{unit}"
        margin, worst = found.get(name, (float("inf"), KEPT))
        found[name] = (min(margin, finding["margin"]), max(worst, standing(finding)))
    return found


def number(value):
    """Two decimals; what rounds to nothing has no sign."""
    return "" if value is None else f"{value:.2f}".replace("-0.00", "0.00")


def change(name, before, after):
    """What is to be said of a quantity: more mass and less margin are worse."""
    if after[1] == VIOLATED:
        return "limit violated"
    if after[1] == ACCEPTED:
        return "limit violated, accepted"
    if after[1] == WARNS:
        return "still warns" if before[1] == WARNS else "warns now"
    if before[1] == WARNS:
        return "warned before"
    if before[0] is None or after[0] is None:
        return "new" if before[0] is None else "gone"
    if before[1] in (ACCEPTED, VIOLATED):
        return "limit kept again"
    worse = (after[0] > before[0]) == name.startswith("take-off mass")
    return "worse" if worse else "better"


def rows(asked, before, after):
    """The table's rows of one frame, none when nothing of it changed."""
    name = f"`{asked}`" if re.fullmatch(r"[\w ./+-]+", asked) else plain(asked)
    if after is None:
        return [[name, "", "", "", "", "removed"]]
    if "refused" in after:
        return [[name, plain(after["refused"]), "", "", "", "refused"]]
    if before is None or "refused" in before:
        now = quantities(after, warned(after))
        violated = sum(state == VIOLATED for _, state in now.values())
        mass = now["take-off mass, g"][0]
        return [[name, "take-off mass, g", "", number(mass), "", f"new; limits violated: {violated}"]]
    alone = warned(before) | warned(after)
    former, now = quantities(before, alone), quantities(after, alone)
    found = []
    for quantity in former | now:
        was, is_now = former.get(quantity, (None, KEPT)), now.get(quantity, (None, KEPT))
        if (number(was[0]), was[1]) == (number(is_now[0]), is_now[1]):
            continue
        known = was[0] is not None and is_now[0] is not None
        difference = f"{is_now[0] - was[0]:+.2f}" if known else ""
        found.append([name, quantity, number(was[0]), number(is_now[0]), difference, change(quantity, was, is_now)])
        name = ""
    return found


def page(revision, before, after, reasons):
    lines = ["### flexframe: masses and margins", ""]
    table = [row for asked in sorted(before | after) for row in rows(asked, before.get(asked), after.get(asked))]
    table += [[plain(pattern), plain(reason), "", "", "", "not checked"] for pattern, reason in reasons.items()]
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
    top = git("rev-parse", "--show-toplevel")
    if top.returncode:
        refuse(top.stderr.strip())
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
            before = checked(inside)[0] if inside.is_dir() else {}
        finally:
            git("worktree", "remove", "--force", str(tree))
    print(page(revision, before, *checked(Path())))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
