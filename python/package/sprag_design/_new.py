"""The own clutch, and designs side by side."""

from __future__ import annotations

from collections.abc import Iterable

from . import _core
from ._arguments import one
from ._design import Design
from ._made import Comparison, FirstDesign, comparison_of, first_of


def purposes() -> dict[str, str]:
    """What a clutch may be for, as :func:`new` takes it, with what that means."""
    return dict(_core.purposes())


def new(
    purpose: str,
    *,
    bore_mm: float,
    torque_nm: float | None = None,
    peak_nm: float | None = None,
    safety: float | None = None,
    inner_track_mm: float | None = None,
    outer_track_mm: float | None = None,
    outside_mm: float | None = None,
    width_mm: float | None = None,
    inner_rpm: float | None = None,
    outer_rpm: float | None = None,
    keep_contact_rpm: float | None = None,
    lift_off_rpm: float | None = None,
    swing_nm: float | None = None,
    swing_hz: float | None = None,
    friction: float | None = None,
    engagements: float | None = None,
    material: str | None = None,
) -> FirstDesign:
    """A first design for a purpose (:func:`purposes`), as the command ``new`` writes it: of all race spaces tried the one of the least volume.

    ``bore_mm``: bore of the inner race, diameter; ``torque_nm``: nominal torque, carried day by day, and ``peak_nm``, at the worst: one of
    them or both; ``safety``: peak over nominal torque, where only one of them is named; ``inner_track_mm``, ``outer_track_mm``:
    diameters of tracks that are there already; ``outside_mm``, ``width_mm``: largest outer diameter and width of the races; ``inner_rpm``, ``outer_rpm``: speeds of the races in overrun, in one sense; ``keep_contact_rpm``: speed of the outer
    race up to which the sprags keep contact in overrun, 0: not asked; ``lift_off_rpm``: speed of the outer race by which they must be off the
    inner one (of the inner race, off the outer one, in a cage that it drives, where the outer race stands), 0: they stay on; ``swing_nm``,
    ``swing_hz``: by how much and how often the torque swings; ``friction``: static friction; ``engagements``: in its life, at nominal torque;
    ``material``: steel of sprags and races. What is left out comes of the purpose: ``taken`` of the answer lists it.

    Raises ``ValueError`` for what no clutch can be asked for, :class:`NotSized` where no clutch of the family does it.
    """
    return _first(**locals())


def size(
    *,
    bore_mm: float,
    torque_nm: float | None = None,
    peak_nm: float | None = None,
    safety: float | None = None,
    inner_track_mm: float | None = None,
    outer_track_mm: float | None = None,
    outside_mm: float | None = None,
    width_mm: float | None = None,
    inner_rpm: float | None = None,
    outer_rpm: float | None = None,
    keep_contact_rpm: float | None = None,
    lift_off_rpm: float | None = None,
    friction: float | None = None,
    material: str | None = None,
) -> FirstDesign:
    """A first design without a purpose, as the command ``size`` writes it; arguments and exceptions are those of :func:`new`."""
    return _first(purpose=None, **locals())


_KEYS = {
    "bore_mm": "bore",
    "torque_nm": "torque",
    "peak_nm": "peak",
    "inner_track_mm": "inner-track",
    "outer_track_mm": "outer-track",
    "outside_mm": "outside",
    "width_mm": "width",
    "swing_nm": "swing",
}
"""Arguments that say a unit which their option leaves out."""


def _first(*, purpose: str | None, material: str | None, **numbers: float | None) -> FirstDesign:
    if numbers["torque_nm"] is None and numbers["peak_nm"] is None:
        raise ValueError("torque_nm or peak_nm: give one of them, or both")
    given: list[tuple[str, str, float]] = []
    for name, value in numbers.items():
        if value is not None:
            given.append((name, _KEYS.get(name, name.replace("_", "-")), one(name, value)))
    found = _core.first_design(purpose, given, material)
    return first_of(found, Design(found[4]))


def compare(designs: Iterable[Design]) -> Comparison:
    """Two to six designs side by side, the one before first: inputs that differ, margins, figures, scenes; as the command ``compare``.

    Raises :class:`NoClutch` where of one no clutch comes about.
    """
    return comparison_of(_core.compare([design._core for design in designs]))
