"""The summary of what was found out and what was not, for people."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ros2cc_extract.spec.confidence import Confidence, Subject, Summary
from ros2cc_extract.spec.model import Unresolved

MOST_OPEN = 10
MOST_RULES = 5


def confidence_lines(summary: Summary, most: int = MOST_OPEN) -> Iterator[str]:
    """
    One line of counts, by which rules facts were assumed, and what is unresolved, where and why.

    :param most: how many facts that are unresolved are listed.
    """
    counts = [_count(c, subject) for subject, c in summary.of.items() if c.total]
    if counts:
        yield f'resolved: {", ".join(counts)}'
    yield from _rules(summary)
    for fact in summary.open[:most]:
        yield f'unresolved: {_open(fact)}'
    left = len(summary.open) - most
    if left > 0:
        what = 'more facts' if most else 'facts'
        yield f'unresolved: {left} {what}, which ros2cc-extract spec lists'


def _count(confidence: Confidence, subject: Subject) -> str:
    """Count what was assumed, over all claims; the rules are listed on lines of their own."""
    assumed = sum(confidence.assumed.values())
    remarks = [f'{assumed} by assumption'] if assumed else []
    if confidence.unresolved:
        remarks.append(f'{confidence.unresolved} unresolved')
    more = f' ({", ".join(remarks)})' if remarks else ''
    return f'{confidence.resolved + assumed} of {confidence.total} {subject.value}{more}'


def _rules(summary: Summary) -> Iterator[str]:
    """Those by which most was assumed come first."""
    used = Counter[str]()
    for confidence in summary.of.values():
        used.update(confidence.assumed)
    rules = sorted(used, key=lambda rule: (-used[rule], rule))
    for rule in rules[:MOST_RULES]:
        yield f'assumed: {rule}' if used[rule] == 1 else f'assumed: {rule} ({used[rule]} facts)'
    left = len(rules) - MOST_RULES
    if left > 0:
        words = 'one more rule' if left == 1 else f'{left} more rules'
        yield f'assumed: {words}, which ros2cc-extract spec lists'


def _open(fact: Unresolved) -> str:
    place = f'{fact.source}: ' if fact.source else ''
    return f'{place}{fact.fact} of {fact.subject}: {fact.reason}'
