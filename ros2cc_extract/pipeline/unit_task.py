"""A unit to verify, and what is known of it then."""

from __future__ import annotations

import hashlib
from dataclasses import field, replace

from ros2cc_extract.cache_file import tool_version
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.generator.build import Family
from ros2cc_extract.generator.releases import model_setting
from ros2cc_extract.generator.template_files import Profile
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec, Policy, close
from ros2cc_extract.spec.joined_executors import Joined
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.results import Verdict, Verification
from ros2cc_extract.verify.search.options import Checker, Options

LONGEST_JUDGEMENT_S = 10.0
_OF_WAITS = frozenset({Family.DEADLOCK, Family.PROGRESS})
_VERDICTS = (Verdict.SATISFIED, Verdict.UNDECIDED, Verdict.NOT_SATISFIED)


@dataclass(frozen=True)
class Task:
    """
    A unit to verify.

    :param unit: as it was extracted; ``closed`` is what the model shows of it.
    :param keeps_runs: every run is wanted, not only those that findings show.
    :param joined: of what units ``unit`` is made, where it is made of several.
    :param answered: what its model, of another release, has answered already.
    """

    unit: Spec
    closed: ClosedSpec
    options: Options
    keeps_runs: bool
    joined: Joined | None = None
    answered: Verification | None = field(default=None, repr=False)

    @property
    def judging(self) -> Options | None:
        """How findings are judged where that needs a model of its own: rclpy's executors."""
        judging = judging_options(self.options)
        return None if judging is self.options else judging

    def under(self, release: str) -> Task:
        """The same unit under one release of rclpy."""
        closed = replace(self.closed, spec=replace(self.closed.spec, rclpy=release))
        unit = replace(self.unit, rclpy=release)
        return replace(self, unit=unit, closed=closed, answered=None)

    @property
    def size(self) -> int:
        """How much there is to verify, roughly."""
        return len(self.closed.spec.callbacks)

    @property
    def turn(self) -> tuple[bool, int]:
        """Units that wait for each other come first: they are few, and nothing else shows them."""
        return self.joined is None, self.size

    @property
    def key(self) -> str:
        """Equal where nothing differs on which the answer depends."""
        return _hashed(f'{tool_version()}\0{self!r}')

    @property
    def model(self) -> str:
        """Equal where what findings rest on is one model, asked the same, whatever the release."""
        spec = self.closed.spec
        closed = replace(self.closed, spec=replace(spec, rclpy=None))
        return _hashed(f'{closed!r}\0{self.judging or self.options!r}\0{model_setting(spec)!r}')


@dataclass(frozen=True)
class Examined:
    """
    What is known of a unit.

    :param shown: the verdicts for the reader; ``judged`` are those that findings rest on.
    :param elsewhere: the like of ``judged`` under releases where the unit behaves otherwise.
    """

    shown: Verification
    judged: Verification
    findings: tuple[Finding, ...]
    elsewhere: tuple[Verification, ...] = ()

    @property
    def under_all(self) -> Verification:
        """``judged``, each verdict as it is where it is worst."""
        worst = {(result.words, result.formula): result for result in self.judged.results}
        for result in (result for each in self.elsewhere for result in each.results):
            known = worst.setdefault((result.words, result.formula), result)
            if _VERDICTS.index(result.verdict) > _VERDICTS.index(known.verdict):
                worst[result.words, result.formula] = result
        return (
            replace(self.judged, results=tuple(worst.values())) if self.elsewhere else self.judged
        )

    @property
    def is_final(self) -> bool:
        """Whether no limit of this machine has cut it short."""
        return all(each.complete for each in (self.shown, self.judged, *self.elsewhere))


def _hashed(text: str) -> str:
    return hashlib.sha256(text.encode('utf-8', 'surrogatepass')).hexdigest()


def judging_options(options: Options) -> Options:
    """How findings are judged: by rclpy's executors, which only the embedded checker knows."""
    if options.profile is Profile.RCLPY or options.checker is not Checker.EMBEDDED:
        return options
    seconds = min(options.limits.seconds or LONGEST_JUDGEMENT_S, LONGEST_JUDGEMENT_S)
    limits = replace(options.limits, seconds=seconds)
    return replace(options, profile=Profile.RCLPY, limits=limits, structural=False)


def joined_task(joined: Joined, policy: Policy, options: Options) -> Task:
    """Return the task of several units joined into one: only findings are reported for it."""
    task = Task(joined.spec, close(joined.spec, policy), options, False, joined)
    return replace(task, options=of_joined(judging_options(options)))


def of_joined(options: Options) -> Options:
    """Of units together only the waits are asked; their pool has as many threads as they need."""
    return replace(options, fills_threads=False, families=_OF_WAITS)
