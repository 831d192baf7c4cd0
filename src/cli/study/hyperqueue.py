"""Submits the blocks of a study to a running HyperQueue server, and waits for them.

Arguments: the job's name, a file with a block a line, and the command of a task, which reads its block from HQ_ENTRY."""
import os
import sys

try:
    from hyperqueue import Client, Job
    from hyperqueue.client import FailedJobsException
except ImportError:
    sys.exit("the program `hq` is not there, and Python has no module `hyperqueue`: pip install hyperqueue")

name, entries, *command = sys.argv[1:]
job = Job(name=name, max_fails=None)
with open(entries, encoding="utf-8") as blocks:
    for block in blocks:
        env = {"HQ_ENTRY": block.strip(), "RAYON_NUM_THREADS": "1"}
        job.program(command, env=env, stdout=None, stderr=None)
client = Client(os.environ.get("HQ_SERVER_DIR"))
try:
    client.wait_for_jobs([client.submit(job)])
except FailedJobsException as error:
    sys.exit(str(error))
