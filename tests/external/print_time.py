"""print_time.py BUILT GCODES WORK FRAME...: times that print-settings.md states beside those of PrusaSlicer, one line a plate.

BUILT has the frames of `build`, GCODES the plates of each FRAME as `slice_plate.sh` sliced them. The plates of the default frame are
sliced for two more printers: as quick and as slow as those of `params/printers` get, by the machine limits and profiles that
PrusaSlicer 2.5 has for the Original Prusa i3 MK3 and the Creality Ender-3.
"""

import re
import subprocess
import sys
from pathlib import Path

# As docs/printing.md and the pages themselves promise.
WITHIN = 0.15

PRINTERS = {
    "mk3": ["machine_max_acceleration_extruding=1250", "machine_max_acceleration_x=1000", "machine_max_acceleration_y=1000",
            "default_acceleration=1000", "perimeter_acceleration=800", "machine_max_jerk_x=8", "machine_max_jerk_y=8",
            "retract_length=0.8", "retract_speed=35", "retract_lift=0.2", "travel_speed=180", "first_layer_speed=20"],
    "ender-3": ["machine_max_acceleration_extruding=500", "machine_max_acceleration_travel=500", "machine_max_acceleration_x=500",
                "machine_max_acceleration_y=500", "machine_max_jerk_x=8", "machine_max_jerk_y=8", "retract_length=5",
                "retract_speed=60", "travel_speed=150", "first_layer_speed=20"],
}


def stated(folder):
    """Seconds and the spool's flow of each plate, by print-settings.md."""
    text = (folder / "print-settings.md").read_text()
    plates = {}
    for section in text.split("\n## ")[1:]:
        flow = re.search(r"\| ([0-9.]+) \| `filament_max_volumetric_speed`", section).group(1)
        for name, hours, minutes in re.findall(r"\| `plates/(\S+)\.3mf` \|.*\| (\d+) h (\d+) min \|", section):
            plates[name] = (3600 * int(hours) + 60 * int(minutes), flow)
    return plates


def sliced(gcode):
    words = re.search(r"estimated printing time \(normal mode\) = (.+)", gcode.read_text()).group(1)
    return sum(int(number) * {"d": 86400, "h": 3600, "m": 60, "s": 1}[unit] for number, unit in re.findall(r"(\d+)([dhms])", words))


def line(name, ours, theirs):
    off = ours / theirs - 1
    told = f"print time {name}: {ours / 3600:.2f} h, PrusaSlicer {theirs / 3600:.2f} h, {100 * off:+.1f} %"
    return f"ok {told}" if abs(off) <= WITHIN else f"FAILED {told}"


def main(built, gcodes, work, *frames):
    built, gcodes, work = Path(built), Path(gcodes), Path(work)
    work.mkdir(parents=True, exist_ok=True)
    for folder in sorted(path.parent for path in built.glob("*/print-settings.md")):
        plates = stated(folder)
        if set(plates) != {path.stem for path in (folder / "plates").glob("*.3mf")}:
            print(f"FAILED print time {folder.name}: print-settings.md has no time of a plate: {sorted(plates)}")
        for name, (seconds, _) in plates.items() if folder.name in frames else ():
            print(line(f"{folder.name} {name}", seconds, sliced(gcodes / f"{folder.name}-{name}.gcode")))
    for printer, settings in PRINTERS.items():
        profile = work / f"{printer}.ini"
        profile.write_text("".join(f"{setting.replace('=', ' = ')}\n" for setting in settings))
        for name, (seconds, flow) in stated(built / "cognifly").items():
            gcode = work / f"{printer}-{name}.gcode"
            subprocess.run(
                ["prusa-slicer", "--load", profile, "--filament-max-volumetric-speed", flow, "--bed-shape", "0x0,400x0,400x400,0x400",
                 "--export-gcode", "--output", gcode, built / "cognifly" / "plates" / f"{name}.3mf"],
                check=True, capture_output=True)
            print(line(f"cognifly {name} on {printer}", seconds, sliced(gcode)), flush=True)


main(*sys.argv[1:])
