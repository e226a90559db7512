"""SARIF: valid by the published schema, and what GitHub needs to show a finding."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from report_samples import CALL, FINDINGS, NOTE, RACE, RUN

from ros2cc_extract.findings.base.fingerprints import fingerprints
from ros2cc_extract.findings.rules.registry import RULES
from ros2cc_extract.report.machine.sarif import MOST_STEPS, sarif
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.results.evidence import Evidence

SCHEMA = Path(__file__).parents[3] / '.cache' / 'sarif-2.1.0.json'


def run_of(*findings: Any, **options: Any) -> Any:
    (run,) = json.loads(sarif(findings, **options))['runs']
    return run


def results_of(*findings: Any, **options: Any) -> Any:
    return run_of(*findings, **options)['results']


@pytest.mark.skipif(
    not SCHEMA.exists(), reason='the published schema is not there: run `make sarif-schema`'
)
def test_valid_by_the_published_schema() -> None:
    schema = json.loads(SCHEMA.read_text(encoding='utf-8-sig'))
    validator = jsonschema.Draft202012Validator(schema)
    for options in ({}, {'docs_url': 'https://example.org/docs', 'line': 'Found 1 error'}):
        assert list(validator.iter_errors(json.loads(sarif(FINDINGS, **options)))) == []


def test_result_of_a_call_chain() -> None:
    (result,) = results_of(CALL)
    flow = result.pop('codeFlows')
    assert result == {
        'ruleId': 'CC101',
        'ruleIndex': 0,
        'level': 'error',
        'message': {'text': f'{CALL.message}\nhelp: give the client a group'},
        'locations': [location(40)],
        'partialFingerprints': {'ros2ccFinding/v1': fingerprints([CALL])[0]},
        'relatedLocations': [
            {'id': 1, **location(10), 'message': {'text': 'client is created here'}}
        ],
    }
    (thread,) = flow[0]['threadFlows']
    assert [lines(step) for step in thread['locations']] == [20, 40]


def location(line: int) -> dict[str, Any]:
    return {
        'physicalLocation': {
            'artifactLocation': {'uri': 'src/arm%20node.py', 'uriBaseId': '%SRCROOT%'},
            'region': {'startLine': line, 'startColumn': 9},
        }
    }


def lines(step: Any) -> int:
    line = step['location']['physicalLocation']['region']['startLine']
    assert isinstance(line, int)
    return line


def test_a_run_has_one_thread_flow_per_lane_in_a_common_order() -> None:
    (result,) = results_of(RACE)
    flows = result['codeFlows'][0]['threadFlows']
    assert {f['id']: [s['executionOrder'] for s in f['locations']] for f in flows} == {
        'executor': [1, 2],
        'thread_0': [2],
        'thread_1': [3],
    }
    assert [lines(step) for step in flows[2]['locations']] == [35]


def test_a_long_run_is_cut_below_the_limit() -> None:
    moments = tuple(replace(RUN.moments[0], number=n) for n in range(1, 2000))
    long = Evidence(start=RUN.start, moments=moments, cycle_from=None, ends=None)
    (result,) = results_of(replace(RACE, run=long))
    (flow,) = result['codeFlows'][0]['threadFlows']
    assert len(flow['locations']) == MOST_STEPS


def test_every_rule_is_described_and_found_by_its_index() -> None:
    run = run_of(*FINDINGS, docs_url='https://example.org/docs/')
    rules = run['tool']['driver']['rules']
    assert [rule['id'] for rule in rules] == [rule.code for rule in RULES]
    assert rules[0]['helpUri'] == 'https://example.org/docs/rules/CC101.html'
    nowhere = run_of(*FINDINGS)['tool']['driver']['rules']
    assert not any('helpUri' in rule for rule in nowhere)
    assert [rules[r['ruleIndex']]['id'] for r in run['results']] == ['CC101', 'CC301', 'CC501']


def test_paths_are_relative_to_the_repository() -> None:
    inside = replace(NOTE, place=Place('/repo/src/a.py', 3))
    outside = replace(NOTE, place=Place('/elsewhere/a.py', 3))
    uris = [
        result['locations'][0]['physicalLocation']['artifactLocation']
        for result in results_of(inside, outside, root='/repo')
    ]
    assert uris == [
        {'uri': 'src/a.py', 'uriBaseId': '%SRCROOT%'},
        {'uri': 'file:///elsewhere/a.py'},
    ]


def test_the_same_findings_give_the_same_bytes() -> None:
    assert sarif(FINDINGS) == sarif(FINDINGS)


def test_the_run_holds_the_last_line() -> None:
    assert run_of(CALL, line='Found 1 error in 1 file')['properties'] == {
        'summary': 'Found 1 error in 1 file'
    }
    assert 'properties' not in run_of(CALL)
