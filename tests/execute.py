# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the program for the scripts of the tests: one environment, one way to end what does not end by itself."""

import os
import signal
import subprocess
import tempfile

# One thread a rank; Open MPI may run as root (containers), and a program alone starts no daemon and looks for no network,
# which takes longer than most of these runs.
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_pml": "ob1"}


def environment(temporary=None):
    """The variables of a run, with a folder of its own in which Open MPI keeps its sessions.

    Runs side by side must not share it: one that ends removes what another is about to use.
    """
    own = {"TMPDIR": str(temporary)} if temporary else {}
    return {**ENVIRONMENT, **os.environ, **own}


def start(command, folder, temporary, **more):
    """Starts a command in a folder; the caller waits for it and removes the temporary folder afterwards."""
    return subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            start_new_session=True, env=environment(temporary), **more)


def execute(command, folder=None, seconds=300, **more):
    """(exit status, stdout, stderr) of a command; the status is None when the time is over."""
    with tempfile.TemporaryDirectory(prefix="perideal-", ignore_cleanup_errors=True) as temporary:
        process = start(command, folder, temporary, **more)
        try:
            out, err = process.communicate(timeout=seconds)
            status = process.returncode
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)  # the group of our own child: mpirun and its ranks
            out, err = process.communicate()
            status = None
    return status, out.decode(errors="replace"), err.decode(errors="replace")
