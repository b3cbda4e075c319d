#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that includes only point downward between the modules of the library.

Usage: check_layers.py [ROOT]     ROOT: the top of the source tree (default: the tree that holds this script)
Prints each forbidden include as file:line, and exits with 1 if there is one. Tests, benchmarks and examples may include
anything.
"""
import pathlib
import re
import sys

# Direct arrows; a module may also use all that lies below its arrows.
ARROWS = {
    "core": [],
    "comm": ["core"],
    "geometry": ["core"],
    "mesh": ["geometry"],
    "cones": ["geometry", "comm"],
    "shape": ["geometry"],
    "projection": ["geometry"],
    "sizing": ["cones"],
    "delaunay": ["mesh"],
    "decomposition": ["mesh", "comm"],
    "polygon": ["geometry"],
    "generalise": ["polygon", "sizing"],
    "boundary": ["polygon", "sizing", "mesh"],
    "sites": ["polygon", "delaunay", "decomposition", "sizing"],
    "start": ["sites", "boundary", "generalise"],
    "sweep": ["sites"],
    "cleanup": ["sites"],
    "extraction": ["sites"],
    "certificate": ["sites"],
    "meshing": ["start", "sweep", "cleanup", "extraction", "certificate", "shape"],
    "io": ["mesh", "comm"],
    "checkpoint": ["meshing", "io"],
    "formats": ["io", "projection"],
    "handover": ["mesh", "comm"],
    "app": ["checkpoint", "formats"],
}
# Foreign headers that only some modules may see, as (pattern, name, modules).
VERIFIER = "check"  # a program of its own, which shares no code with the modules
FOREIGN = [
    (re.compile(r"mpi\.h$"), "MPI", {"comm"}),
    (re.compile(r"(hdf5|H5\w*)\.h$"), "HDF5", {"io"}),
    (re.compile(r"omp\.h$"), "OpenMP", {"core"}),
    (re.compile(r"proj\.h$"), "PROJ", {"projection"}),
    (re.compile(r"shapefil\.h$"), "libshp", {"shape"}),
]
NATIVE_HANDLE = "comm/native.hpp"  # brings mpi.h with it
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def below(module):
    """The module and all that its arrows reach."""
    reached = {module}
    for target in ARROWS[module]:
        reached |= below(target)
    return reached


def complaint(module, public, bracket, header):
    """Why `module` may not include `header`, or None. `public`: the including file lies in include/trime."""
    parts = header.split("/")
    if module == VERIFIER:
        return f"{module} shares no code with the modules" if parts[0] in ARROWS or parts[0] == "trime" else None
    ours = parts[0] == "trime"
    if not ours and bracket == "<":
        for pattern, name, allowed in FOREIGN:
            if pattern.search(header) and module not in allowed:
                return f"{name} is for {', '.join(sorted(allowed))} only"
        return None
    if header == NATIVE_HANDLE and module not in ("comm", "io"):
        return "the MPI handle is for comm and io only"
    target = parts[1] if ours and len(parts) > 2 else parts[0]
    if target not in ARROWS:
        return f"'{target}' is no module; write trime/<module>/<file> or, in src, <module>/<file>"
    if public and not ours:
        return "a public header cannot include a private one: it would not compile once installed"
    if target not in below(module):
        return f"{module} may use {', '.join(sorted(below(module) - {module})) or 'nothing'} only"
    return None


def source_files(root):
    """Yields (file, module, public) for all headers and sources of the modules."""
    for folder, public in (("include/trime", True), ("src", False)):
        for path in sorted((root / folder).rglob("*.[hc]pp")):
            module = path.relative_to(root / folder).parts[0]
            if module not in ("bench", "examples"):
                yield path, module, public


def check(root):
    """Returns all complaints as text and the number of files read."""
    found, count = [], 0
    for path, module, public in source_files(root):
        count += 1
        where = path.relative_to(root)
        if module not in ARROWS and module != VERIFIER:
            found.append(f"{where}:1: '{module}' is no module that design and this script know")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            neighbour = match and "/" not in match.group(2) and (path.parent / match.group(2)).is_file()
            reason = complaint(module, public, *match.groups()) if match and not neighbour else None
            if reason:
                found.append(f"{where}:{number}: {match.group(2)}: {reason}")
    return found, count


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent)
    found, count = check(root)
    if count == 0:
        found.append(f"{root}: no source files here")
    for line in found:
        print(line)
    print(f"{count} files, {len(found)} forbidden includes")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
