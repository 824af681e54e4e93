"""Files, written whole or not at all."""

from __future__ import annotations

import os
import uuid
from pathlib import Path


def write(path: str | os.PathLike[str], content: str | bytes, *, force: bool, design: bool = False) -> Path:
    """Write a file. One that is there is replaced only with ``force``, at once and whole; where the disk is full nothing is left. A design
    file that is there is replaced by a ``design`` alone.

    Raises ``FileExistsError``.
    """
    target = Path(path)
    if not design and target.suffix.lower() == ".toml" and target.exists():
        raise FileExistsError(f"{target} is there already, a design file by its name: nothing else replaces it, force=True neither")
    data = content.encode("utf-8") if isinstance(content, str) else content
    if not force:
        _fill(target, data)
        return target
    # Behind a link the linked file is replaced, not the link.
    real = Path(os.path.realpath(target))
    if real.exists() and not real.is_file():
        # A pipe or a device is written to; a folder says that it is one.
        real.write_bytes(data)
        return target
    beside = real.with_name(f".sprag-design-{uuid.uuid4().hex}.tmp")
    _fill(beside, data)
    try:
        if real.exists():
            os.chmod(beside, real.stat().st_mode & 0o7777)
        os.replace(beside, real)
    except BaseException:
        os.unlink(beside)
        raise
    return target


def _fill(path: Path, data: bytes) -> None:
    """A new file with all of ``data``, or none."""
    with open(path, "xb") as file:
        try:
            file.write(data)
            file.flush()
        except BaseException:
            os.unlink(path)
            raise
