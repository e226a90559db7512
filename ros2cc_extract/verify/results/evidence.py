"""
A run that shows why a verdict is as it is: what happens in each step, and where.

``run_evidence.py`` makes it of a path of the model.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from types import MappingProxyType

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.results.events import Event


@dataclass(frozen=True)
class Sentence:
    """
    What one process does in a step.

    :param lane: name of the process that has the edge: a thread, the executor, a group …
    :param event: what it is; ``None`` in a foreign model.
    """

    lane: str
    text: str
    event: Event | None = None

    @staticmethod
    def of(lane: str, event: Event, names: Mapping[str, str] = MappingProxyType({})) -> Sentence:
        """Say an event, with words for names of the model."""
        return Sentence(lane, event.said(names), event)


@dataclass(frozen=True, kw_only=True)
class Moment:
    """
    One step of a run that means something to a developer.

    :param number: 1-based, counts only steps with words.
    :param sentences: one per edge that has words.
    :param places: of the callbacks named, in the order of naming.
    :param changes: variables and locations that changed, with their new values.
    :param edges: what was taken, by locations; of ``Evidence.steps`` alone.
    """

    number: int
    sentences: tuple[Sentence, ...]
    places: tuple[tuple[str, Place], ...]
    changes: Mapping[str, int | str]
    edges: tuple[str, ...] = ()

    @property
    def events(self) -> tuple[Event, ...]:
        """What happens in it; nothing in a foreign model."""
        return tuple(s.event for s in self.sentences if s.event is not None)


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """
    A run that shows why a verdict is as it is.

    :param start: location of every process before the first moment.
    :param cycle_from: number of the moment from which the run repeats forever.
    :param ends: how a run without a cycle ends for good (``deadlock``, ``idle``), if it does.
    :param left_out: how many moments are not among ``moments``, since they have no part in it.
    :param closing: what the run ends in, in a sentence.
    :param steps: every step that was taken, also those without words, in the same form.
    :param cycle_step: number of the step from which the run repeats forever.
    :param origin: the run that it words, step by step; it stays behind when evidence is pickled,
        as it holds the whole model.
    """

    start: Mapping[str, str]
    moments: tuple[Moment, ...]
    cycle_from: int | None
    ends: str | None
    left_out: int = 0
    closing: str = ''
    steps: tuple[Moment, ...] = ()
    cycle_step: int | None = None
    origin: object = field(default=None, repr=False, compare=False)

    def __getstate__(self) -> dict[str, object]:
        return {**self.__dict__, 'origin': None}


LOST = Evidence(
    start={},
    moments=(),
    cycle_from=None,
    ends=None,
    closing='this run was not found again within the limits',
)
"""Of a search that was slower the second time, with as little time as the first."""
