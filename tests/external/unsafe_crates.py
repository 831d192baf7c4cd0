"""unsafe_crates.py [PAGE]: lists the crates of the program whose sources have `unsafe` code, as rows of Markdown: crate, number of
`unsafe` blocks, functions and implementations.

With PAGE (docs/dependencies.md), checks that its tables name exactly those crates; one line a result. A crate is counted for every
platform whose sources are here. Macros that write `unsafe` elsewhere, and C code, are not seen; the program links to none.
"""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/ci"))
import sbom  # noqa: E402: the crates that the program is compiled with

# Comments, texts and characters; `unsafe` in them is none.
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|r(#*)".*?"\1|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'', re.DOTALL)


def count(folder):
    """How often `unsafe` stands in the library's sources and in its build script."""
    files = [*(folder / "src").rglob("*.rs"), *folder.glob("build.rs")]
    tested = [path for path in files if "tests" not in path.relative_to(folder).parts and path.name != "tests.rs"]
    return sum(len(re.findall(r"\bunsafe\b", NOT_CODE.sub(" ", path.read_text(errors="replace")))) for path in tested)


def crates():
    """Name to count of each crate of the program; versions of one crate are added."""
    found = sbom.metadata()
    nodes = {node["id"]: node for node in found["resolve"]["nodes"]}
    reached = sbom.reached(found["resolve"]["root"], nodes)
    counts = {}
    for package in found["packages"]:
        folder = Path(package["manifest_path"]).parent
        if package["id"] in reached and folder.is_dir():
            counts[package["name"]] = counts.get(package["name"], 0) + count(folder)
    return counts


def main():
    counts = crates()
    unsafe = {name for name, number in counts.items() if number}
    if len(sys.argv) < 2:
        for name in sorted(unsafe):
            print(f"| `{name}` | {counts[name]} |")
        return
    named = re.findall(r"^\| `([\w-]+)` \|", Path(sys.argv[1]).read_text(), re.MULTILINE)
    # Without a network the sources of other platforms may not be here: of them nothing is said.
    missing, extra = sorted(unsafe - set(named)), sorted(name for name in named if counts.get(name) == 0)
    right = not missing and not extra and len(named) == len(set(named)) and len(unsafe) > 20
    print(f"ok every one of {len(unsafe)} crates with unsafe code has its note" if right
          else f"FAILED notes on crates with unsafe code: without a note {missing}, without unsafe code {extra}")


main()
