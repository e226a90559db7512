"""
A run for other viewers: a Mermaid sequence chart, and Chrome trace JSON, which Perfetto opens.

Chrome trace format: "Trace Event Format" of the Chromium project; complete events (``X``),
instant events (``i``) and thread names (``M``) are used.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ros2cc_extract.evidence import Evidence, Moment
from ros2cc_extract.report.json_report import evidence_data, to_text

SUFFIXES = {'text': '.txt', 'json': '.json', 'mermaid': '.mmd', 'perfetto': '.trace.json'}
STEP_US = 1000
"""Drawn length of a step: the model has no time, so all steps are equally long."""


def write_trace(evidence: Evidence, title: str, form: str) -> str:
    """Write a run in one of the formats of ``SUFFIXES``."""
    if form == 'mermaid':
        return mermaid(evidence, title)
    if form == 'perfetto':
        return to_text(chrome_trace(evidence, title))
    if form == 'json':
        return to_text(evidence_data(evidence))
    return f'{title}\n' + ''.join(_text_lines(evidence))


def _text_lines(evidence: Evidence) -> Iterator[str]:
    for moment in evidence.moments:
        if moment.number == evidence.cycle_from:
            yield 'and then for ever:\n'
        said = '; '.join(sentence.text for sentence in moment.sentences)
        places = ', '.join(str(place) for _, place in moment.places)
        yield f'{moment.number:3} {said}' + (f' ({places})' if places else '') + '\n'


def mermaid(evidence: Evidence, title: str) -> str:
    """Write a sequence chart; one participant per process that acts, in order of acting."""
    lanes = dict.fromkeys(s.lane for moment in evidence.moments for s in moment.sentences)
    lines = ['---', f'title: "{_quoted(title)}"', '---', 'sequenceDiagram']
    lines += [f'    participant {lane}' for lane in lanes]
    for moment in evidence.moments:
        if moment.number == evidence.cycle_from:
            lines.append('    loop for ever')
        lines.append(f'    {_arrow(moment)}')
    if evidence.cycle_from is not None:
        lines.append('    end')
    return '\n'.join(lines) + '\n'


def _arrow(moment: Moment) -> str:
    lanes = [sentence.lane for sentence in moment.sentences]
    text = '<br/>'.join(_quoted(sentence.text) for sentence in moment.sentences)
    return f'{lanes[0]}->>{lanes[-1]}: {moment.number}. {text}'


def _quoted(text: str) -> str:
    """Keep what Mermaid reads as syntax out of a text."""
    return text.replace('"', "'").replace(';', ',').replace('#', 'no. ')


def chrome_trace(evidence: Evidence, title: str) -> dict[str, Any]:
    """
    Give the run as trace events: one track per process, one slice per stay in a location.

    A sentence stands as an instant event on the track of the process it is about.
    """
    lanes = {lane: number for number, lane in enumerate(evidence.start, start=1)}
    end = (len(evidence.moments) + 1) * STEP_US
    events = [
        {'ph': 'M', 'name': 'process_name', 'pid': 1, 'tid': 0, 'args': {'name': title}},
        *(_track(lane, number) for lane, number in lanes.items()),
    ]
    for lane, number in lanes.items():
        events += _stays(evidence, lane, number, end)
    for moment in evidence.moments:
        events += _said(moment, lanes)
    return {'displayTimeUnit': 'ms', 'traceEvents': events}


def _track(lane: str, number: int) -> dict[str, Any]:
    return {'ph': 'M', 'name': 'thread_name', 'pid': 1, 'tid': number, 'args': {'name': lane}}


def _stays(evidence: Evidence, lane: str, number: int, end: int) -> Iterator[dict[str, Any]]:
    location, since = evidence.start[lane], 0
    for moment in evidence.moments:
        changed = moment.changes.get(lane)
        if isinstance(changed, str) and changed != location:
            now = moment.number * STEP_US
            yield _slice(location, number, since, now)
            location, since = changed, now
    yield _slice(location, number, since, end)


def _slice(location: str, number: int, since: int, until: int) -> dict[str, Any]:
    return {
        'ph': 'X',
        'name': location,
        'pid': 1,
        'tid': number,
        'ts': since,
        'dur': until - since,
    }


def _said(moment: Moment, lanes: dict[str, int]) -> Iterator[dict[str, Any]]:
    places = {name: str(place) for name, place in moment.places}
    for sentence in moment.sentences:
        yield {
            'ph': 'i',
            's': 't',
            'name': sentence.text,
            'pid': 1,
            'tid': lanes[sentence.lane],
            'ts': moment.number * STEP_US,
            'args': {'step': moment.number, **places},
        }
