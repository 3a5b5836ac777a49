"""Writes a dictionary as a scene, line by line, so that each line has one key."""

from __future__ import annotations

import collections.abc
import json
import os
import re
from typing import Any, Iterator, List, Tuple

import numpy as np

from ._program import value_text

_PLAIN = re.compile(r"[A-Za-z0-9_.+-]([A-Za-z0-9_.+*/^() %-]*[A-Za-z0-9_.+*/^()%-])?")


def _scalar(value: Any) -> str:
    """Returns a number, flag or text in YAML."""
    if isinstance(value, (str, os.PathLike)):
        text = os.fspath(value)
        return text if _PLAIN.fullmatch(text) and not text.startswith("- ") else json.dumps(text, ensure_ascii=False)
    if isinstance(value, (np.ndarray, collections.abc.Mapping)):
        raise TypeError("a scene takes text, numbers, booleans, lists and dictionaries, not %r" % (value,))
    return value_text(value)


def _flow(value: Any) -> str:
    """Returns a value in one line."""
    if isinstance(value, collections.abc.Mapping):
        return "{" + ", ".join("%s: %s" % (_scalar(name), _flow(entry)) for name, entry in value.items()) + "}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_flow(entry) for entry in value) + "]"
    return _scalar(value)


def override_text(value: Any) -> str:
    """Returns a value as `-s key=value` takes it; dictionaries, also within lists, in braces."""
    listed = isinstance(value, (list, tuple)) and any(isinstance(entry, collections.abc.Mapping) for entry in value)
    return _flow(value) if listed or isinstance(value, collections.abc.Mapping) else value_text(value)


def _nested(value: Any) -> bool:
    """Returns true for a value that takes several lines: a dictionary, or a list with dictionaries in it."""
    if isinstance(value, collections.abc.Mapping):
        return len(value) > 0
    return isinstance(value, (list, tuple)) and any(isinstance(entry, collections.abc.Mapping) for entry in value)


def _block(value: Any, key: str, indent: str) -> Iterator[Tuple[str, str]]:
    """Yields the lines of a nested value, each with its key. indent: the blanks before them."""
    listed = not isinstance(value, collections.abc.Mapping)
    for name, entry in enumerate(value) if listed else value.items():
        inner = "%s.%s" % (key, name) if key else str(name)
        head = indent + ("-" if listed else _scalar(name) + ":")
        if not _nested(entry):
            yield (head + " " + _flow(entry)).rstrip(), inner
        elif listed and isinstance(entry, collections.abc.Mapping):
            lines = list(_block(entry, inner, indent + "  "))
            yield indent + "- " + lines[0][0][len(indent) + 2:], lines[0][1]
            yield from lines[1:]
        else:
            yield head, inner
            yield from _block(entry, inner, indent + "  ")


def scene_text(entries: collections.abc.Mapping) -> Tuple[str, List[str]]:
    """Returns a scene of these keys and values as YAML, and the key of each of its lines. Raises TypeError if a value is of
    a type that scenes do not have."""
    lines = list(_block(entries, "", ""))
    return "".join(line + "\n" for line, _ in lines), [key for _, key in lines]
