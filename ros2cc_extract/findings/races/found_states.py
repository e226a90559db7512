"""
What a write that comes in between changes of what a test has found.

Nothing, where it stores just that. And it does not come in between at all where each acts in its
own state: one stores something where it has found ``None``, and the other only where it has found
something else.

Why that is so: between the test of the one and its write the other finds that state, too, as long
as no third code changes it. If the other has asked before that, its state was another one then,
so somebody else has stored something between its test and its write. The first who does so in any
run is no such pair, and is told: of two that find the same, of two runs of one, or of one that
does not ask.
"""

from __future__ import annotations

import ast

from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.races.critical_sections import writes_of
from ros2cc_extract.findings.races.uses import Use
from ros2cc_extract.spec.effects import (
    FOUND_FALSE,
    FOUND_NONE,
    FOUND_OTHER,
    FOUND_SOME,
    FOUND_THIS,
    FOUND_TRUE,
)

_OPPOSITES = (
    {FOUND_NONE, FOUND_SOME},
    {FOUND_NONE, FOUND_TRUE},
    {FOUND_FALSE, FOUND_TRUE},
)


def _leaves_as_found(first: Use, second: Use) -> bool:
    """Whether a write stores what the test of another has found: then that still holds."""
    found, write = first.access.found, second.access
    is_empty = found in (FOUND_NONE, FOUND_FALSE)
    return (is_empty and write.clears) or (found == FOUND_FALSE and write.lowers)


def store_alike(one: Use, other: Use) -> bool:
    """Whether both store ``None``, or both what else is false: the order does not matter."""
    ours, theirs = one.access, other.access
    return (ours.clears and theirs.clears) or (ours.lowers and theirs.lowers)


def changes_nothing(first: Use, second: Use, context: Context | None) -> bool:
    """
    Whether what comes in between is what was found, or the ``False`` that is stored in any case.

    Two that both test before they store the same may both act on it, and one that meets ``None``
    instead of an object may fail.

    :param context: ``None`` where not all code is known that may store something there.
    """
    is_lowered = first.access.lowers and second.access.lowers and not second.access.rests
    return (
        is_lowered
        or _leaves_as_found(first, second)
        or (context is not None and _acts_in_other_state(first, second, context))
    )


def _acts_in_other_state(first: Use, second: Use, context: Context) -> bool:
    """
    Whether ``second`` writes in states only that no code brings about behind ``first``'s test.

    Two runs of one callback may overlap: that is told of itself.
    """
    found, name = first.access.found, first.access.name
    if found is None or not _is_opposite(found, second.access.found):
        return False
    everybody: tuple[Doer, ...] = (*context.unit.callbacks, *context.unit.activities)
    writing = [doer for doer in everybody if name in writes_of(doer)]
    others = [doer for doer in writing if doer.name != first.doer.name]
    return (
        second.doer.name != first.doer.name
        and all(doer.count == 1 for doer in writing)
        and all(
            _is_opposite(found, write.found) for doer in others for write in writes_of(doer)[name]
        )
    )


def _is_opposite(one: str, other: str | None) -> bool:
    """Whether nothing can be both."""
    if other is None:
        return False
    if {one, other} in _OPPOSITES:
        return True
    states = sorted((one, other), key=lambda found: not found.startswith(FOUND_THIS))
    if not states[0].startswith(FOUND_THIS):
        return False
    this, text = states[0].removeprefix(FOUND_THIS), states[1]
    if text.startswith(FOUND_OTHER):
        return text.removeprefix(FOUND_OTHER) == this
    try:
        value = ast.literal_eval(this)
        if text.startswith(FOUND_THIS):
            return bool(value != ast.literal_eval(text.removeprefix(FOUND_THIS)))
    except (SyntaxError, ValueError):
        return False
    return text == FOUND_NONE or text == (FOUND_FALSE if value else FOUND_TRUE)
