"""weighed.py WEIGHED.json: whether a slicer fills each part with its volume: one line a part.

Within 3 %, or within 3 % when infill ends at the walls: what it reaches over them is counted twice.
"""

import json
import sys

MASS_RATIO = 0.03

for part in json.load(open(sys.argv[1]))["parts"]:
    off = part["sliced_over_solid"] - 1
    bare = part["sliced_over_solid_without_overlap"]
    agrees = abs(off) <= MASS_RATIO or bare is not None and abs(bare - 1) <= MASS_RATIO
    why = f", {100 * (bare - 1):+.1f} % without overlap" if bare is not None else ""
    print(f"{'ok' if agrees else 'FAILED'} weighed {part['part']}: {100 * off:+.1f} %{why}", flush=True)
