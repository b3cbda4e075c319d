#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests ranks on several hosts that share no memory and communicate over TCP (scripts/hosts_here.sh).

They write the same file as one rank. The test is skipped, with the reason, if network namespaces are forbidden, or if
the MPI is not Open MPI.
"""
import re
import subprocess
import unittest

import h5py

from trime_run import MPIEXEC, PROGRAM, ROOT, Workspace, run, users_environment

HOSTS = ROOT / "scripts" / "hosts_here.sh"
CONFIG = ROOT / "configs" / "spade.ini"  # has a hole, tips and a clean-up
POINTS = "meshing.points=1500"
NO_NAMESPACES = 77


def on_hosts(hosts, *command, timeout=120):
    return subprocess.run([str(part) for part in (HOSTS, hosts, *command)], env=users_environment(1),
                          capture_output=True, text=True, timeout=timeout, check=False)


class Hosts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        version = subprocess.run([MPIEXEC, "--version"], capture_output=True, text=True, check=True).stdout
        if "Open MPI" not in version and "OpenRTE" not in version:  # mpiexec has the name of its layer
            raise unittest.SkipTest(f"{MPIEXEC} is not Open MPI's, and hosts_here.sh steers no other")
        probe = on_hosts(2, "true")
        if probe.returncode == NO_NAMESPACES:
            raise unittest.SkipTest(probe.stderr.strip())
        assert probe.returncode == 0, probe.stderr
        workspace = Workspace()
        cls.work = workspace.__enter__()
        cls.addClassCleanup(workspace.__exit__)
        done = run(CONFIG, POINTS, f"output.directory={cls.work}", "output.name=alone")
        assert done.returncode == 0, done.stdout + done.stderr

    def check_case(self, hosts, ranks):
        name = f"hosts{hosts}ranks{ranks}"
        done = on_hosts(hosts, MPIEXEC, "-np", ranks, PROGRAM, CONFIG, POINTS, f"output.directory={self.work}",
                        f"output.name={name}")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(f"{ranks} ranks x 1 thread on {hosts} nodes", done.stdout)
        with h5py.File(self.work / "alone.h5") as alone, h5py.File(self.work / f"{name}.h5") as file:
            self.assertEqual(file["trime_mpi"].attrs["mpi_ranks"], ranks)
            self.assertEqual(file["trime_mpi"].attrs["mesh_hash"], alone["trime_mpi"].attrs["mesh_hash"])
            bytes_of_messages = int(file["trime_mpi/timers/bytes"][:].sum())
        difference = subprocess.run(["h5diff", "--exclude-path", "/trime_mpi", self.work / "alone.h5",
                                     self.work / f"{name}.h5"], capture_output=True, text=True, check=False)
        self.assertEqual(difference.returncode, 0, difference.stdout[:2000] + difference.stderr)
        traffic = re.findall(r"^host\d+: (\d+) bytes sent, (\d+) received$", done.stderr, re.MULTILINE)
        self.assertEqual(len(traffic), hosts, done.stderr)
        return [int(sent) for sent, _ in traffic], [int(received) for _, received in traffic], bytes_of_messages

    def test_a_rank_on_each_host(self):
        """All messages cross the cables, so more bytes do than the program sends."""
        for hosts in (2, 4):
            with self.subTest(hosts=hosts):
                sent, received, messages = self.check_case(hosts, hosts)
                self.assertGreater(messages, 100_000)
                self.assertGreater(sum(sent), messages)
                self.assertGreater(sum(received), messages)
                self.assertGreater(min(sent + received), messages / hosts / 4)

    def test_two_ranks_on_each_host(self):
        sent, _, messages = self.check_case(2, 4)
        self.assertGreater(sum(sent), messages / 4)

    def test_exit_code(self):
        done = on_hosts(2, MPIEXEC, "-np", 2, PROGRAM, CONFIG, "meshing.points=few", f"output.directory={self.work}")
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)

    def test_nothing_is_left(self):
        """Whatever ends the script: no process of the hosts goes on, and so no host."""
        for way in ("terminate", "kill"):
            with self.subTest(way=way), subprocess.Popen([HOSTS, "2", "sh", "-c", "echo ready; exec sleep 600"],
                                                         stdout=subprocess.PIPE, text=True) as script:
                self.assertEqual(script.stdout.readline(), "ready\n")
                getattr(script, way)()
                # The pipe closes when the last process that holds it is gone.
                self.assertEqual(script.communicate(timeout=20)[0], "")

    def test_usage(self):
        for arguments in ([""], ["0", "true"], ["2"], ["many", "true"], ["251", "true"]):
            with self.subTest(arguments=arguments):
                done = on_hosts(*arguments)
                self.assertEqual(done.returncode, 2)
                self.assertIn("hosts_here.sh N COMMAND", done.stderr)


if __name__ == "__main__":
    unittest.main()
