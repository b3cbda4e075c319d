# SPDX-License-Identifier: BSD-3-Clause
"""Writes a config that is a dict as the file that the program reads. All errors are ConfigError."""
import collections.abc
import numbers
import os

import numpy as np

from .errors import ConfigError
from .outlines import points_text, rings_file

PATHS = ("file", "fixed_points")      # keys whose values are paths, relative to the working directory in a dict
FORMULAS = ("expression", "sdf")      # keys whose values are formulas
NAMES = ("open_boundary", "size_at")  # keys whose values are names with blanks, separated by commas
NOT_YET = "the size cannot be an array or a function yet; write a formula of x and y as text, such as '1+3*x'"


def fail(where, expected, found):
    """Raises ConfigError. where: the place in the config, such as config['meshing']['points']."""
    raise ConfigError([f"{where}: expected {expected}, found {found}"])


def kind_of(value):
    """Returns the words by which a message describes a value that cannot be used."""
    if isinstance(value, np.ndarray):
        return f"an array with the shape {value.shape}"
    return "a function" if callable(value) else f"an object of type {type(value).__name__}"


def scalar_text(value, where):
    """Returns a single value as text: True as true, 0.1 as 0.1. Floats keep all their bits."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, numbers.Integral):
        return str(int(value))
    return fail(where, "a text, a number, True or False, or a list of these", kind_of(value))


def value_text(value, where, between=" "):
    """Returns a value as text. A list becomes its values in a row: (0.5, 0.5) becomes 0.5 0.5."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (str, collections.abc.Mapping)) or not isinstance(value, collections.abc.Iterable):
        text = scalar_text(value, where)
    elif isinstance(value, np.ndarray) and value.ndim > 1:
        text = fail(where, "one value or one row of values", kind_of(value))
    else:
        text = between.join(scalar_text(one, where) for one in value)
    if "\n" in text:
        fail(where, "one line", repr(text))
    return text


def text_for(key, value, where):
    """Returns the value of a key as text. A formula may be a number."""
    if key in FORMULAS and not isinstance(value, (str, numbers.Real)):
        fail(where, "a formula", kind_of(value) + (f"; {NOT_YET}" if key == "expression" else ""))
    return value_text(value, where, ", " if key in NAMES else " ")


def is_section(name, key, value):
    """True if config[name][key] is a section. A dict of rings is GeoJSON, and is not one."""
    return isinstance(value, collections.abc.Mapping) and not (key == "rings" and name != "shape")


def sections_of(config):
    """Returns the sections as {"shape.a": {key: value}}, from such a dict or from a nested one, {"shape": {"a":
    {...}}}."""
    sections = {}
    for name, keys in config.items():
        if not isinstance(keys, collections.abc.Mapping):
            fail(f"config['{name}']", "a dict of keys", kind_of(keys))
        own = {key: value for key, value in keys.items() if not is_section(name, key, value)}
        if own:
            sections.setdefault(name, {}).update(own)
        for inner, values in keys.items():
            if is_section(name, inner, values):
                sections.setdefault(f"{name}.{inner}", {}).update(values)
    return sections


def is_path(value):
    """True for a text or a path."""
    return isinstance(value, (str, os.PathLike))


def written(name, kind, text, directory):
    """Writes a file, and returns its path."""
    path = os.path.join(directory, f"{name}.{kind}")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def key_text(key, value, where, name, directory):
    """Returns the key of the config file and its value as text. Arrays go into a file `name` in `directory`."""
    if key == "rings":
        return "file", written(name, *rings_file(value, where), directory)
    if key == "fixed_points" and not is_path(value):
        return key, written(name, "xy", points_text(value, where), directory)
    if key in PATHS and is_path(value):
        return key, os.path.abspath(value)
    return key, text_for(key, value, where)


def ini_text(config, directory):
    """Returns the text of the config file for a dict. Values of `rings` and `fixed_points` go into files in
    `directory`. Keys with the value None keep their defaults."""
    lines = []
    for number, (section, keys) in enumerate(sections_of(config).items()):
        lines.append(f"[{section}]")
        for key, value in keys.items():
            if value is None:
                continue
            where = f"config['{section}']['{key}']"
            key, text = key_text(key, value, where, f"{key}{number}", directory)
            lines.append(f"{key} = {text}")
    return "\n".join(lines) + "\n"


def override_texts(options, relative_to_config):
    """Returns overrides for the command line, SECTION.KEY=VALUE. Paths are relative to the config file if the user gave
    one, and otherwise to the working directory."""
    texts = []
    for name, value in options.items():
        key, where = name.rpartition(".")[2], f"options['{name}']"
        if key in PATHS and is_path(value) and not relative_to_config:
            value = os.path.abspath(value)
        if key in ("rings", "fixed_points") and not is_path(value):
            fail(where, "a path; an array can only stand in the config", kind_of(value))
        texts.append(f"{name}={text_for(key, value, where)}")
    return texts
