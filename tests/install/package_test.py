#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the Debian package of a build tree, and reads what it contains. Other packagings must name the same version.

Usage: package_test.py BUILD
"""
import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGING = ROOT / "scripts" / "packaging"
MODULES = pathlib.Path("/usr/share/modules/init/bash")
BUILD = pathlib.Path(sys.argv.pop(1) if len(sys.argv) > 1 else ROOT / "build" / "ci")


def output(*command):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=True,
                          timeout=120).stdout


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps"):
            if not shutil.which(tool):
                raise unittest.SkipTest(f"no {tool} here")
        cls.work = pathlib.Path(tempfile.mkdtemp(prefix="trime-package-"))
        cls.addClassCleanup(shutil.rmtree, cls.work, ignore_errors=True)
        output("cpack", "-G", "DEB", "-B", cls.work, "--config", BUILD / "CPackConfig.cmake")
        cls.deb = next(cls.work.glob("*.deb"))
        output("dpkg-deb", "-x", cls.deb, cls.work / "root")

    def test_files(self):
        usr = self.work / "root" / "usr"
        for name in ("bin/trime_mpi", "lib/libtrime.a", "lib/cmake/trime_mpi/trime_mpiConfig.cmake",
                     "include/trime/meshing/mesher.hpp", "share/doc/trime-mpi/copyright",
                     "share/trime_mpi/jobs/common.sh", "share/trime_mpi/examples/04_solver.cpp",
                     "lib/python3/dist-packages/trime_mpi/__init__.py"):
            self.assertTrue((usr / name).is_file(), name)
        if "TRIME_BUILD_CHECK:BOOL=OFF" not in (BUILD / "CMakeCache.txt").read_text(encoding="utf-8"):
            self.assertTrue((usr / "bin/trime_check").is_file())
        for folder in ("configs", "jobs"):
            self.assertEqual({path.name for path in (usr / "share" / "trime_mpi" / folder).iterdir()},
                             {path.name for path in (ROOT / folder).iterdir()})

    def test_picture_by_the_installed_script(self):
        """The script finds the package next to it, without a source tree."""
        script = self.work / "root" / "usr" / "share" / "trime_mpi" / "scripts" / "plot_mesh.py"
        self.assertIn("history", output("/usr/bin/python3", script, "--help"))

    def test_dependencies(self):
        needed = output("dpkg-deb", "-f", self.deb, "Depends")
        for package in ("openmpi-bin", "libopenmpi3", "libhdf5-openmpi-103", "libfmt9", "libmuparser2v5", "libproj25",
                        "libshp2"):
            self.assertIn(package, needed)
        self.assertNotIn("-dev", needed)

    def test_program_runs_from_the_package(self):
        self.assertIn("trime_mpi 0.", output(self.work / "root" / "usr" / "bin" / "trime_mpi", "--version"))

    @unittest.skipUnless(MODULES.exists(), "no Environment Modules here")
    def test_module_file(self):
        """Loaded for an installation elsewhere: program and job scripts are found, and man still finds all else."""
        for source in (PACKAGING / "modulefiles" / "trime_mpi").iterdir():
            copy = self.work / "modulefiles" / "trime_mpi" / source.name
            copy.parent.mkdir(parents=True, exist_ok=True)
            text, changes = re.subn("(?m)^set prefix .*$", f"set prefix {self.work}/root/usr",
                                    source.read_text(encoding="utf-8"))
            self.assertEqual(changes, 1)
            copy.write_text(text, encoding="utf-8")
        told = output("bash", "-c", f"source {MODULES}; unset MANPATH; module use {self.work}/modulefiles; "
                      "module load trime_mpi; command -v trime_mpi; $TRIME_PROGRAM --version; "
                      "ls $TRIME_JOBS/common.sh; echo MANPATH $MANPATH; "
                      "module unload trime_mpi; echo left $TRIME_PROGRAM $TRIME_JOBS")
        usr = self.work / "root" / "usr"
        self.assertEqual(told.splitlines()[0], str(usr / "bin" / "trime_mpi"))
        self.assertIn("trime_mpi 0.", told)
        self.assertIn(f"MANPATH {usr}/share/man:\n", told)
        self.assertTrue(told.endswith("\nleft\n"), told)

    def test_spack_recipe_names_options_of_cmake(self):
        text = (PACKAGING / "spack/packages/trime-mpi/package.py").read_text(encoding="utf-8")
        compile(text, "package.py", "exec")
        known = re.findall(r"\boption\((TRIME_\w+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
        used = re.findall(r"TRIME_\w+", text)
        self.assertGreater(len(used), 2)
        self.assertEqual([name for name in used if name not in known], [])

    def test_man_page_has_every_key(self):
        text = gzip.decompress((self.work / "root/usr/share/man/man1/trime_mpi.1.gz").read_bytes()).decode()
        plain = re.sub(r"\\f[BR]|\\&", "", text).replace("\\-", "-").replace("\\e", "\\")
        keys = re.findall(r"^\| `([^`]*)`", output(BUILD / "trime_mpi", "--help-config"), re.MULTILINE)
        self.assertGreater(len(keys), 30)
        self.assertEqual([key for key in keys if key not in plain], [])
        for option in ("--dry-run", "--threads"):
            self.assertIn(option, plain)

    def test_one_version_everywhere(self):
        version = re.search(r"VERSION ([\d.]+) LANG", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)
        self.assertEqual(output("dpkg-deb", "-f", self.deb, "Version").strip(), version)
        self.assertIn(f"trime-mpi_{version}_", (PACKAGING / "trime_mpi.def").read_text(encoding="utf-8"))
        self.assertTrue((PACKAGING / "modulefiles" / "trime_mpi" / version).is_file())


if __name__ == "__main__":
    unittest.main()
