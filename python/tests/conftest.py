"""Designs of the repository, and the command as the wheel installs it."""

from __future__ import annotations

import json
import subprocess
import sys
import sysconfig
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import sprag_design as sd

ROOT = Path(__file__).resolve().parents[2]
DESIGNS = ROOT / "designs"
MULTI_ARC = DESIGNS / "huang2017-multi-arc.toml"

Command = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture(scope="session")
def design() -> sd.Design:
    return sd.Design.load(MULTI_ARC)


@pytest.fixture(scope="session")
def command() -> Command:
    script = Path(sysconfig.get_path("scripts")) / "sprag-design"

    def run(*args: object, given: str = "") -> subprocess.CompletedProcess[str]:
        words = [str(script), *(str(a) for a in args)]
        return subprocess.run(words, input=given, capture_output=True, text=True, timeout=300)

    return run


def figures(text: str) -> dict[str, Any]:
    """The object of ``--json`` without what names tool and design, and without the time it took."""
    answer: dict[str, Any] = json.loads(text)
    return {k: v for k, v in answer.items() if k not in NAMES}


NAMES = ("tool", "version", "design", "design_hash", "run_time_s")


def python(code: str, *args: object, timeout: float = 300) -> subprocess.CompletedProcess[str]:
    """Run ``code`` in a Python of its own, so that what hangs or dies is not this one."""
    words = [sys.executable, "-c", code, *(str(a) for a in args)]
    return subprocess.run(words, capture_output=True, text=True, timeout=timeout)
