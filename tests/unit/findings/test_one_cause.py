"""What one cause leaves open in many places and units is one finding."""

from __future__ import annotations

from dataclasses import replace

from finding_units import at, callback, threads, unit

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import EntityKind, Spec, Unresolved

TOO_LONG = 'too long to be followed to its end'
NO_CALLER = "parameter 'node' of Arm.__init__; no caller is known"


def lacking(name: str, *facts: Unresolved) -> Spec:
    return replace(
        unit(threads(2), callback('tick', EntityKind.TIMER)), name=name, unresolved=facts
    )


def fact(subject: str, what: str, reason: str, place: Place) -> Unresolved:
    return Unresolved(subject=subject, fact=what, reason=reason, source=place)


def messages(*units: Spec, diagnostics: tuple[Diagnostic, ...] = ()) -> list[str]:
    found = findings_of(units, diagnostics)
    return [f'{f.place} {f.code} {f.message}' for f in found if f.code.startswith('CC5')]


def test_all_subjects_that_lack_a_fact_for_one_reason_are_in_one_sentence() -> None:
    facts = [fact(name, 'node', NO_CALLER, at(7)) for name in ('grip', 'joint', 'grip')]
    other = fact('grip', 'topic', NO_CALLER, at(7))
    assert messages(lacking('arm', *facts, other)) == [
        f'arm.py:7:9 CC501 node of grip, joint not resolved: {NO_CALLER}',
        f'arm.py:7:9 CC501 topic of grip not resolved: {NO_CALLER}',
    ]


def test_a_cause_in_several_units_is_told_of_the_first_with_their_number() -> None:
    facts = {name: fact(name, 'entities', 'not scanned', at(7)) for name in ('a', 'b', 'c')}
    units = [lacking(name, own) for name, own in facts.items()]
    first = 'arm.py:7:9 CC501 entities of a not resolved: not scanned; the same in'
    assert messages(*units[:2]) == [f'{first} another unit']
    assert messages(*reversed(units)) == [f'{first} 2 more units']


def test_the_same_reason_elsewhere_is_another_finding() -> None:
    facts = [fact('arm', 'entities', 'not scanned', at(line)) for line in (7, 8)]
    assert len(messages(lacking('arm', *facts))) == 2


def test_what_the_scan_has_told_is_not_told_again_for_each_unit() -> None:
    """Neither of the units that lack something, nor of those that were left out for it."""
    cut = Diagnostic(severity=Severity.WARNING, slug='not-followed', place=at(7), message=TOO_LONG)
    left_out = replace(
        cut,
        severity=Severity.NOTE,
        message=f'{TOO_LONG}: unit node is left out, and may have callbacks',
    )
    units = [lacking(name, fact(name, 'entities', TOO_LONG, at(7))) for name in ('a', 'b')]
    assert messages(*units, diagnostics=(cut, left_out)) == [f'arm.py:7:9 CC500 {TOO_LONG}']
    assert messages(diagnostics=(left_out,)) == [f'arm.py:7:9 CC501 {left_out.message}']
