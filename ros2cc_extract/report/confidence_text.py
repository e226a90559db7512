"""The summary of what was found out and what was not, for people."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.spec.confidence import Confidence, Subject, Summary
from ros2cc_extract.spec.model import Unresolved

MOST_OPEN = 10


def confidence_lines(summary: Summary, most: int = MOST_OPEN) -> Iterator[str]:
    """One line of counts, then what is unresolved, where and why, up to ``most`` facts."""
    counts = [_count(c, subject) for subject, c in summary.of.items() if c.total]
    if counts:
        yield f'resolved: {", ".join(counts)}'
    for fact in summary.open[:most]:
        yield f'unresolved: {_open(fact)}'
    left = len(summary.open) - most
    if left > 0:
        what = 'more facts' if most else 'facts'
        yield f'unresolved: {left} {what}, which ros2cc-extract spec lists'


def _count(confidence: Confidence, subject: Subject) -> str:
    remarks = [f'{number} assumed: {rule}' for rule, number in confidence.assumed.items()]
    if confidence.unresolved:
        remarks.append(f'{confidence.unresolved} unresolved')
    told = f' ({"; ".join(remarks)})' if remarks else ''
    return f'{confidence.resolved} of {confidence.total} {subject.value}{told}'


def _open(fact: Unresolved) -> str:
    place = f'{fact.source}: ' if fact.source else ''
    return f'{place}{fact.fact} of {fact.subject}: {fact.reason}'
