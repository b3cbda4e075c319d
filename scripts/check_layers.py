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

# The arrows: a module includes its own headers, those of core, and those of the modules in its row. An arrow that no
# include uses is an error, too.
ARROWS = {
    "core": [],
    "comm": [],
    "geometry": [],
    "mesh": ["geometry"],
    "cones": ["comm", "geometry"],
    "contours": ["geometry"],
    "tracing": ["geometry"],
    "shape": ["geometry", "contours", "tracing"],
    "projection": ["geometry", "contours"],
    "sizing": ["comm", "geometry", "cones"],
    "delaunay": ["geometry", "mesh"],
    "decomposition": ["comm", "geometry", "mesh"],
    "polygon": ["geometry"],
    "generalise": ["comm", "geometry", "sizing", "polygon"],
    "boundary": ["comm", "geometry", "mesh", "sizing", "polygon"],
    "sites": ["comm", "geometry", "mesh", "sizing", "delaunay", "decomposition", "polygon"],
    "placing": ["comm", "geometry", "mesh", "sizing", "polygon", "sites"],
    "fitting": ["comm", "geometry", "sizing", "generalise", "boundary", "sites", "placing"],
    "start": ["comm", "geometry", "mesh", "sizing", "decomposition", "sites", "placing", "fitting"],
    "sweep": ["comm", "geometry", "mesh", "delaunay", "polygon", "sites"],
    "cleanup": ["comm", "geometry", "mesh", "sizing", "delaunay", "decomposition", "polygon", "sites"],
    "extraction": ["comm", "geometry", "mesh", "sizing", "decomposition", "polygon", "sites"],
    "certificate": ["comm", "geometry", "mesh", "sizing", "decomposition", "polygon", "sites"],
    "splitting": ["comm", "geometry", "mesh", "sizing", "polygon", "extraction"],
    "meshing": ["comm", "geometry", "mesh", "shape", "sizing", "delaunay", "decomposition", "polygon", "boundary",
                "sites", "fitting", "start", "sweep", "cleanup", "extraction", "certificate", "splitting"],
    "refinement": ["comm", "geometry", "mesh", "polygon", "handover", "extraction", "certificate"],
    "io": ["comm", "mesh"],
    "fields": ["comm", "geometry", "contours", "io"],
    "checkpoint": ["comm", "sweep", "meshing", "io"],
    "record": ["comm", "geometry", "mesh", "shape", "sizing", "polygon", "acceptance", "boundary", "sweep",
               "meshing", "io"],
    "formats": ["comm", "geometry", "mesh", "dual", "projection", "io"],
    "handover": ["comm", "geometry", "mesh"],
    "dual": ["comm", "geometry", "mesh", "handover"],
    "acceptance": ["comm", "geometry", "mesh", "handover"],
    "facade": ["comm", "geometry", "contours", "tracing", "shape", "sizing", "boundary", "sweep", "mesh", "meshing",
               "io", "record", "formats", "handover", "dual", "acceptance"],
    "python": ["comm", "geometry", "sizing", "dual", "facade"],
    "app": ["comm", "geometry", "contours", "tracing", "shape", "projection", "fields", "sizing", "polygon", "boundary",
            "sites", "fitting", "meshing", "refinement", "io", "checkpoint", "record", "formats", "acceptance"],
}
# Foreign headers that only some modules may see, as (pattern, name, modules).
UMBRELLA = "facade"  # its headers include include/trime/trime.hpp, which lies in no folder
VERIFIER = "check"  # a program of its own, which shares no code with the modules
FOREIGN = [
    (re.compile(r"mpi\.h$"), "MPI", {"comm"}),
    (re.compile(r"(hdf5|H5\w*)\.h$"), "HDF5", {"io"}),
    (re.compile(r"omp\.h$"), "OpenMP", {"core"}),
    (re.compile(r"proj\.h$"), "PROJ", {"projection"}),
    (re.compile(r"shapefil\.h$"), "libshp", {"contours"}),
]
NATIVE_HANDLE = "comm/native.hpp"  # brings mpi.h with it
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def allowed(module):
    """The modules whose headers a module may include."""
    return {module, "core", *ARROWS[module]}


def circle():
    """Modules that reach each other along the arrows, as text, or None."""
    height = {}
    for _ in ARROWS:
        for module, targets in ARROWS.items():
            if module not in height and all(target in height for target in targets):
                height[module] = 1 + max((height[target] for target in targets), default=0)
    rest = sorted(set(ARROWS) - set(height))
    return f"the arrows of {', '.join(rest)} close a circle" if rest else None


def target_of(header):
    """The module of a header as an include names it."""
    parts = header.split("/")
    return parts[1] if parts[0] == "trime" and len(parts) > 2 else parts[0]


def complaint(module, public, bracket, header):
    """Why `module` may not include `header`, or None. `public`: the including file lies in include/trime."""
    parts = header.split("/")
    if module == VERIFIER:
        return f"{module} shares no code with the modules" if parts[0] in ARROWS or parts[0] == "trime" else None
    ours = parts[0] == "trime"
    if not ours and bracket == "<":
        for pattern, name, modules in FOREIGN:
            if pattern.search(header) and module not in modules:
                return f"{name} is for {', '.join(sorted(modules))} only"
        return None
    if header == NATIVE_HANDLE and module not in ("comm", "io"):
        return "the MPI handle is for comm and io only"
    target = target_of(header)
    if target not in ARROWS:
        return f"'{target}' is not a module; write trime/<module>/<file> or, in src, <module>/<file>"
    if public and not ours:
        return "a public header cannot include a private one: it would not compile once installed"
    if target not in allowed(module):
        return f"{module} may include headers of {', '.join(sorted(allowed(module) - {module}))} only"
    return None


def source_files(root):
    """Yields (file, module, public) for all headers and sources of the modules."""
    for folder, public in (("include/trime", True), ("src", False)):
        for path in sorted((root / folder).rglob("*.[hc]pp")):
            parts = path.relative_to(root / folder).parts
            module = parts[0] if len(parts) > 1 else UMBRELLA
            if module not in ("bench", "examples"):
                yield path, module, public


def check(root):
    """Returns all complaints as text and the number of files read."""
    found, count, used = [circle()] if circle() else [], 0, set()
    for path, module, public in source_files(root):
        count += 1
        where = path.relative_to(root)
        if module not in ARROWS and module != VERIFIER:
            found.append(f"{where}:1: '{module}' is not a module that this script knows")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            neighbour = match and "/" not in match.group(2) and (path.parent / match.group(2)).is_file()
            used.add((module, target_of(match.group(2)) if match else module))
            reason = complaint(module, public, *match.groups()) if match and not neighbour else None
            if reason:
                found.append(f"{where}:{number}: {match.group(2)}: {reason}")
    for module, targets in ARROWS.items() if count else ():
        found += [f"scripts/check_layers.py: {module} includes nothing of {target}: remove that arrow"
                  for target in targets if (module, target) not in used]
    return found, count


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent)
    found, count = check(root)
    if count == 0:
        found.append(f"{root}: no source files here")
    for line in found:
        print(line)
    print(f"{count} files, {len(found)} findings")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
