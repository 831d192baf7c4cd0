"""check_reports.py BINARY SCHEMA WORK: JUnit and SARIF of `flexframe check`, read by other people's software."""
import json
import subprocess
import sys
from pathlib import Path

import jsonschema
from junitparser import Error, Failure, JUnitXml, Skipped

BINARY, SCHEMA, WORK = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])


def result(name, good, why=""):
    print(f"ok {name}" if good else f"FAILED {name}: {why}", flush=True)


def check(form, *more):
    return subprocess.run([BINARY, "check", "--format", form, *more], capture_output=True, text=True).stdout


def main():
    odd = WORK / "odd <&>\".toml"
    odd.write_text('base = "cognifly"\nname = "odd"\n[limits]\nmass_budget_g = 100.0\n')
    wrong = WORK / "wrong.toml"
    wrong.write_text('base = "cognifly"\n[rods]\nlength = "é <&"\n')
    frames = ["cognifly", "cognifly-v8", str(odd), str(wrong)]

    report = JUnitXml.fromstring(check("junit", *frames).encode())
    suites = {suite.name: suite for suite in report}
    kinds = {name: [type(outcome) for case in suite for outcome in case.result] for name, suite in suites.items()}
    result("junitparser: a suite a frame", list(suites) == ["cognifly", "cognifly-v8", "odd", str(wrong)], str(list(suites)))
    result("junitparser: the default passes", kinds["cognifly"] == [] and 15 <= suites["cognifly"].tests <= 25, str(kinds["cognifly"]))
    result("junitparser: v8 fails", Failure in kinds["cognifly-v8"] and suites["cognifly-v8"].failures == len(kinds["cognifly-v8"]), str(kinds["cognifly-v8"]))
    result("junitparser: what does not read is an error", kinds[str(wrong)] == [Error], str(kinds[str(wrong)]))

    accepted = WORK / "accepted.json"
    accepted.unlink(missing_ok=True)
    subprocess.run([BINARY, "check", "-q", "--baseline", accepted, "--update-baseline", "cognifly-v8"], check=True)
    report = JUnitXml.fromstring(check("junit", "--baseline", str(accepted), "cognifly-v8").encode())
    kinds = [type(outcome) for suite in report for case in suite for outcome in case.result]
    result("junitparser: accepted findings are skipped", set(kinds) == {Skipped}, str(kinds))

    schema = json.loads(SCHEMA.read_text())
    validator = jsonschema.validators.validator_for(schema)(schema)
    for name, more in (("every kind of frame", frames), ("accepted findings", ["--baseline", str(accepted), "cognifly-v8"]), ("strict", ["--strict", "cognifly"])):
        log = json.loads(check("sarif", *more))
        faults = [error.message for error in validator.iter_errors(log)]
        result(f"SARIF schema: {name}", not faults and log["runs"][0]["results"], str(faults))
    result("SARIF schema: finds a fault", list(validator.iter_errors({"version": "2.1.0", "runs": [{}]})), "accepts a run without a tool")


main()
