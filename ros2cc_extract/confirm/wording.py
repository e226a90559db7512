"""Confirmations as text and as JSON."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict

from ros2cc_extract.confirm.confirming import Confirmation
from ros2cc_extract.confirm.outcomes import Outcome


def as_text(found: Confirmation, release: str | None) -> str:
    """Say what came of one finding, with the evidence below."""
    return ''.join(f'{line}\n' for line in _lines(found, release))


def _lines(found: Confirmation, release: str | None) -> Iterator[str]:
    schedule, judgement = found.schedule, found.judgement
    on = f'rclpy {release}' if release else 'rclpy'
    yield (
        f'{schedule.path}:{schedule.line}: {schedule.code} {judgement.outcome.value} on {on} '
        f'in {found.seconds:.0f} s: {judgement.reason}'
    )
    yield from (f'  {line}' for line in judgement.evidence.splitlines())
    if judgement.outcome is Outcome.CONTRADICTED:
        yield '  this is a defect of the tool, or of the model: please report it with this text'


def summary(found: Sequence[Confirmation]) -> str:
    """Count the outcomes in a line."""
    counts = Counter(each.judgement.outcome for each in found)
    parts = ', '.join(f'{counts[outcome]} {outcome.value}' for outcome in Outcome)
    noun = 'finding' if len(found) == 1 else 'findings'
    return f'{len(found)} {noun}: {parts}'


def as_json(found: Sequence[Confirmation], release: str | None) -> str:
    """Give one object, with the schedule of each finding."""
    rows = [
        {
            'code': each.schedule.code,
            'path': each.schedule.path,
            'line': each.schedule.line,
            'outcome': each.judgement.outcome.value,
            'reason': each.judgement.reason,
            'evidence': each.judgement.evidence,
            'run': list(each.judgement.run),
            'seconds': round(each.seconds, 1),
            'schedule': asdict(each.schedule),
        }
        for each in found
    ]
    return json.dumps({'rclpy': release, 'findings': rows}, indent=2) + '\n'
