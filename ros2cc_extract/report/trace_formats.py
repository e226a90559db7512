"""
A run for other viewers: a Mermaid sequence chart, Chrome trace JSON, UPPAAL's own layouts.

Chrome trace format: "Trace Event Format" of the Chromium project (document
1CvAClvFfyA5R-PhYUmn5OOQtYMH4h6I0nSsKchNAySU at docs.google.com); complete events (``X``), instant
events (``i``) and thread names (``M``) are used.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ros2cc_extract.report.machine.json_report import evidence_data, to_text
from ros2cc_extract.report.shared.run_lanes import Stay, stays_of
from ros2cc_extract.verify.results.evidence import Evidence, Moment
from ros2cc_extract.verify.uppaal.run import UppaalRun
from ros2cc_extract.verify.uppaal.trace_xml import to_xml
from ros2cc_extract.verify.uppaal.trace_xtr import to_xtr

SUFFIXES = {
    'text': '.txt',
    'json': '.json',
    'mermaid': '.mmd',
    'perfetto': '.trace.json',
    'uppaal': '.xml',
    'xtr': '.xtr',
}
UPPAAL_WRITERS = {'uppaal': to_xml, 'xtr': to_xtr}
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
    if form in UPPAAL_WRITERS and isinstance(evidence.origin, UppaalRun):
        return UPPAAL_WRITERS[form](evidence.origin)
    return f'{title}\n' + ''.join(_text_lines(evidence))


def _text_lines(evidence: Evidence) -> Iterator[str]:
    for moment in evidence.moments:
        if moment.number == evidence.cycle_from:
            yield 'and then forever:\n'
        said = '; '.join(sentence.text for sentence in moment.sentences)
        places = ', '.join(str(place) for _, place in moment.places)
        yield f'{moment.number:3} {said}' + (f' ({places})' if places else '') + '\n'


def mermaid(evidence: Evidence, title: str) -> str:
    """Write a sequence chart; one participant per process that acts, in order of acting."""
    lanes = dict.fromkeys(s.lane for moment in evidence.moments for s in moment.sentences)
    names = {lane: _participant(lane, number) for number, lane in enumerate(lanes)}
    lines = ['---', f'title: "{_quoted(title)}"', '---', 'sequenceDiagram']
    for lane, name in names.items():
        lines.append(f'    participant {name}' + ('' if name == lane else f' as {lane}'))
    for moment in evidence.moments:
        if moment.number == evidence.cycle_from:
            lines.append('    loop forever')
        lines.append(f'    {_arrow(moment, names)}')
    if evidence.cycle_from is not None:
        lines.append('    end')
    return '\n'.join(lines) + '\n'


def _participant(lane: str, number: int) -> str:
    """Stand in for names such as ``P(0)``, whose signs Mermaid reads as its own."""
    return lane if lane.isidentifier() and lane.lower() != 'end' else f'p{number}'


def _arrow(moment: Moment, names: Mapping[str, str]) -> str:
    lanes = [names[sentence.lane] for sentence in moment.sentences]
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
    callbacks = {name for moment in evidence.moments for name, _ in moment.places}
    events = [
        {'ph': 'M', 'name': 'process_name', 'pid': 1, 'tid': 0, 'args': {'name': title}},
        *(_track(lane, number) for lane, number in lanes.items()),
    ]
    for lane, number in lanes.items():
        events += (_slice(stay, number) for stay in stays_of(evidence, lane, callbacks))
    for moment in evidence.moments:
        if moment.number == evidence.cycle_from:
            events.append(_instant('from here on, forever', 'g', 0, moment.number))
        events += _said(moment, lanes)
    return {'displayTimeUnit': 'ms', 'traceEvents': events}


def _track(lane: str, number: int) -> dict[str, Any]:
    return {'ph': 'M', 'name': 'thread_name', 'pid': 1, 'tid': number, 'args': {'name': lane}}


def _slice(stay: Stay, number: int) -> dict[str, Any]:
    return {
        'ph': 'X',
        'name': f'{stay.location}: {stay.callback}' if stay.callback else stay.location,
        'pid': 1,
        'tid': number,
        'ts': stay.since * STEP_US,
        'dur': (stay.until - stay.since) * STEP_US,
    }


def _instant(name: str, scope: str, number: int, step: int) -> dict[str, Any]:
    return {'ph': 'i', 's': scope, 'name': name, 'pid': 1, 'tid': number, 'ts': step * STEP_US}


def _said(moment: Moment, lanes: dict[str, int]) -> Iterator[dict[str, Any]]:
    places = {name: str(place) for name, place in moment.places}
    for sentence in moment.sentences:
        yield {
            **_instant(sentence.text, 't', lanes[sentence.lane], moment.number),
            'args': {'step': moment.number, **places},
        }
