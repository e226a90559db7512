"""What the model of a unit says of its callbacks; families as in ``generator.queries``."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.waits.hangs import show_hang
from ros2cc_extract.findings.waits.waits import AnyWait, Wait
from ros2cc_extract.spec.display_names import display_names
from ros2cc_extract.spec.model import OF_LOOP
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.results import QueryResult, Verdict

CAN_OVERLAP = 'can_overlap'
SELF_OVERLAP = 'self_overlap'
PROGRESS = 'progress'
NODE_KEPT = 'node_kept'


def verdict_on(family: str, context: Context, *callbacks: Doer) -> QueryResult | None:
    """The verdict of a family on callbacks, in any order; ``None`` if it was not asked."""
    if context.verification is None:
        return None
    names = frozenset(callback.name for callback in callbacks)
    return context.verification.by_callbacks.get((family, names))


def refuting_run(family: str, context: Context, *callbacks: Doer) -> Evidence | None:
    """The run that shows that a property does not hold."""
    result = verdict_on(family, context, *callbacks)
    refuted = result is not None and result.verdict is Verdict.NOT_SATISFIED
    return result.evidence if result is not None and refuted else None


def is_of_repeated(callback: Doer, context: Context) -> bool:
    """
    Return whether the run that holds a callback up is one in which others overlap themselves.

    Whether so many of their runs come together is a matter of rates.
    """
    result = verdict_on(PROGRESS, context, callback)
    return result is not None and bool(result.repeated)


def run_in_which_one_hangs(waits: Sequence[Wait], context: Context) -> Evidence | None:
    """The first run that shows that one of the callbacks never ends, and no more than that."""
    for wait in waits:
        about = {wait.caller.name, *(needed.name for needed in wait.needs)}
        run = shown_hang(wait.caller, about, context)
        if run is not None:
            return run
    return None


def shown_hang(callback: Doer, about: Collection[str], context: Context) -> Evidence | None:
    """The run that shows that a callback never ends, as far as callbacks of ``about`` go."""
    run = refuting_run(PROGRESS, context, callback)
    if run is None:
        return None
    unit = context.unit
    return show_hang(run, about, _exclusive(context), unit.executor.threads, display_names(unit))


def rests_on_absent_service(run: Evidence) -> bool:
    """True for a run with a wait for a service that another program may well offer."""
    return any(event.is_for_service for moment in run.moments for event in moment.events)


def _exclusive(context: Context) -> dict[str, str]:
    """Groups that keep others out; that of an entity of a loop has no other member."""
    groups = {each.name: context.exclusive_group(each) for each in context.unit.callbacks}
    return {
        name: group.name
        for name, group in groups.items()
        if group is not None and group.library != OF_LOOP
    }


def surely_ends(wait: AnyWait, context: Context) -> bool:
    """
    True when the model proves that the callback always ends, the wait included.

    With a time-out it ends in any case, and the question is with what.
    """
    if wait.has_timeout:
        return False
    result = verdict_on(PROGRESS, context, wait.caller)
    return result is not None and result.verdict is Verdict.SATISFIED
