"""An explanation as text, as JSON, and as a diagram."""

from __future__ import annotations

import json
from collections.abc import Iterator

from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind, Wait
from ros2cc_extract.extract.live.hang_analysis.samples import Look
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Explanation, Standing, Verdict

NOT_PROVEN = 'from the wait-for graph, not proven by the model'
_MEANS = {
    Verdict.DEADLOCK: 'what waits here has nobody left who could end it',
    Verdict.NOBODY_SPINS: 'an executor holds nodes, and no thread has ever spun it',
    Verdict.OUTSIDE: 'whoever is to answer is not stopped by anything in this process',
    Verdict.UNDECIDED: 'something may still end what waits; who does was not followed',
    Verdict.BUSY: 'callbacks run, or wait for a time that comes',
    Verdict.HEALTHY: 'executors wait for work, no callback runs',
}


def as_text(pid: int, explanation: Explanation) -> str:
    """Tell the verdict, then who waits, those who wait for ever first."""
    verdict = explanation.verdict
    lines = [f'process {pid}: {verdict.value}: {_MEANS[verdict]} ({NOT_PROVEN})']
    for each in sorted(explanation.standings, key=lambda s: (s.can_end, not s.in_callback)):
        lines += _lines(each, explanation.look)
    for executor in explanation.look.executors:
        names = ', '.join(executor.nodes) or 'no node'
        lines.append(f'  {executor.cls} of {names}{_ready(explanation, executor.entities)}')
    return '\n'.join(lines) + '\n'


def _lines(standing: Standing, look: Look) -> Iterator[str]:
    place, wait = standing.activity.place, standing.wait
    if wait.kind is Kind.WORK:
        yield f'  {standing.activity.name}: waits for {wait.kind.value}'
        return
    ends = '' if standing.can_end else ' for ever'
    code = f'{standing.code} ' if standing.code else ''
    where = f'  {place.file}:{place.line}: {code}{place.function} in {standing.activity.name} '
    if wait.kind is Kind.NOTHING:
        yield f'{where}computes, or waits in C'
    elif wait.kind is Kind.SLEEP:
        yield f'{where}sleeps'
    else:
        limit = ' with a time-out' if wait.timed else ''
        yield f'{where}waits{ends} for {_resource(wait, look)}{limit}'
    yield from (f'    {each}' for each in standing.waits_for)
    if standing.code:
        yield f'    help: ros2cc-extract explain {standing.code}'


def _resource(wait: Wait, look: Look) -> str:
    """Name what is waited for, a service with its name and whether a server is there."""
    entity = look.entities.get(wait.resource or 0)
    if wait.kind is not Kind.ANSWER or entity is None:
        return wait.kind.value
    return f'{wait.kind.value}, {entity.key}' + ('' if entity.there else ', which nobody offers')


def _ready(explanation: Explanation, entities: frozenset[int]) -> str:
    names = sorted(
        explanation.look.entities[each].function or 'a timer'
        for each in entities
        if explanation.look.entities[each].ready
    )
    return f'; due and not taken: {", ".join(names)}' if names else ''


def as_json(pid: int, explanation: Explanation) -> str:
    """Give one object."""
    rows = [
        {
            'thread': each.activity.name,
            'function': each.activity.place.function,
            'path': each.activity.place.file,
            'line': each.activity.place.line,
            'in_callback': each.in_callback,
            'waits_for': each.wait.kind.name.lower(),
            'timed': each.wait.timed,
            'moved': each.moved,
            'can_end': each.can_end,
            'because': list(each.waits_for),
            'code': each.code,
        }
        for each in explanation.standings
    ]
    groups = [
        {
            'node': each.node,
            'kind': each.kind,
            'function': each.function,
            'service': each.key,
            'open': each.active is None,
            'ready': each.ready,
        }
        for each in explanation.look.entities.values()
    ]
    found = {
        'process': pid,
        'verdict': explanation.verdict.value,
        'by': NOT_PROVEN,
        'activities': rows,
        'entities': groups,
    }
    return json.dumps(found, indent=2) + '\n'


def as_mermaid(explanation: Explanation) -> str:
    """Draw who waits for what, and what keeps it."""
    lines = ['flowchart LR']
    for index, each in enumerate(explanation.standings):
        if each.wait.kind is Kind.WORK:
            continue
        place = each.activity.place
        lines.append(f'  a{index}["{_plain(place.function)} line {place.line}"]')
        lines.append(f'  a{index} -->|waits for| w{index}(["{_plain(each.wait.kind.value)}"])')
        for number, why in enumerate(each.waits_for):
            lines.append(f'  w{index} -->|kept by| k{index}_{number}["{_plain(why)}"]')
    return '\n'.join(lines) + '\n'


def _plain(text: str) -> str:
    return ''.join(c if c.isalnum() or c in ' ,.:/_-' else ' ' for c in text)
