"""sbom.py FILE: writes a software bill of materials (CycloneDX 1.6, JSON) of the program of this source tree.

It lists every crate that the program is compiled with on any of the platforms of dist-workspace.toml, with version, licence and
the checksum of Cargo.lock, and which crate uses which. It has no time and no random number: the same Cargo.lock gives the same bytes.
"""
import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def metadata():
    command = ["cargo", "metadata", "--format-version", "1", "--locked"]
    for target in tomllib.loads((ROOT / "dist-workspace.toml").read_text())["dist"]["targets"]:
        command += ["--filter-platform", target]
    if os.environ.get("CARGO_NET_OFFLINE") == "true":
        command.append("--offline")
    return json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout)


def purl(package):
    return f"pkg:cargo/{package['name']}@{package['version']}"


def uses(node):
    """The packages that a package is compiled with: not those of its tests, and not those of its build script."""
    return [to["pkg"] for to in node["deps"] if any(kind["kind"] is None for kind in to["dep_kinds"])]


def reached(root, nodes):
    found, ahead = set(), [root]
    while ahead:
        package = ahead.pop()
        if package not in found:
            found.add(package)
            ahead += uses(nodes[package])
    return found


def licences(package):
    """An expression of SPDX; Cargo also takes the older way with a slash."""
    expression = package["license"]
    if expression:
        return [{"expression": expression.replace("/", " OR ")}]
    return [{"license": {"name": f"see {package['license_file']}"}}] if package["license_file"] else []


def component(package, checksums):
    entry = {"type": "library", "bom-ref": purl(package), "name": package["name"], "version": package["version"]}
    if package["description"]:
        entry["description"] = " ".join(package["description"].split())
    checksum = checksums.get((package["name"], package["version"]))
    if checksum:
        entry["hashes"] = [{"alg": "SHA-256", "content": checksum}]
    entry["licenses"] = licences(package)
    entry["purl"] = purl(package)
    if package["repository"]:
        entry["externalReferences"] = [{"type": "vcs", "url": package["repository"]}]
    return entry


def bill(found):
    lock = tomllib.loads((ROOT / "Cargo.lock").read_text())
    checksums = {(entry["name"], entry["version"]): entry.get("checksum") for entry in lock["package"]}
    packages = {package["id"]: package for package in found["packages"]}
    nodes = {node["id"]: node for node in found["resolve"]["nodes"]}
    root = found["resolve"]["root"]
    order = sorted(reached(root, nodes), key=lambda package: purl(packages[package]))
    return {
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": {**component(packages[root], checksums), "type": "application"}},
        "components": [component(packages[package], checksums) for package in order if package != root],
        "dependencies": [
            {"ref": purl(packages[package]), "dependsOn": sorted({purl(packages[of]) for of in uses(nodes[package])})} for package in order
        ],
    }


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    Path(sys.argv[1]).write_text(json.dumps(bill(metadata()), indent=2) + "\n")
