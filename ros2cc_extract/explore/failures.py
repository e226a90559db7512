"""What goes wrong in a schedule: a hang, an exception, a lost update."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from enum import Enum
from pathlib import Path
from typing import Any

from ros2cc_extract.confirm.hangs import stand_in_both
from ros2cc_extract.confirm.observations import Row, Sample
from ros2cc_extract.confirm.outcomes import APART_S
from ros2cc_extract.extract.live.hang_analysis.formats import MEANS, as_text, does
from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind as Wait
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import (
    Explanation,
    Standing,
    Verdict,
)
from ros2cc_extract.light_dataclasses import dataclass

_OF_LIBRARIES = re.compile(r'/(site-packages|dist-packages|lib/python3[.\d]*)/')
_OF_TOOL = f'{Path(__file__).resolve().parents[1]}{os.sep}'
# How a program is ended from outside.
_ENDS = frozenset(
    {'KeyboardInterrupt', 'SystemExit', 'ExternalShutdownException', 'GeneratorExit'}
)
# Time is no wait; and whether a node outside answers is not for the program to decide.
_UNREPORTED = (Wait.NOTHING, Wait.SLEEP, Wait.WORK, Wait.ANSWER, Wait.ACTION, Wait.SERVER)


class Kind(Enum):
    """What went wrong."""

    HANG = 'hang'
    STANDS = 'stands'
    EXCEPTION = 'exception'
    LOST_UPDATE = 'lost update'


@dataclass(frozen=True, kw_only=True)
class Failure:
    """
    :param file, line: of the program.
    :param words: what was seen, in a clause.
    :param evidence: the explanation of ``why``, or the frames of the exception.
    :param step: after how many choices of its schedule it was noticed; 0 where that is not known.
    """

    kind: Kind
    file: str
    line: int
    words: str
    evidence: str = ''
    step: int = 0

    def is_like(self, other: Failure) -> bool:
        """Whether it is the same failure, seen again."""
        same = (self.kind, self.file, self.line) == (other.kind, other.file, other.line)
        alike = self.kind is not Kind.EXCEPTION or _head(self.words) == _head(other.words)
        return same and alike


def _head(words: str) -> str:
    return words.partition(':')[0]


def hang(samples: Sequence[Sample]) -> Failure | None:
    """Something stands, far enough apart, and nothing is left that could end its wait."""
    for later in samples[-1:]:
        for earlier in samples:
            if later.at - earlier.at < APART_S:
                break
            found = _hang(earlier.explanation, later.explanation, later.at - earlier.at)
            if found is not None:
                return found
    return None


def _hang(before: Explanation, after: Explanation, seconds: float) -> Failure | None:
    stuck = stand_in_both(before, after, lambda each: not each.can_end and not each.moved)
    page = as_text((after,))
    if stuck:
        first = min(stuck, key=lambda each: (not each.in_callback, each.activity.place.at_line))
        words = f'{_who(first)} {does(first, after.look)}, and nothing is left that could end it'
        return _at(first, Kind.HANG, words, page)
    crossed = _at_locks(before, after)
    if crossed:
        lines = ' and '.join(str(each.activity.place.line) for each in crossed)
        words = f'every callback at work waits for a lock, at lines {lines}, for {seconds:.0f} s'
        return _at(crossed[0], Kind.HANG, words, page)
    for verdict in (Verdict.NEVER_SPUN, Verdict.ASLEEP):
        if before.verdict is after.verdict is verdict and after.standings:
            asleep = [each for each in after.standings if each.asleep] or list(after.standings)
            return _at(asleep[0], Kind.HANG, MEANS[verdict], page)
    return None


def _at_locks(before: Explanation, after: Explanation) -> list[Standing]:
    """All that is in a callback, where nothing else is but waits for locks."""
    inside = [each for each in after.standings if each.in_callback]
    if len(inside) < 2 or not all(map(_waits_for_lock, inside)):
        return []
    found = stand_in_both(before, after, lambda each: each.in_callback and _waits_for_lock(each))
    found.sort(key=lambda each: each.activity.place.line)
    return found if len(found) == len(inside) else []


def _waits_for_lock(standing: Standing) -> bool:
    return standing.wait.kind is Wait.LOCK and not standing.moved and not standing.wait.timed


def stands(samples: Sequence[Sample]) -> Failure | None:
    """A callback has stood at one wait all the time, and it is not decided whether it ends."""
    if len(samples) < 2:
        return None
    first, last = samples[0], samples[-1]

    def is_meant(each: Standing) -> bool:
        is_counted = each.wait.kind not in _UNREPORTED and not each.wait.timed
        return each.in_callback and is_counted and not each.moved

    for each in stand_in_both(first.explanation, last.explanation, is_meant):
        seconds = last.at - first.at
        words = (
            f'{_who(each)} {does(each, last.explanation.look)} for {seconds:.0f} s and more; '
            'whether that ever ends is not decided'
        )
        return _at(each, Kind.STANDS, words, as_text((last.explanation,)))
    return None


def _who(standing: Standing) -> str:
    return standing.activity.place.called


def _at(standing: Standing, kind: Kind, words: str, evidence: str) -> Failure:
    place = standing.activity.place
    return Failure(kind=kind, file=place.file, line=place.line, words=words, evidence=evidence)


def exception(row: Row) -> Failure | None:
    """Return the failure of a row `failed`, if the program had a part in it."""
    name, frames = str(row['type']), [(str(f[0]), int(f[1]), str(f[2])) for f in row['frames']]
    own = [f for f in frames if not (_OF_LIBRARIES.search(f[0]) or f[0].startswith(_OF_TOOL))]
    if name in _ENDS or not own:
        return None
    file, line, _ = own[-1]
    shown = '\n'.join(f'{Path(f).name}:{number} in {where}' for f, number, where in own)
    words = f'{name}: {row["text"]}'
    return Failure(
        kind=Kind.EXCEPTION,
        file=file,
        line=line,
        words=words,
        evidence=shown,
        step=len(row['choices']),
    )


def lost_update(row: Row) -> Failure:
    """Return the failure of a row `lost`."""
    name = str(row['name']).rpartition('.')[2]
    words = (
        f'{name} was {row["read"]} when line {row["read_line"]} had read it, another thread set '
        f'it to {row["other"]}, and line {row["line"]} then to {row["own"]}'
    )
    return Failure(
        kind=Kind.LOST_UPDATE,
        file=str(row['file']),
        line=int(row['line']),
        words=words,
        step=len(row['choices']),
    )


def as_row(failure: Failure) -> dict[str, Any]:
    """As in JSON."""
    return {
        'kind': failure.kind.value,
        'path': failure.file,
        'line': failure.line,
        'what': failure.words,
        'evidence': failure.evidence,
    }
