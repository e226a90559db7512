"""Explanations as text, as JSON, and as a diagram."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind, Wait
from ros2cc_extract.extract.live.hang_analysis.samples import Look
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Explanation, Standing, Verdict
from ros2cc_extract.spec.client_server_pairs import reachable

MEANS = {
    Verdict.DEADLOCK: 'nothing is left that could end a wait',
    Verdict.NEVER_SPUN: 'an executor holds nodes, but no thread has ever spun it',
    Verdict.IN_NO_EXECUTOR: 'a node is in no executor, so none of its callbacks runs',
    Verdict.ASLEEP: 'a coroutine could go on, but its executor sleeps until something wakes it',
    Verdict.OUTSIDE: 'nothing in this process keeps the answer from coming',
    Verdict.UNDECIDED: 'something may still end each wait, but what does was not followed',
    Verdict.BUSY: 'callbacks run, or wait for a limited time',
    Verdict.HEALTHY: 'executors wait for work, and no callback runs',
}
_OF_SERVERS = {
    Kind.ANSWER: 'the answer of service',
    Kind.ACTION: 'the answer of action server',
    Kind.SERVER: 'server',
}


def as_text(explanations: Sequence[Explanation]) -> str:
    """Say for each process its verdict, then what waits, beginning with what never ends."""
    shared = ''.join(f'{each}\n' for each in shared_deadlocks(explanations))
    return shared + '\n'.join(''.join(_of_process(each)) for each in explanations)


def _of_process(explanation: Explanation) -> Iterator[str]:
    verdict = explanation.verdict
    yield f'{title(explanation)}: {verdict.value}: {MEANS[verdict]} ({explanation.proof})\n'
    for each in sorted(explanation.standings, key=lambda s: (s.can_end, not s.in_callback)):
        yield from (f'  {line}\n' for line in _lines(each, explanation.look))
    for executor in explanation.look.executors:
        names = ', '.join(executor.nodes) or 'no node'
        yield f'  {executor.cls} of {names}{ready(explanation, executor.entities)}\n'
    if verdict is Verdict.IN_NO_EXECUTOR:
        held = {name for executor in explanation.look.executors for name in executor.nodes}
        for name in explanation.look.nodes:
            if name not in held:
                yield f'  {name} is in no executor: `rclpy.spin_once` and the like take it out\n'
        yield '  help: ros2cc-extract explain CC106\n'


def title(explanation: Explanation) -> str:
    """Name the process and its nodes."""
    names = ', '.join(explanation.look.nodes)
    return f'process {explanation.process}' + (f' ({names})' if names else '')


def _lines(standing: Standing, look: Look) -> Iterator[str]:
    activity, wait = standing.activity, standing.wait
    if wait.kind is Kind.WORK:
        what = 'a thread of a pool' if wait.spins is None else 'it spins an executor'
        yield f'{activity.name} waits for {wait.kind.value}: {what}'
        return
    code = f'{standing.code} ' if standing.code else ''
    place = activity.place
    yield (f'{place.at_line}: {code}{place.called} ({activity.name}) {does(standing, look)}')
    yield from (f'  {each}' for each in standing.reasons)
    if standing.code:
        yield f'  help: ros2cc-extract explain {standing.code}'


def does(standing: Standing, look: Look) -> str:
    """Say what a thread or a coroutine does, as the end of a sentence about it."""
    wait = standing.wait
    if standing.asleep:
        return 'could go on, as what it awaits is done; nothing has woken its executor since'
    if wait.kind is Kind.NOTHING:
        return 'computes, or waits in C code'
    if wait.kind is Kind.SLEEP:
        return 'sleeps'
    forever = '' if standing.can_end else ' forever'
    limit = ' with a time-out' if wait.timed else ''
    return f'waits{forever} for {resource(wait, look)}{limit}'


def resource(wait: Wait, look: Look) -> str:
    """Name what is waited for, and of a service whether a server is there."""
    entity = look.entities.get(wait.resource or 0)
    if wait.kind not in _OF_SERVERS or entity is None:
        return wait.kind.value
    there = '' if entity.there else ', which is not there'
    return f'{_OF_SERVERS[wait.kind]} {entity.key}{there}'


def ready(explanation: Explanation, entities: frozenset[int]) -> str:
    """Name the timers that are due, behind a semicolon; empty where none is."""
    names = sorted(
        explanation.look.entities[each].function or 'a timer'
        for each in entities
        if explanation.look.entities[each].ready
    )
    return f'; due and not taken: {", ".join(names)}' if names else ''


def shared_deadlocks(explanations: Sequence[Explanation]) -> Iterator[str]:
    """Say of each cycle over several processes which they are, and what each waits for."""
    waits = {each.process: list(_stuck_on_others(each)) for each in explanations}
    asked = {process: {other for other, _ in found} for process, found in waits.items()}
    titles = {each.process: title(each) for each in explanations}
    left = sorted(process for process in asked if process in reachable(process, asked))
    while left:
        members = [each for each in left if left[0] in reachable(each, asked)]
        members = [each for each in members if each in reachable(left[0], asked)]
        left = [each for each in left if each not in members]
        waiting = '; '.join(
            f'{titles[process]} waits for {what} of process {other}'
            for process in members
            for other, what in waits[process]
            if other in members
        )
        yield f'deadlock over {len(members)} processes: {waiting}'


def _stuck_on_others(explanation: Explanation) -> Iterator[tuple[int, str]]:
    for each in explanation.standings:
        if not each.can_end:
            what = explanation.look.entities.get(each.wait.resource or 0)
            yield from ((process, str(what.key if what else '')) for process in each.asked)


def as_json(explanation: Explanation) -> str:
    """Give one object."""
    return json.dumps(_as_data(explanation), indent=2) + '\n'


def all_as_json(explanations: Sequence[Explanation], failures: Mapping[int, str]) -> str:
    """Give one object with a list of processes, and those that could not be looked at."""
    found = {
        'deadlocks_over_processes': list(shared_deadlocks(explanations)),
        'processes': [_as_data(each) for each in explanations],
        'not_explained': [{'process': key, 'reason': failures[key]} for key in sorted(failures)],
    }
    return json.dumps(found, indent=2) + '\n'


def _as_data(explanation: Explanation) -> dict[str, Any]:
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
            'asleep': each.asleep,
            'because': list(each.reasons),
            'of_processes': list(each.asked),
            'code': each.code,
        }
        for each in explanation.standings
    ]
    entities = [
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
    return {
        'process': explanation.process,
        'nodes': list(explanation.look.nodes),
        'verdict': explanation.verdict.value,
        'by': explanation.proof,
        'activities': rows,
        'entities': entities,
    }


def as_mermaid(explanations: Sequence[Explanation]) -> str:
    """Draw what waits for what, and what keeps it; an edge leads to a process that is asked."""
    shown = {each.process for each in explanations}
    lines = ['flowchart LR']
    for each in explanations:
        own = list(_drawn(each))
        if len(explanations) > 1:
            own = [f'subgraph p{each.process}["{_plain(title(each))}"]', *own, 'end']
        lines += [f'  {line}' for line in own]
    for each in explanations:
        for index, standing in enumerate(each.standings):
            for process in standing.asked:
                if process in shown:
                    lines.append(f'  w{each.process}_{index} -->|offered by| p{process}')
    return '\n'.join(lines) + '\n'


def _drawn(explanation: Explanation) -> Iterator[str]:
    for index, each in enumerate(explanation.standings):
        if each.wait.kind is Kind.WORK:
            continue
        number = f'{explanation.process}_{index}'
        place = each.activity.place
        yield f'a{number}["{_plain(place.called)} line {place.line}"]'
        what = resource(each.wait, explanation.look)
        yield f'a{number} -->|waits for| w{number}(["{_plain(what)}"])'
        for count, why in enumerate(() if each.can_end else each.reasons):
            yield f'w{number} -->|kept by| k{number}_{count}["{_plain(why)}"]'


def _plain(text: str) -> str:
    return ''.join(c if c.isalnum() or c in ' ,.:/_-' else ' ' for c in text)
