# SPDX-License-Identifier: BSD-3-Clause
"""A config as a dict, written as the file that the program reads."""
import collections.abc
import os

import numpy as np

PATHS = ("file", "fixed_points")  # keys whose values are paths, relative to the working directory in a dict


def value_text(value):
    """True -> true, (0.5, 0.5) -> 0.5 0.5; floats keep all their bits."""
    if value is None:
        return ""  # the default
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, collections.abc.Iterable):
        return " ".join(value_text(one) for one in value)
    return str(value)


def rings_text(rings):
    """Rings of coordinates as an .xy file: one array [k,2], or a list of them."""
    rings = [rings] if np.ndim(rings[0]) == 1 else rings
    return "\n".join("".join(f"{x!r} {y!r}\n" for x, y in np.asarray(ring, float).tolist()) for ring in rings)


def sections_of(config):
    """{"shape": {"region": "a", "a": {...}}} and {"shape": {...}, "shape.a": {...}} alike, as {section: {key: value}}."""
    sections = {}
    for name, keys in config.items():
        if not isinstance(keys, collections.abc.Mapping):
            raise TypeError(f"config['{name}']: expected a dict of keys, found {type(keys).__name__}")
        own = {key: value for key, value in keys.items() if not isinstance(value, collections.abc.Mapping)}
        if own:
            sections.setdefault(name, {}).update(own)
        for inner, values in keys.items():
            if isinstance(values, collections.abc.Mapping):
                sections.setdefault(f"{name}.{inner}", {}).update(values)
    return sections


def ini_text(config, directory):
    """The dict as an ini. Arrays under `rings` (of a part) and `fixed_points` go into files in `directory`."""
    lines = []
    for number, (section, keys) in enumerate(sections_of(config).items()):
        lines.append(f"[{section}]")
        for key, value in keys.items():
            if key == "rings" or (key == "fixed_points" and not isinstance(value, (str, os.PathLike))):
                path = os.path.join(directory, f"{key}{number}.xy")
                with open(path, "w", encoding="utf-8") as file:
                    file.write(rings_text(value))
                key, value = ("file" if key == "rings" else key), path
            elif key in PATHS:
                value = os.path.abspath(value)
            text = value_text(value)
            if "\n" in text:
                raise ValueError(f"config['{section}']['{key}']: a value is one line, found {text!r}")
            lines.append(f"{key} = {text}")
    return "\n".join(lines) + "\n"
