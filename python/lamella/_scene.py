"""Scenes from dicts, as the text of scene files."""

import json
import os
import re
from collections.abc import Mapping

import numpy

from ._data import Error, what


def whole_path(path):
    """A file's path as it is from anywhere; what is no file, such as the name of a built-in scene, as
    it is."""
    path = os.fsdecode(path)
    try:
        path.encode()
    except UnicodeEncodeError:
        raise Error(f"{ascii(path)}: the names of files and folders must be UTF-8 here") from None
    return os.path.abspath(path) if os.path.exists(path) else path


def override_of(setting):
    """An override with the whole path of a file that it names."""
    if not isinstance(setting, str):
        raise Error(f'overrides are texts such as "grid.nodes=96", not {what(setting)}')
    key, _, value = setting.partition("=")
    is_file = key.strip() in ("shape.file", "domains.file") and os.path.exists(value)
    return f"{key}={json.dumps(whole_path(value), ensure_ascii=False)}" if is_file else setting


def text_of(scene):
    """Sections of keys as TOML. What is None is not there."""
    scene = {key: value for key, value in scene.items() if value is not None}
    lines = [_line(key, value) for key, value in scene.items() if not isinstance(value, Mapping)]
    for section, keys in scene.items():
        if isinstance(keys, Mapping):
            lines.append(f"[{_key(section)}]")
            lines += [_line(key, value, section) for key, value in keys.items() if value is not None]
    return "\n".join(lines) + "\n"


def _line(key, value, section=""):
    if key == "file" and isinstance(value, (str, os.PathLike)):
        value = whole_path(value)
    try:
        line = f"{_key(key)} = {_value(value)}"
        line.encode()
        return line
    except UnicodeEncodeError:
        raise Error(f"{_place(key, section)}: {ascii(value)} is not a text of Unicode characters") from None
    except TypeError:
        raise Error(f"{_place(key, section)}: {what(value)} is no value of a scene; numbers, texts, true or false "
                    "and lists of them are") from None


def _place(key, section):
    return f"[{section}] {key}" if section else key


def _key(name):
    if not isinstance(name, str):
        raise Error(f"sections and keys of a scene are texts; {what(name)} is none")
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name)


def _value(value):
    if isinstance(value, (numpy.generic, numpy.ndarray)):
        value = value.tolist()
    if isinstance(value, os.PathLike):
        value = os.fsdecode(value)
    if isinstance(value, Mapping):
        pairs = ((_key(key), one) for key, one in value.items() if one is not None)
        return "{" + ", ".join(f"{key} = {_value(one)}" for key, one in pairs) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(one) for one in value) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (bool, int, float)):
        return repr(value).lower()
    raise TypeError
