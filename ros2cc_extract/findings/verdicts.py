"""What the model of a unit says of its callbacks; families as in ``generator.queries``."""

from __future__ import annotations

from ros2cc_extract.evidence import Evidence
from ros2cc_extract.findings.rule import Context
from ros2cc_extract.findings.waits import Wait, WaitKind
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.verify import QueryResult, Verdict

CAN_OVERLAP = 'can_overlap'
SELF_OVERLAP = 'self_overlap'
PROGRESS = 'progress'


def verdict_on(family: str, context: Context, *callbacks: Callback) -> QueryResult | None:
    """The verdict of a family on callbacks, in any order; ``None`` if it was not asked."""
    if context.verification is None:
        return None
    names = {callback.name for callback in callbacks}
    found = (r for r in context.verification.results if r.family == family)
    return next((result for result in found if set(result.callbacks) == names), None)


def refuting_run(family: str, context: Context, *callbacks: Callback) -> Evidence | None:
    """The run that shows that a property does not hold."""
    result = verdict_on(family, context, *callbacks)
    refuted = result is not None and result.verdict is Verdict.NOT_SATISFIED
    return result.evidence if result is not None and refuted else None


def surely_ends(wait: Wait, context: Context) -> bool:
    """
    True when the model proves that the callback always ends, the wait included.

    A nested spin and a wait with a time-out are not part of the models.
    """
    if wait.kind is WaitKind.SPUN_FUTURE or wait.has_timeout:
        return False
    result = verdict_on(PROGRESS, context, wait.caller)
    return result is not None and result.verdict is Verdict.SATISFIED
