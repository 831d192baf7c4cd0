"""Submits the blocks of a study to a running HyperQueue server, and waits for them.

Arguments: the job's name, a file with a block a line, and the command of a task, which reads its block from HQ_ENTRY.

Exit codes: NO_MODULE, NO_SERVER, and 1 when tasks failed or the server went away; flexframe tells the first two itself."""
import os
import sys

NO_MODULE, NO_SERVER = 67, 68

try:
    from hyperqueue import Client, Job
    from hyperqueue.client import FailedJobsException
except ImportError:
    sys.exit(NO_MODULE)

name, entries, *command = sys.argv[1:]
job = Job(name=name, max_fails=None)
with open(entries, encoding="utf-8") as blocks:
    for block in blocks:
        env = {"HQ_ENTRY": block.strip(), "RAYON_NUM_THREADS": "1"}
        job.program(command, env=env, stdout=None, stderr=None)
try:
    client = Client(os.environ.get("HQ_SERVER_DIR"))
except Exception:  # The module has no class of its own for it.
    sys.exit(NO_SERVER)
try:
    client.wait_for_jobs([client.submit(job)])
except FailedJobsException as error:
    sys.exit(str(error))
except Exception as error:  # As above: the server went away. What follows the first line is where in HyperQueue that was seen.
    sys.exit(f"HyperQueue: {error}".splitlines()[0])
except KeyboardInterrupt:
    sys.exit(130)
