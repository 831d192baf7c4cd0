"""gallery.py PROGRAM: writes docs/gallery.md from what PROGRAM says of the frames in examples/frames/.

    python3 examples/gallery.py target/release/flexframe              # the page
    python3 examples/gallery.py --pictures target/release/flexframe   # and the pictures, with Pillow
    python3 examples/gallery.py --check target/release/flexframe      # builds and checks every frame, compares the page

With --check nothing is written into the source tree: one line a frame and one for the page, exit code 1 when one of them fails.
Page and check need the standard library only. Figures are rounded, so that a change too small to matter does not change the page.
"""

import argparse
import difflib
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FRAMES = ROOT / "examples" / "frames"
PAGE = ROOT / "docs" / "gallery.md"
PICTURES = ROOT / "docs" / "pictures" / "gallery"
PICTURE_WIDTH = 640
PICTURE_COLOURS = 96

# The rules whose margins differ from frame to frame; the others compare parts that every frame has.
MARGINS = {
    "envelope": "size",
    "mass_budget": "mass",
    "propeller_clearance": "propellers' clearance",
    "ground_clearance": "ground clearance",
    "centre_of_mass": "centre of mass",
    "hinge_strain": "strain of the folded hinges",
    "thinnest_wall": "thinnest wall",
    "design_drop": "design drop",
}
NARROWEST = 3

HEAD = """# Gallery

Seven frames for electronics that people fly, in [`examples/frames/`](../examples/frames/): five under 250 g and two under 500 g. Each
file says for whom it is, what is on board, and where size and mass of each bought part come from. What no source was found for is
marked as an estimate there, and in the frame's report. Cameras for goggles and GPS modules lie on the
[accessory plate](frame-files.md#accessories) where a frame names them in `[bought]`; what stands in `[extras]`, such as video
transmitters, is counted as a mass, and neither drawn nor checked against what is near. No frame of this page was built and flown.

```console
flexframe check examples/frames/pi-zero-2w.toml     # its limits
flexframe build examples/frames/pi-zero-2w.toml     # its files, into out/pi-zero-2w/
```

`python3 examples/gallery.py PROGRAM` writes this page from what the program says, and with `--pictures` the pictures, too (that
needs Pillow). `tests/all.sh` builds and checks each frame, and compares this page with the program.

Size is without propellers; budget and envelope are the frame's limits. A margin is the distance to its limit, and the narrowest
are named with what is left of it. The design drop is from 1 m onto the lower ring, by the frame's own mechanics with the band that
[mechanics](mechanics.md) states; its peak is that of the payload. Printing hours are
those of `flexframe bom`, an estimate ([printing](printing.md#time)).
"""


def said(program, *words):
    """What the program prints as JSON."""
    done = subprocess.run([program, *words, "--json"], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"{' '.join(words)}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def rounded(value, digits=2):
    """To so many leading digits, without an exponent: 148.77 to 150, 3.474 to 3.5."""
    return f"{float(f'{value:.{digits}g}'):g}"


def share(finding):
    """What is left of a limit, as a part of it."""
    return finding["margin"] / abs(finding["limit"])


def narrowest(findings):
    """The narrowest margin of each rule in MARGINS, and of these the narrowest few."""
    least = {}
    for finding in findings:
        if finding["rule"] in MARGINS and finding["verdict"] != "note" and finding["limit"]:
            known = least.get(finding["rule"])
            if known is None or share(finding) < share(known):
                least[finding["rule"]] = finding
    return sorted(least.values(), key=share)[:NARROWEST]


def margin(finding):
    """In the words of the page."""
    left = f"{rounded(finding['margin'])} {finding['unit']}".strip()
    return f"{MARGINS[finding['rule']]} {left} ({rounded(100 * share(finding))} %)"


def bought(lines, role):
    """The name of the catalogue's, or the file's, part in a role."""
    names = [line["name"] for line in lines if line["role"] == role]
    return f"`{names[0]}`" if names else "none"


def section(program, frame):
    """Heading, picture and table of one frame."""
    check = said(program, "check", str(frame), "--strength")["frames"][0]
    bom = said(program, "bom", str(frame))
    findings = {finding["subject"]: finding for finding in check["findings"]}
    size = [findings[f"{axis} without propellers"] for axis in ("width", "depth", "height")]
    mass, peak = findings["take-off mass"], findings["payload"]
    rows = {
        "take-off mass": f"{mass['value']:.0f} g, of which {check['masses']['estimated_g']:.0f} g are estimates",
        "budget": f"{mass['limit']:.0f} g",
        "size": " x ".join(f"{axis['value']:.0f}" for axis in size) + " mm",
        "envelope": " x ".join(f"{axis['limit']:.0f}" for axis in size) + " mm",
        "propeller": bought(bom["buy"], "propeller"),
        "motor": bought(bom["buy"], "motor"),
        "battery": bought(bom["buy"], "battery"),
        "rods": bought(bom["buy"], "rod"),
        "narrowest margins": "; ".join(margin(finding) for finding in narrowest(check["findings"])),
        "peak of the design drop": f"{peak['value']:.0f} g, of {peak['limit']:.0f} g allowed",
        "printing": f"{bom['printed_g']:.0f} g, {bom['print_h']:.0f} h",
    }
    name = frame.stem
    lines = [f"## {name}", "", f"[{name}.toml](../examples/frames/{name}.toml): {description(program, frame)}.", ""]
    lines += [f"![{name}, assembled](pictures/gallery/{name}.png)", "", "| | |", "|---|---|"]
    return "\n".join(lines + [f"| {what} | {value} |" for what, value in rows.items()]) + "\n"


def description(program, frame):
    """The file's own, as the manifest has it."""
    with tempfile.TemporaryDirectory() as folder:
        return said(program, "build", str(frame), "--no-pictures", "-o", folder)["description"]


def page(program, frames):
    """The whole page."""
    return "\n".join([HEAD] + [section(program, frame) for frame in frames])


def draw(program, frame):
    """The frame's picture, small and with few colours."""
    from PIL import Image  # only here: nothing else needs more than the standard library

    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "render", str(frame), "-q", "-o", folder], check=True)
        with Image.open(pathlib.Path(folder) / f"{frame.stem}-pictures" / "assembled_perspective.png") as drawn:
            size = (PICTURE_WIDTH, round(drawn.height * PICTURE_WIDTH / drawn.width))
            small = drawn.convert("RGB").resize(size, Image.Resampling.LANCZOS)
    small.quantize(PICTURE_COLOURS, dither=Image.Dither.NONE).save(PICTURES / f"{frame.stem}.png", optimize=True)


def holds(program, frame):
    """One line: whether the frame builds, keeps its limits and has its picture."""
    with tempfile.TemporaryDirectory() as folder:
        for words in (["build", str(frame), "--no-pictures", "-q", "-o", folder], ["check", str(frame), "--strength", "-q"]):
            done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
            if done.returncode != 0:
                return f"FAILED gallery {frame.stem}: {words[0]} has exit code {done.returncode}: {done.stderr.strip()}"
    if not (PICTURES / f"{frame.stem}.png").is_file():
        return f"FAILED gallery {frame.stem}: no picture in {PICTURES}"
    return f"ok gallery {frame.stem}"


def compared(text):
    """One line for the page; what differs goes to the error stream."""
    kept = PAGE.read_text(encoding="utf-8") if PAGE.is_file() else ""
    if kept == text:
        return "ok gallery page"
    sys.stderr.writelines(difflib.unified_diff(kept.splitlines(True), text.splitlines(True), str(PAGE), "the program"))
    return "FAILED gallery page: docs/gallery.md is out of date: python3 examples/gallery.py PROGRAM"


def main():
    """Reads the command line."""
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("program", help="flexframe")
    words.add_argument("--check", action="store_true", help="compare, write nothing")
    words.add_argument("--pictures", action="store_true", help="draw the pictures, too")
    asked = words.parse_args()
    program = str(pathlib.Path(asked.program).resolve())
    frames = sorted(FRAMES.glob("*.toml"))
    if asked.check:
        lines = [holds(program, frame) for frame in frames]
        if not any(line.startswith("FAILED") for line in lines):
            lines.append(compared(page(program, frames)))
        print("\n".join(lines), flush=True)
        sys.exit(any(line.startswith("FAILED") for line in lines))
    if asked.pictures:
        PICTURES.mkdir(parents=True, exist_ok=True)
        for frame in frames:
            draw(program, frame)
    PAGE.write_text(page(program, frames), encoding="utf-8")


if __name__ == "__main__":
    main()
