"""Units in rows, the worst first: what stands of each in an overview."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ros2cc_extract.findings.promises import Judgement, Mark, Promise
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Executor, Spec
from ros2cc_extract.text_escaping import printable

SIGNS = {Mark.KEPT: '✓', Mark.BROKEN: '✗', Mark.OPEN: '?'}
COLUMNS = {
    Promise.DEADLOCK: 'deadlock',
    Promise.WAITS: 'waits',
    Promise.STARVATION: 'starve',
    Promise.RACES: 'races',
    Promise.SETTINGS: 'settings',
}
"""What a column for each promise is headed."""
LONGEST_EXECUTOR = 10
_SHORT = {'SingleThreadedExecutor': 'single', 'MultiThreadedExecutor': 'multi'}


@dataclass(frozen=True)
class Row:
    """
    A unit with its promises.

    :param place: among the units of the check, from 0.
    """

    unit: Spec
    promises: Sequence[Judgement]
    place: int

    @property
    def nodes(self) -> str:
        """What the unit is called."""
        return ', '.join(self.unit.nodes) or self.unit.name

    @property
    def weight(self) -> tuple[int, int]:
        """Sorts the worst first."""
        marks = Counter(each.mark for each in self.promises)
        return -marks[Mark.BROKEN], -marks[Mark.OPEN]


def worst_first(units: Sequence[Spec], promises: Sequence[Sequence[Judgement]]) -> list[Row]:
    """Give each unit with its promises, where nothing does harm as text."""
    pairs = zip(units, promises, strict=True)
    rows = [Row(printable(unit), printable(of), place) for place, (unit, of) in enumerate(pairs)]
    return sorted(rows, key=lambda row: row.weight)


def executor_words(executor: Executor) -> str:
    """Say what executes the callbacks."""
    threads = counted(len(executor.threads), 'threads')
    if isinstance(executor.kind, Unknown):
        return f'no executor found, {threads} assumed'
    assumed = ' assumed, as many as CPUs' if _is_default(executor) else ''
    return f'{executor.kind or "executor"}, {threads}{assumed}'


def short_executor(executor: Executor) -> str:
    """Say it in one column."""
    if isinstance(executor.kind, Unknown):
        return 'none found'
    kind = _SHORT.get(executor.kind or '', (executor.kind or 'executor').removesuffix('Executor'))
    doubt = '?' if _is_default(executor) else ''
    return f'{kind[:LONGEST_EXECUTOR]} {len(executor.threads)}{doubt}'


def _is_default(executor: Executor) -> bool:
    return executor.threads_source == 'default_cpu_count'
