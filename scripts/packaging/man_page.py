#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the man page of trime_mpi from the output of the program: man_page.py PROGRAM OUTPUT.

The options come from --help, and the keys of a config from --help-config. If OUTPUT ends in .gz, it is compressed.
"""
import gzip
import pathlib
import re
import subprocess
import sys


def ask(program, option):
    """Returns the output of the program."""
    return subprocess.run([program, option], capture_output=True, text=True, check=True, timeout=60).stdout


def roff(text):
    """Text with the signs of roff made harmless."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.MULTILINE)


def marked(text):
    """Returns the text with its code in bold."""
    return re.sub(r"`([^`]*)`", r"\\fB\1\\fR", roff(text))


def options_of(text):
    """(option, meaning) of each option that --help lists."""
    part = text.split("Options:", 1)[1].split("\n\n", 1)[0]
    return re.findall(r"^  (-\S+(?: TEXT)?) {2,}(.*)$", part, re.MULTILINE)


def keys_of(table):
    """(key, values, meaning) of each row of the table of keys."""
    rows = [re.split(r" (?<!\\)\| ", line.strip("| ")) for line in table.splitlines()[2:] if line.startswith("|")]
    return [row for row in rows if len(row) == 3]


def page(program):
    """The whole page."""
    usage, keys = ask(program, "--help"), keys_of(ask(program, "--help-config"))
    options = options_of(usage)
    version = ask(program, "--version").split()[1]
    if len(options) < 5 or len(keys) < 30:
        sys.exit(f"man_page.py: expected 5 options and 30 keys at least, found {len(options)} and {len(keys)} "
                 f"in the answers of {program}; see options_of and keys_of")
    codes = usage[usage.index("Exit codes:"):].removeprefix("Exit codes:").strip()
    lines = [f'.TH TRIME_MPI 1 "" "trime_mpi {version}" "User Commands"', ".SH NAME",
             "trime_mpi \\- distributed generator of large 2D triangle meshes", ".SH SYNOPSIS",
             "[\\fBmpirun \\-np\\fR \\fIRANKS\\fR] \\fBtrime_mpi\\fR \\fICONFIG\\fR "
             "[\\fIsection.key\\fR=\\fIvalue\\fR ...] [\\fIOPTIONS\\fR]", ".SH DESCRIPTION",
             "Reads a shape and an element size from a config file, and writes one HDF5 file with a triangle mesh of "
             "it. The mesh does not depend on the number of ranks and threads.",
             "A pair \\fIsection.key\\fR=\\fIvalue\\fR is set after the file.", ".SH OPTIONS"]
    for option, meaning in options:
        lines += [".TP", f"\\fB{roff(option)}\\fR", marked(meaning)]
    lines += [".SH CONFIG", "A key stands in its section. The default is in brackets."]
    for key, values, meaning in keys:
        lines += [".TP", marked(key), marked(values) + ".", ".br", marked(meaning)]
    return "\n".join(lines + [".SH EXIT STATUS", roff(codes), ".SH SEE ALSO", "\\fBmpirun\\fR(1)", ""])


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    output = pathlib.Path(sys.argv[2])
    text = page(sys.argv[1]).encode()
    output.write_bytes(gzip.compress(text, mtime=0) if output.suffix == ".gz" else text)


if __name__ == "__main__":
    main()
