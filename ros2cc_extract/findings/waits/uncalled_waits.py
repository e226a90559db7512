"""
Waits in functions that no known code calls: one line for all of them in one file.

Who calls such a function, if anybody, decides what it holds up; a file of helpers has many.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Hit
from ros2cc_extract.findings.base.wording import listing
from ros2cc_extract.findings.waits.waits import AnyWait, waits_in
from ros2cc_extract.spec.effects import UNCALLED

_NAMED = 3
"""So many of the functions are named."""


def is_uncalled(wait: AnyWait) -> bool:
    """Whether it stands in a function that no known code calls."""
    return bool(_function_of(wait))


def uncalled_hits(waits: Iterable[AnyWait], named: str) -> Iterator[Hit]:
    """One finding for each file; ``named`` is the name of the code that no callback runs."""
    of_files: dict[str, list[AnyWait]] = {}
    for wait in waits:
        of_files.setdefault(wait.place.file, []).append(wait)
    for together in of_files.values():
        yield _hit(together, named)


def _hit(waits: Sequence[AnyWait], named: str) -> Hit:
    first = waits[0]
    functions = tuple(dict.fromkeys(map(_function_of, waits)))
    them = 'them' if len(functions) > 1 else 'it'
    return Hit(
        place=first.place,
        message=f'not decided: {listing(functions, _NAMED)} may wait, here in '
        f'{_what(first)}, and no known code calls {them}',
        help=f'if other code calls {them}, give the waits a time-out',
        subjects=(named,),
        related=tuple(
            Remark(wait.place, f'{_function_of(wait)} may wait here in {_what(wait)}')
            for wait in {wait.place: wait for wait in waits[1:]}.values()
            if wait.place != first.place
        ),
        cause=UNCALLED,
    )


def _what(wait: AnyWait) -> str:
    return waits_in(wait) + (f' for {wait.block.resource}' if wait.block.resource else '')


def _function_of(wait: AnyWait) -> str:
    reason = wait.block.escapes.reason if wait.block.escapes is not None else ''
    function = reason.removeprefix(UNCALLED)
    return function if function != reason and ',' not in function else ''
