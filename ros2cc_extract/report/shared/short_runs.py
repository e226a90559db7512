"""A run in a few steps: those of callbacks stay, what the executor does between them goes."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.verify.results.evidence import Evidence, Moment

_LEAST_FIRST = (
    {'wake', 'poll', 'full', 'free', 'pass', 'ready', 'unready'},
    {'queue', 'leave', 'refuse', 'assign'},
    {'take'},
    {'due', 'arrival'},
    {'end', 'open', 'answer', 'go_on'},
)
"""Kinds of events, those first that a reader misses least."""


def shortened(run: Evidence, most: int) -> Evidence:
    """Leave out the steps that say least, the earliest first, until there are ``most``."""
    places = range(len(run.moments))
    dropped = sorted(places, key=lambda place: (_weight(run.moments[place]), place))
    left_out = set(dropped[: max(0, len(places) - most)])
    if not left_out:
        return run
    kept = [run.moments[place] for place in places if place not in left_out]
    cycle_from = next(
        (n for n, m in enumerate(kept, 1) if run.cycle_from and m.number >= run.cycle_from), None
    )
    return replace(
        run,
        moments=tuple(replace(moment, number=n) for n, moment in enumerate(kept, 1)),
        cycle_from=cycle_from,
        left_out=run.left_out + len(left_out),
    )


def _weight(moment: Moment) -> int:
    """That of the event that says most; of a model of somebody else nothing is known."""
    return max((_rank(s.event.kind if s.event else '') for s in moment.sentences), default=0)


def _rank(kind: str) -> int:
    ranks = (rank for rank, kinds in enumerate(_LEAST_FIRST) if kind in kinds)
    return next(ranks, len(_LEAST_FIRST))
