"""
Chrome trace JSON against the format that Perfetto and Chromium read.

Rules: "Trace Event Format" (document 1CvAClvFfyA5R-PhYUmn5OOQtYMH4h6I0nSsKchNAySU at
docs.google.com), sections "JSON Object Format", "Complete Events", "Instant Events", "Metadata
Events". Times are microseconds; slices of one thread must nest.
"""

from __future__ import annotations

import json
from typing import Any

import jsonschema
import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.report.trace_formats import write_trace
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.unit import verify_unit
from tests.e2e.conftest import EXAMPLES

IDS = {'pid': {'type': 'integer'}, 'tid': {'type': 'integer'}, 'name': {'type': 'string'}}
TIME = {'type': 'number', 'minimum': 0}


def event(phase: str, **fields: Any) -> dict[str, Any]:
    properties = {'ph': {'const': phase}, **IDS, **fields}
    required = [name for name in properties if name != 'args']
    properties = {'args': {'type': 'object'}, **properties}
    return {'properties': properties, 'required': required, 'additionalProperties': False}


NAMED = {'type': 'object', 'properties': {'name': {'type': 'string'}}, 'required': ['name']}
SCHEMA = {
    'type': 'object',
    'required': ['traceEvents'],
    'properties': {
        'displayTimeUnit': {'enum': ['ms', 'ns']},
        'traceEvents': {
            'type': 'array',
            'items': {
                'type': 'object',
                'oneOf': [
                    event('X', ts=TIME, dur=TIME),
                    event('i', ts=TIME, s={'enum': ['g', 'p', 't']}),
                    event('M', args=NAMED),
                ],
            },
        },
    },
}


@pytest.fixture(scope='module')
def traces() -> dict[str, dict[str, Any]]:
    """Trace by words of the query, of every run of an example that starves."""
    (unit,) = scan([EXAMPLES / 'paper_case2' / 'node.py'], root=EXAMPLES).units
    return {
        result.words: json.loads(write_trace(result.evidence, result.words, 'perfetto'))
        for result in verify_unit(close(unit)).results
        if result.verdict is Verdict.NOT_SATISFIED and result.evidence
    }


def test_every_run_is_of_the_format(traces: dict[str, dict[str, Any]]) -> None:
    assert len(traces) == 5
    for trace in traces.values():
        jsonschema.validate(trace, SCHEMA)


def test_slices_of_a_thread_follow_each_other(traces: dict[str, dict[str, Any]]) -> None:
    for trace in traces.values():
        ends: dict[int, int] = {}
        for each in trace['traceEvents']:
            if each['ph'] == 'X':
                assert each['ts'] == ends.get(each['tid'], 0)
                ends[each['tid']] = each['ts'] + each['dur']
        assert len(set(ends.values())) == 1


def test_a_thread_shows_what_it_runs_and_where_it_repeats(
    traces: dict[str, dict[str, Any]],
) -> None:
    trace = next(t for words, t in traces.items() if words.startswith('on_msg_d never starves'))
    events = trace['traceEvents']
    tracks = {e['tid']: e['args']['name'] for e in events if e['name'] == 'thread_name'}
    thread = [e['name'] for e in events if e['ph'] == 'X' and tracks[e['tid']] == 'thread_0']
    assert thread[:3] == ['wait', 'assigned: on_timer_a', 'running: on_timer_a']
    assert [(e['name'], e['ts']) for e in events if e.get('s') == 'g'] == [
        ('from here on, forever', 3000)
    ]
