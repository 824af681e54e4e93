"""Design and optimise multi-arc sprag (overrunning) clutches.

    >>> import sprag_design as sd
    >>> design = sd.Design.load("designs/huang2017-multi-arc.toml")
    >>> design.check().passed
    >>> design.simulate("high-10").theta_inner_rad      # a numpy array
    >>> design.with_(r_i2_mm=4.1).stiffness([3.34, 16.8]).windup_deg

Every figure is that of the command ``sprag-design``, to the last bit. Names end in their unit; a name without one is a pure
number. Azimuths and rotations are positive in engagement for the sprag; a slip or an offset is positive towards overrunning.
"""

from __future__ import annotations

import os as _os

from . import _core
from ._answers import (
    Blow,
    BlowAt,
    Capacity,
    Check,
    Curve,
    Deciding,
    End,
    Evaluation,
    FedFrequency,
    Feed,
    FilmOverrun,
    FilmOverrunLine,
    Found,
    Front,
    FrontPoint,
    Junction,
    LeftOut,
    Life,
    LifeLoad,
    LifePlace,
    Margin,
    Optimum,
    Overrun,
    OverrunPoint,
    Plane,
    Progress,
    Reengagement,
    SceneSprag,
    Sharing,
    SharingScene,
    SharingSprag,
    Simulation,
    Slip,
    SlipHeat,
    SlipWear,
    Slips,
    SpringFeed,
    Stiffness,
    SweepMap,
    Variable,
    WorstSlip,
)
from ._design import Design, map_tables
from ._errors import DesignError, DesignProblem, Interrupted, NoClutch, NotSized
from ._identified import FoundUnknown, Identification, Observed
from ._made import (
    ComparedDesign,
    ComparedFigure,
    ComparedInput,
    ComparedMargin,
    ComparedScene,
    Comparison,
    FirstDesign,
    Page,
    PeriodicState,
    Resonance,
    Taken,
    TriedSpace,
)
from ._new import compare, new, purposes, size
from ._problem import Problem

__version__: str = _core.__version__

__all__ = [
    "Blow",
    "BlowAt",
    "Capacity",
    "Check",
    "ComparedDesign",
    "ComparedFigure",
    "ComparedInput",
    "ComparedMargin",
    "ComparedScene",
    "Comparison",
    "Curve",
    "Deciding",
    "Design",
    "DesignError",
    "DesignProblem",
    "End",
    "Evaluation",
    "FedFrequency",
    "Feed",
    "FilmOverrun",
    "FilmOverrunLine",
    "FirstDesign",
    "Found",
    "FoundUnknown",
    "Front",
    "FrontPoint",
    "Identification",
    "Interrupted",
    "Junction",
    "LeftOut",
    "Life",
    "LifeLoad",
    "LifePlace",
    "Margin",
    "NoClutch",
    "NotSized",
    "Observed",
    "Optimum",
    "Overrun",
    "OverrunPoint",
    "Page",
    "PeriodicState",
    "Plane",
    "Problem",
    "Progress",
    "Reengagement",
    "Resonance",
    "SceneSprag",
    "Sharing",
    "SharingScene",
    "SharingSprag",
    "Simulation",
    "Slip",
    "SlipHeat",
    "SlipWear",
    "Slips",
    "SpringFeed",
    "Stiffness",
    "SweepMap",
    "Taken",
    "TriedSpace",
    "Variable",
    "WorstSlip",
    "compare",
    "contact_laws",
    "map_tables",
    "new",
    "purposes",
    "size",
]


def contact_laws() -> list[str]:
    """Names of the contact laws that :meth:`Design.stiffness` compares."""
    return _core.contact_laws()


if hasattr(_os, "register_at_fork"):
    # Threads do not survive a fork: the child computes on its own.
    _os.register_at_fork(after_in_child=_core.forked)

del annotations
