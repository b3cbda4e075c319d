# SPDX-License-Identifier: BSD-3-Clause
"""Builds and runs the program for AArch64 on another processor, for same_bits.py.

Debian's cross compiler compiles it, Debian's arm64 packages are unpacked into a directory, and qemu-user runs it.
"""
import os
import pathlib
import shutil
import subprocess

TRIPLET = "aarch64-linux-gnu"
TOOLS = {f"{TRIPLET}-g++": f"g++-{TRIPLET}", "qemu-aarch64-static": "qemu-user-static"}
TOOLCHAIN = """set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_SYSROOT {sysroot})
set(CMAKE_LIBRARY_ARCHITECTURE {triplet})
set(CMAKE_C_COMPILER {triplet}-gcc)
set(CMAKE_CXX_COMPILER {triplet}-g++)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,--allow-shlib-undefined")
"""


class ForeignError(Exception):
    """A tool is missing, or packages could not be fetched."""


def call(command, **options):
    """Runs a command; ForeignError with the end of its output if it fails."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        text = (done.stdout + done.stderr)[-2000:]
        raise ForeignError(f"exit code {done.returncode}: {' '.join(map(str, command))}\n{text}")
    return done.stdout


def packages(root):
    """The arm64 packages that the program needs, from scripts/packages.sh."""
    return call(["bash", "-c", 'source "$1" && echo "${trime_aarch64_libraries[@]}"', "bash",
                 root / "scripts/packages.sh"]).split()


def fetch(apt, names):
    """Debian packages with all that they depend on, downloaded under `apt` by a package manager that knows of nothing
    installed and touches nothing outside of it."""
    for part in ("state/lists/partial", "cache/archives/partial"):
        (apt / part).mkdir(parents=True, exist_ok=True)
    (apt / "status").write_text("", encoding="utf-8")
    options = []
    for value in ("APT::Architecture=arm64", "APT::Architectures::=arm64", f"Dir::State={apt}/state",
                  f"Dir::State::status={apt}/status", f"Dir::Cache={apt}/cache", "APT::Install-Recommends=false",
                  "Debug::NoLocking=true"):
        options += ["-o", value]
    if os.getuid() == 0:
        options += ["-o", "APT::Sandbox::User=root"]
    call(["apt-get", *options, "update"])
    call(["apt-get", *options, "install", "-y", "--download-only", *names])
    return sorted((apt / "cache/archives").glob("*.deb"))


def make_relative(sysroot):
    """Links with absolute targets would lead out of the sysroot."""
    for directory, folders, files in os.walk(sysroot):
        for name in folders + files:
            link = pathlib.Path(directory, name)
            if link.is_symlink() and os.readlink(link).startswith("/"):
                target = str(sysroot) + os.readlink(link)
                link.unlink()
                link.symlink_to(os.path.relpath(target, directory))


def make_sysroot(directory, root):
    """DIR/sysroot with headers and libraries for AArch64; one that is whole is used again."""
    sysroot, whole = directory / "sysroot", directory / "sysroot.whole"
    if whole.exists():
        return sysroot
    shutil.rmtree(sysroot, ignore_errors=True)
    sysroot.mkdir()
    for archive in fetch(directory / "apt", packages(root)):
        call(["dpkg-deb", "-x", archive, sysroot])
    make_relative(sysroot)
    # PROJ's version file refuses cross-compiling; without one any version is taken.
    (sysroot / "usr/lib" / TRIPLET / "cmake/proj/proj-config-version.cmake").unlink(missing_ok=True)
    whole.touch()
    return sysroot


def foreign_arguments(directory, root):
    """Arguments of CMake and environment of a cross build whose libraries lie under `directory`."""
    for tool, package in TOOLS.items():
        if shutil.which(tool) is None:
            raise ForeignError(f"expected the program {tool}, found none; Debian: {package}")
    sysroot = make_sysroot(directory, root)
    libraries = sysroot / "usr/lib" / TRIPLET
    toolchain = directory / "aarch64.cmake"
    toolchain.write_text(TOOLCHAIN.format(sysroot=sysroot, triplet=TRIPLET), encoding="utf-8")
    arguments = [
        f"-DCMAKE_TOOLCHAIN_FILE={toolchain}",
        # No wrapper runs here, so CMake gets the places of MPI and HDF5.
        "-DMPI_SKIP_COMPILER_WRAPPER=ON", "-DMPI_ASSUME_NO_BUILTIN_MPI=ON",
        f"-DMPI_CXX_HEADER_DIR={libraries}/openmpi/include", "-DMPI_CXX_LIB_NAMES=mpi",
        f"-DMPI_mpi_LIBRARY={libraries}/openmpi/lib/libmpi.so",
        "-DHDF5_C_COMPILER_EXECUTABLE=HDF5_C_COMPILER_EXECUTABLE-NOTFOUND", f"-DHDF5_ROOT={libraries}/hdf5/openmpi",
        f"-DHDF5_C_INCLUDE_DIR={sysroot}/usr/include/hdf5/openmpi",
        f"-DHDF5_hdf5_LIBRARY_RELEASE={libraries}/hdf5/openmpi/libhdf5.so"]
    return arguments, {"PKG_CONFIG_LIBDIR": f"{libraries}/pkgconfig", "PKG_CONFIG_SYSROOT_DIR": str(sysroot)}


def foreign_run(directory, program):
    """Command and environment that run a foreign program on one rank: qemu starts no helpers of Open MPI."""
    sysroot = directory / "sysroot"
    environment = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self",
                   "OMPI_MCA_mca_base_component_show_load_errors": "0"}
    return ["qemu-aarch64-static", "-L", sysroot, program], environment
