"""How to verify: which checker, which model, and within which limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING

from ros2cc_extract.checker.engines.limits import Limits, Progress
from ros2cc_extract.checker.engines.terms import EngineKind, Fairness
from ros2cc_extract.generator.template_files import Profile, Text
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.verify.uppaal.verifyta_processes import Runs

if TYPE_CHECKING:
    from ros2cc_extract.generator.build import Family

OnProgress = Callable[[Progress], None]


class Checker(Enum):
    """What answers."""

    EMBEDDED = 'embedded'
    VERIFYTA = 'verifyta'


@dataclass(frozen=True, kw_only=True)
class Options:
    """
    How to verify; the defaults are those of the command line.

    :param verifyta: the program, where it is not to be looked for.
    :param jobs: threads that explore one model together; no answer depends on them.
    :param structural: profile rclpy also asks which callbacks starve under unlimited arrivals.
    :param fills_threads: asks once more, with runs of one callback on all threads.
    :param families: what alone is asked; all that there is where it is left out.
    """

    checker: Checker = Checker.EMBEDDED
    verifyta: Path | None = None
    runs: Runs = Runs.TOGETHER
    profile: Profile = Profile.PAPER
    text: Text = Text.COMPACT
    max_cycle: int | None = 1
    structural: bool = True
    fills_threads: bool = True
    families: frozenset[Family] | None = None
    engine: EngineKind = EngineKind.AUTO
    fairness: Fairness = Fairness.NONE
    reduction: bool = True
    limits: Limits = field(default_factory=Limits)
    jobs: int = 1


DEFAULTS = Options()
