"""Files, written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path


def write(path: str | os.PathLike[str], content: str | bytes, *, force: bool) -> Path:
    """Write a file. One that is there is replaced only with ``force``; where the disk is full nothing is left.

    Raises ``FileExistsError``.
    """
    target = Path(path)
    data = content.encode("utf-8") if isinstance(content, str) else content
    if not force:
        with open(target, "xb") as file:
            _fill(file.fileno(), data, target)
        return target
    handle, name = tempfile.mkstemp(prefix=".sprag-design-", suffix=".tmp", dir=target.parent)
    with os.fdopen(handle, "wb") as file:
        _fill(file.fileno(), data, Path(name))
    try:
        # As a new file would be; mkstemp has made one that nobody else may read.
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(name, target.stat().st_mode & 0o7777 if target.exists() else 0o666 & ~mask)
        os.replace(name, target)
    except BaseException:
        os.unlink(name)
        raise
    return target


def _fill(file: int, data: bytes, path: Path) -> None:
    """All of ``data``, or no file."""
    try:
        rest = memoryview(data)
        while rest:
            rest = rest[os.write(file, rest) :]
    except BaseException:
        os.unlink(path)
        raise
