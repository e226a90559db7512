"""Waits of executors of one program for each other, which no unit alone shows."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.base.rule import Context, Doer, Hit, Rule
from ros2cc_extract.findings.rules.deadlocks import lock_order, never_ends
from ros2cc_extract.findings.rules.deadlocks.undecided_wait import (
    OUTSIDE_WAIT,
    UNDECIDED,
    find_undecided,
)
from ros2cc_extract.findings.waits.stuck_callbacks import Stuck
from ros2cc_extract.findings.waits.verdicts import is_of_repeated
from ros2cc_extract.spec.joined_executors import Joined, enders_of
from ros2cc_extract.verify.results.results import Verification

_OPEN = (UNDECIDED.code, OUTSIDE_WAIT.code)


def findings_of_joined(joined: Joined, verification: Verification | None) -> tuple[Finding, ...]:
    """What stands still only because of several executors, or is not decided of them."""
    context = Context(joined.spec, verification)

    def concerns(together: Sequence[Stuck]) -> bool:
        doers = [each.doer for each in together]
        names = [each.name for each in doers]
        if joined.is_of_processes:  # others of its process may keep the server from answering
            names += [name for each in together for name in each.enders]
        # The threads of a joined unit are no number of the program's.
        is_by_crowd = any(is_of_repeated(doer, context) for doer in doers)
        return joined.executors_of(names) > 1 and not is_by_crowd

    def several(hits: Iterable[Hit]) -> Iterator[Hit]:
        for hit in hits:
            if joined.executors_of(hit.subjects) > 1:
                yield replace(hit, message=hit.message + joined.between)

    rules = (
        (never_ends.RULE, tuple(several(never_ends.hits_of(context, concerns)))),
        (lock_order.RULE, tuple(several(lock_order.find(context)))),
        (UNDECIDED, tuple(_undecided(joined, context))),
    )
    return tuple(finding for rule, hits in rules for finding in _signed(rule, hits, context))


def _signed(rule: Rule, hits: tuple[Hit, ...], context: Context) -> Iterator[Finding]:
    yield from replace(rule, find=lambda _: iter(hits)).check(context)


def _undecided(joined: Joined, context: Context) -> Iterator[Hit]:
    """Waits that a callback on another executor ends."""
    for hit in find_undecided(context):
        if any(_is_across(context.doer_by_name[name], hit, joined) for name in hit.subjects):
            yield hit


def _is_across(doer: Doer, hit: Hit, joined: Joined) -> bool:
    blocks = (block for block in doer.blocking if block.source == hit.place)
    enders = {name for block in blocks for name in enders_of(block, joined.spec)}
    return joined.executors_of((doer.name, *enders)) > 1


def without_reported(found: Iterable[Finding], reported: Iterable[Finding]) -> tuple[Finding, ...]:
    """
    Leave out what a unit alone shows: a circle with a wait about which the unit says more.

    A note only says what may happen to the wait, and no more than the circle.
    """
    reported = tuple(reported)
    of_waits = (each for each in reported if each.code[:3] == 'CC1' and each.code not in _OPEN)
    waits = {_line(each) for each in of_waits if each.severity is not Severity.NOTE}
    lines = {_line(each) for each in reported}
    return tuple(
        each
        for each in found
        if (waits if each.code not in _OPEN else lines).isdisjoint(_lines(each))
    )


def _line(finding: Finding) -> tuple[str, int | None]:
    return finding.place.file, finding.place.line


def _lines(finding: Finding) -> set[tuple[str, int | None]]:
    related = {(each.place.file, each.place.line) for each in finding.related}
    return {_line(finding), *related}
