"""How to verify: which checker, which model, and within which limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path

from ros2cc_extract.checker.api import EngineKind, Fairness, Limits, Progress
from ros2cc_extract.generator import build
from ros2cc_extract.verify.uppaal.verifyta import Runs

OnProgress = Callable[[Progress], None]


class Checker(Enum):
    """Who answers."""

    EMBEDDED = 'embedded'
    VERIFYTA = 'verifyta'


@dataclass(frozen=True, kw_only=True)
class Options:
    """
    How to verify; the defaults are those of the command line.

    :param verifyta: the program, where it is not to be looked for.
    :param jobs: threads that explore one model together; no answer depends on them.
    :param structural: profile rclpy also asks who starves under unlimited arrivals.
    :param families: what alone is asked; all that there is where it is left out.
    """

    checker: Checker = Checker.EMBEDDED
    verifyta: Path | None = None
    runs: Runs = Runs.TOGETHER
    profile: build.Profile = build.Profile.PAPER
    text: build.Text = build.Text.COMPACT
    max_cycle: int | None = 1
    structural: bool = True
    families: frozenset[build.Family] | None = None
    engine: EngineKind = EngineKind.AUTO
    fairness: Fairness = Fairness.NONE
    reduction: bool = True
    limits: Limits = field(default_factory=Limits)
    jobs: int = 1


DEFAULTS = Options()
