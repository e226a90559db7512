"""
What a project demands of its callbacks, decided on the verdicts of its models.

``[tool.ros2cc]``: ``never_together = [["a", "b"]]``, ``can_overlap = [["a", "b"]]``,
``never_starves = ["on_stop"]``. A callback is named as in the unit, or by its function.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from itertools import product

from ros2cc_extract.errors import InputError
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.findings.rules.reading.requirements import UNDECIDED, UNKNOWN_NAME, VIOLATED
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Callback, Spec
from ros2cc_extract.verify.results.results import QueryResult, Verdict, Verification

NEVER_TOGETHER = 'never_together'
CAN_OVERLAP = 'can_overlap'
NEVER_STARVES = 'never_starves'
_FAMILIES = {NEVER_STARVES: 'starvation'}
_NUMBERS = {NEVER_TOGETHER: 2, CAN_OVERLAP: 2, NEVER_STARVES: 1}


@dataclass(frozen=True)
class Requirement:
    """
    One demand.

    :param kind: a key of the table: ``never_together``, ``can_overlap``, ``never_starves``.
    :param names: of the callbacks, as the table has them.
    :param place: of the table.
    """

    kind: str
    names: tuple[str, ...]
    place: Place = field(compare=False)

    @property
    def words(self) -> str:
        """The demand as a clause."""
        named = ' and '.join(self.names)
        return {
            NEVER_TOGETHER: f'{named} never run at the same time',
            CAN_OVERLAP: f'{named} can run at the same time',
            NEVER_STARVES: f'{named} never starves',
        }[self.kind]


def read_requirements(table: Mapping[str, object], place: Place) -> tuple[Requirement, ...]:
    """
    Read the demands of ``[tool.ros2cc]``; other keys of the table are left alone.

    :raises InputError: when a demand is not written as it should be.
    """
    return tuple(
        Requirement(kind, _names(entry, kind, place), place)
        for kind in _NUMBERS
        for entry in _entries(table.get(kind, []), kind, place)
    )


def check_requirements(
    requirements: Sequence[Requirement],
    units: Sequence[Spec],
    verifications: Sequence[Verification],
) -> tuple[Finding, ...]:
    """Give a finding for each demand that is violated, undecided or about nothing."""
    verified = list(zip(units, verifications, strict=True))
    return tuple(f for requirement in requirements for f in _check(requirement, verified))


def _entries(value: object, kind: str, place: Place) -> Sequence[object]:
    if not isinstance(value, list):
        raise _malformed(kind, place)
    return value


def _names(entry: object, kind: str, place: Place) -> tuple[str, ...]:
    names = [entry] if isinstance(entry, str) else entry
    if not isinstance(names, list) or len(names) != _NUMBERS[kind]:
        raise _malformed(kind, place)
    if not all(isinstance(name, str) for name in names):
        raise _malformed(kind, place)
    return tuple(str(name) for name in names)


def _malformed(kind: str, place: Place) -> InputError:
    example = '["on_stop"]' if _NUMBERS[kind] == 1 else '[["on_stop", "on_move"]]'
    return InputError(
        f'{kind} is not a list of callback names', place, f'write {kind} = {example}'
    )


def _check(
    requirement: Requirement, verified: Sequence[tuple[Spec, Verification]]
) -> Iterator[Finding]:
    unknown = [n for n in requirement.names if not any(_named(n, unit) for unit, _ in verified)]
    for name in unknown:
        yield Finding(
            code=UNKNOWN_NAME.code,
            severity=UNKNOWN_NAME.severity,
            place=requirement.place,
            message=f'required: {requirement.words}, but there is no callback {name!r}',
            help='name a callback by its function, or as `ros2cc-extract spec` shows it',
            subjects=(name,),
        )
    if unknown:
        return
    together = [pair for pair in verified if all(_named(n, pair[0]) for n in requirement.names)]
    if not together and requirement.kind == NEVER_TOGETHER:
        yield _apart(requirement, verified)
    for unit, verification in together:
        for callbacks in product(*(_named(name, unit) for name in requirement.names)):
            yield from _decide(requirement, callbacks, unit, verification)


def _named(name: str, unit: Spec) -> list[Callback]:
    return [
        callback
        for callback in unit.callbacks
        if name in (callback.name, callback.function_name, callback.function)
    ]


def _decide(
    requirement: Requirement,
    callbacks: tuple[Callback, ...],
    unit: Spec,
    verification: Verification,
) -> Iterator[Finding]:
    names = {callback.name for callback in callbacks}
    if len(names) < len(callbacks):
        return
    family = _FAMILIES.get(requirement.kind, requirement.kind)
    found = (r for r in verification.results if r.family == family)
    result = next((r for r in found if set(r.callbacks) == names), None)
    if result is None or result.verdict is Verdict.UNDECIDED:
        reason = (result.reason if result else None) or 'the query was not asked'
        yield _finding(UNDECIDED.code, requirement, callbacks, unit, f'is undecided: {reason}')
    elif result.verdict is Verdict.NOT_SATISFIED:
        yield _finding(VIOLATED.code, requirement, callbacks, unit, 'does not hold', result)


def _finding(
    code: str,
    requirement: Requirement,
    callbacks: tuple[Callback, ...],
    unit: Spec,
    outcome: str,
    result: QueryResult | None = None,
) -> Finding:
    places = [(callback, callback.defined or callback.source) for callback in callbacks]
    known = [(callback, place) for callback, place in places if place is not None]
    return Finding(
        code=code,
        severity=UNDECIDED.severity if code == UNDECIDED.code else VIOLATED.severity,
        place=known[0][1] if known else requirement.place,
        message=f'required: {requirement.words}; that {outcome}',
        help=f'change groups or threads, or the requirement in {requirement.place.file}',
        unit=unit.name,
        subjects=(requirement.kind, *(callback.name for callback in callbacks)),
        related=tuple(
            Remark(place, f'{callback.display_name} stands here') for callback, place in known[1:]
        ),
        run=result.evidence if result else None,
    )


def _apart(requirement: Requirement, verified: Sequence[tuple[Spec, Verification]]) -> Finding:
    served = [
        f'{name} by unit {unit.name}'
        for name in requirement.names
        for unit, _ in verified
        if _named(name, unit)
    ]
    return Finding(
        code=VIOLATED.code,
        severity=VIOLATED.severity,
        place=requirement.place,
        message=f'required: {requirement.words}; but they are served by different executors '
        f'({", ".join(served)}), and nothing keeps those apart',
        help='serve both by one executor, in one mutually exclusive group',
        subjects=(requirement.kind, *requirement.names),
    )
