"""Arguments as the library takes them, or an exception that says what is allowed."""

from __future__ import annotations

import json
import math
import numbers
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

Setting = bool | int | float | str | Sequence[Any] | Mapping[str, Any]
"""A value of a design file."""

MOST = 2**63 - 1
"""Whole numbers end here."""


def toml(value: Any) -> str:
    """A value as a design file has it."""
    if getattr(value, "ndim", None) == 0:
        # A number of numpy, be it an array without an axis.
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(key))} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, Iterable):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    raise TypeError(f"{value!r} is no value of a design file: a number, a text, true, false, a list or a table (dict) of these is")


def listed(name: str, values: Any) -> list[float]:
    """Numbers in a row: those of a list or of an array with one axis, or one that stands alone."""
    if isinstance(values, (list, tuple)) and all(type(value) is float for value in values):
        # What optimisers ask a thousand times.
        return list(values)
    axes = getattr(values, "ndim", None)
    if axes == 0 or isinstance(values, numbers.Real):
        return [float(values)]
    if axes not in (None, 1):
        raise ValueError(f"{name}: an array of shape {tuple(values.shape)}: allowed: a number, or numbers in a row (one axis)")
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise TypeError(f"{name} {values!r}: allowed: a number, or numbers in a row")
    row = values.tolist() if axes == 1 and hasattr(values, "tolist") else list(values)
    for value in row:
        if type(value) is not float and not isinstance(value, numbers.Real) and getattr(value, "ndim", None) != 0:
            raise TypeError(f"{name}: {value!r}: allowed: a number, or numbers in a row")
    return [float(value) for value in row]


def one(name: str, value: Any) -> float:
    """A single number."""
    row = listed(name, value)
    if len(row) != 1:
        raise ValueError(f"{name} {value!r}: allowed: one number")
    return row[0]


def positive(name: str, values: Any) -> list[float]:
    """The same of numbers above 0."""
    row = listed(name, values)
    for value in row:
        if not 0.0 < value < math.inf:
            raise ValueError(f"{name} {value}: allowed: a finite number above 0")
    return row


def whole(name: str, value: float, least: int, most: int = MOST) -> int:
    """A whole number, be it 1e3."""
    if isinstance(value, numbers.Integral):
        number = int(value)
    elif (isinstance(value, numbers.Real) or getattr(value, "ndim", None) == 0) and float(value).is_integer():
        number = int(value)
    else:
        raise ValueError(f"{name} {value!r}: allowed: a whole number")
    if not least <= number <= most:
        raise ValueError(f"{name} {value}: allowed: {f'{least} or more' if most == MOST else f'{least} to {most}'}")
    return number


def whole_or_none(name: str, value: float | None, least: int, most: int = MOST) -> int | None:
    """The same where one is given."""
    return None if value is None else whole(name, value, least, most)


def span(name: str, value: Any) -> tuple[float, float] | None:
    """From and to, or one number for both."""
    if value is None:
        return None
    row = positive(name, value)
    if len(row) == 1:
        row = row * 2
    if len(row) != 2 or row[0] > row[1]:
        raise ValueError(f"{name} {value!r}: allowed: a number, or from and to, rising")
    return row[0], row[1]


def called(method: str, *given: Any, **options: tuple[Any, Any]) -> str:
    """A call as it is said in files; of options, each with its usual value, those that are another one."""
    said = [*map(repr, given), *(f"{name}={value!r}" for name, (value, usual) in options.items() if value != usual)]
    return f"Python, {method}({', '.join(said)})"
