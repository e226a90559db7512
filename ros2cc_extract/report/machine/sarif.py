"""
Findings as SARIF 2.1.0, the way GitHub's code scanning reads it.

Source: OASIS "Static Analysis Results Interchange Format (SARIF) Version 2.1.0", and GitHub's
"SARIF support for code scanning": stable ``ruleId``, paths relative to the repository,
``partialFingerprints``, and at most 1000 locations in a thread flow.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any
from urllib.parse import quote

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.fingerprints import fingerprints, relative
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.findings.base.rule import Rule
from ros2cc_extract.findings.explain import page
from ros2cc_extract.findings.rules.registry import RULES
from ros2cc_extract.report.shared.run_endings import closing_lines
from ros2cc_extract.source_locations import Place
from ros2cc_extract.text_escaping import json_text
from ros2cc_extract.verify.results.evidence import Evidence, Moment, Sentence
from ros2cc_extract.version import __version__

Data = dict[str, Any]

SCHEMA = 'https://json.schemastore.org/sarif-2.1.0.json'
FINGERPRINT = 'ros2ccFinding/v1'
MOST_STEPS = 999
"""Locations in one thread flow; GitHub shows no more."""

_LEVELS = {Severity.ERROR: 'error', Severity.WARNING: 'warning', Severity.NOTE: 'note'}
_RULE_INDEX = {rule.code: index for index, rule in enumerate(RULES)}


def sarif(
    findings: Sequence[Finding], *, line: str = '', root: str = '', docs_url: str = ''
) -> str:
    """
    Write one SARIF log with one run.

    :param line: what the text report ends with.
    :param root: absolute path of the repository; paths below it become relative.
    :param docs_url: where the site of ``docs/`` stands, for ``helpUri``; no address is made up,
        and the whole help text is in the file in any case.
    """
    log = {
        '$schema': SCHEMA,
        'version': '2.1.0',
        'runs': [
            {
                'tool': {'driver': _driver(docs_url)},
                'automationDetails': {'id': 'ros2cc-extract/'},
                'columnKind': 'unicodeCodePoints',
                'originalUriBaseIds': {'%SRCROOT%': {'description': _text('the repository')}},
                'results': list(_results(findings, root)),
                **({'properties': {'summary': line}} if line else {}),
            }
        ],
    }
    return json_text(log)


def _driver(docs_url: str) -> Data:
    return {
        'name': 'ros2cc-extract',
        'semanticVersion': __version__,
        'rules': [_rule(rule, docs_url) for rule in RULES],
    }


def _rule(rule: Rule, docs_url: str) -> Data:
    return {
        'id': rule.code,
        'name': rule.slug,
        'shortDescription': _text(rule.title),
        'fullDescription': _text(rule.what),
        'help': {'text': rule.mend, 'markdown': page(rule)},
        **({'helpUri': f'{docs_url.rstrip("/")}/rules/{rule.code}.html'} if docs_url else {}),
        'defaultConfiguration': {'level': _LEVELS[rule.severity]},
        'properties': {'tags': ['ros2', 'concurrency'], 'precision': 'high'},
    }


def _results(findings: Sequence[Finding], root: str) -> Iterator[Data]:
    for finding, fingerprint in zip(findings, fingerprints(findings, root), strict=True):
        yield {
            'ruleId': finding.code,
            'ruleIndex': _RULE_INDEX[finding.code],
            'level': _LEVELS[finding.severity],
            'message': _text(_message(finding)),
            'locations': [_location(finding.place, root)],
            'partialFingerprints': {FINGERPRINT: fingerprint},
            **_flows(finding, root),
            **_related(finding, root),
            **_on_node(finding),
        }


def _on_node(finding: Finding) -> Data:
    return {'properties': {'onNode': asdict(finding.on_node)}} if finding.on_node else {}


def _message(finding: Finding) -> str:
    return f'{finding.message}\nhelp: {finding.help}' if finding.help else finding.message


def _flows(finding: Finding, root: str) -> Data:
    flows = []
    if finding.chain:
        steps = [*finding.chain, Remark(finding.place, finding.message)]
        flows.append({'threadFlows': [{'locations': [_step(remark, root) for remark in steps]}]})
    if finding.run is not None and finding.run.moments:
        flows.append(_run_flow(finding.run, finding.place, root))
    return {'codeFlows': flows} if flows else {}


def _run_flow(run: Evidence, fallback: Place, root: str) -> Data:
    """One thread flow per lane of the run, tied together by ``executionOrder``."""
    lanes = dict.fromkeys(s.lane for moment in run.moments for s in moment.sentences)
    return {
        'message': _text('; '.join(('a run of the model that shows it', *closing_lines(run)))),
        'threadFlows': [
            {
                'id': lane,
                'message': _text(lane),
                'locations': _lane(run, lane, fallback, root)[:MOST_STEPS],
            }
            for lane in lanes
        ],
    }


def _lane(run: Evidence, lane: str, fallback: Place, root: str) -> list[Data]:
    return [
        {
            **_step(Remark(_place_of(moment, sentence, fallback), sentence.text), root),
            'executionOrder': moment.number,
        }
        for moment in run.moments
        for sentence in moment.sentences
        if sentence.lane == lane
    ]


def _place_of(moment: Moment, sentence: Sentence, fallback: Place) -> Place:
    named = (place for name, place in moment.places if name in sentence.text)
    return next(named, fallback)


def _step(remark: Remark, root: str) -> Data:
    return {'location': {**_location(remark.place, root), 'message': _text(remark.text)}}


def _related(finding: Finding, root: str) -> Data:
    if not finding.related:
        return {}
    return {
        'relatedLocations': [
            {'id': number, **_location(remark.place, root), 'message': _text(remark.text)}
            for number, remark in enumerate(finding.related, start=1)
        ]
    }


def _location(place: Place, root: str) -> Data:
    path = relative(place.file, root)
    artifact: Data = {'uri': _as_uri(path)}
    if not path.startswith('/'):
        artifact['uriBaseId'] = '%SRCROOT%'
    region: Data = {'startLine': max(place.line, 1)}
    if place.column:
        region['startColumn'] = place.column
    return {'physicalLocation': {'artifactLocation': artifact, 'region': region}}


def _as_uri(path: str) -> str:
    quoted = quote(path)
    return f'file://{quoted}' if path.startswith('/') else quoted


def _text(text: str) -> Data:
    return {'text': text}
