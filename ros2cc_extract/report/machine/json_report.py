"""The JSON objects of ``verify`` and ``check``, as plain data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from ros2cc_extract.compare.merge import Difference
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.findings.promises import Judgement
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.report.shared.last_line import last_line
from ros2cc_extract.spec.confidence import Summary, confidence_in
from ros2cc_extract.spec.yaml.yaml_io import spec_to_data
from ros2cc_extract.text_escaping import json_text
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.load import Load
from ros2cc_extract.verify.results.results import QueryResult, Verification, with_fewer_runs

Data = dict[str, Any]


def to_text(data: object) -> str:
    """Write plain data as JSON text with a final newline."""
    return json_text(data)


def verification_data(verification: Verification) -> Data:
    """One object per model; queries in the order of the ``.q`` file."""
    verification = with_fewer_runs(verification)
    return {
        'model': verification.model,
        'profile': verification.profile,
        'text': verification.text,
        'engine': verification.engine,
        'states': verification.states,
        'transitions': verification.transitions,
        'seconds': verification.seconds,
        'peak_mb': verification.peak_mb,
        'complete': verification.complete,
        'assumptions': list(verification.assumptions),
        'notes': list(verification.notes),
        'queries': [_query_data(result) for result in verification.results],
    }


def check_data(checked: Checked) -> Data:
    """The object of ``check``: units, verdicts, promises, findings, summary."""
    verdicts = map(verification_data, checked.verifications)
    return {
        'units': [spec_to_data(unit) for unit in checked.units],
        'verdicts': [_without_cost(each) for each in verdicts],
        'promises': [
            {'unit': unit.name, 'promises': [_judgement_data(each) for each in judgements]}
            for unit, judgements in zip(checked.units, checked.promises, strict=True)
        ],
        'findings': [_finding_data(finding) for finding in checked.findings],
        'summary': {**checked.summary, 'line': last_line(checked.summary)},
        'confidence': confidence_data(confidence_in(checked.units)),
    }


def _judgement_data(judgement: Judgement) -> Data:
    return {
        'promise': judgement.promise.value,
        'mark': judgement.mark.value,
        'reason': judgement.reason,
    }


def confidence_data(confidence: Summary) -> Data:
    """Counts by subject, and each unresolved fact with reason and place."""
    counts = {
        subject.name.lower(): {
            'resolved': counted.resolved,
            'assumed': dict(counted.assumed),
            'unresolved': counted.unresolved,
        }
        for subject, counted in confidence.of.items()
    }
    unresolved = [
        {
            'subject': fact.subject,
            'fact': fact.fact,
            'reason': fact.reason,
            'place': str(fact.source) if fact.source else None,
        }
        for fact in confidence.open
    ]
    return {**counts, 'unresolved': unresolved}


def _without_cost(data: Data) -> Data:
    """A check says the same on every machine; what a search costs is reported by ``verify``."""
    queries = [{k: v for k, v in query.items() if k != 'seconds'} for query in data['queries']]
    rest = {key: value for key, value in data.items() if key not in ('seconds', 'peak_mb')}
    return {**rest, 'queries': queries}


def differences_data(differences: Sequence[Difference]) -> list[Data]:
    """One object per difference of two specifications."""
    return [
        {
            'kind': difference.kind.value,
            'unit': difference.unit,
            'subject': difference.subject,
            'fact': difference.fact,
            'left': difference.left,
            'right': difference.right,
            'left_place': str(difference.left_place) if difference.left_place else None,
            'right_place': str(difference.right_place) if difference.right_place else None,
            'announced': difference.marked,
        }
        for difference in differences
    ]


def _query_data(result: QueryResult) -> Data:
    return {
        'family': result.family,
        'formula': result.formula,
        'words': result.words,
        'callbacks': list(result.callbacks),
        'verdict': result.verdict.value,
        'reason': result.reason,
        'seconds': result.seconds,
        **({'load': _load_data(result.load)} if result.load else {}),
        'trace': evidence_data(result.evidence) if result.evidence else None,
    }


def _load_data(load: Load) -> Data:
    return {
        'kind': load.kind.value,
        'words': load.words,
        'before': load.before,
        'own': load.own,
        'runs': load.runs,
        'busy': list(load.busy),
        'unknown': list(load.unknown),
    }


def evidence_data(evidence: Evidence) -> list[Data]:
    """
    One object per step; the first step of an endless cycle carries ``cycle_start``.

    Also those that no words are said of; of a finding's run those that have a part in it.
    """
    in_full = bool(evidence.steps) and not evidence.left_out
    moments = evidence.steps if in_full else evidence.moments
    cycle_from = evidence.cycle_step if in_full else evidence.cycle_from
    return [
        {
            'step': moment.number,
            'text': [sentence.text for sentence in moment.sentences],
            'lanes': [sentence.lane for sentence in moment.sentences],
            'places': {name: str(place) for name, place in moment.places},
            'changes': dict(moment.changes),
            **({'edges': list(moment.edges)} if in_full else {}),
            **({'cycle_start': True} if moment.number == cycle_from else {}),
        }
        for moment in moments
    ]


def _finding_data(finding: Finding) -> Data:
    return {
        'code': finding.code,
        'severity': finding.severity.value,
        'path': finding.place.file,
        'line': finding.place.line,
        'column': finding.place.column,
        'message': finding.message,
        'help': finding.help,
        'unit': finding.unit,
        'subjects': list(finding.subjects),
        'evidence': _finding_evidence(finding),
        **({'on_node': asdict(finding.on_node)} if finding.on_node else {}),
    }


def _finding_evidence(finding: Finding) -> Data:
    return {
        'chain': [_remark_data(remark) for remark in finding.chain],
        'related': [_remark_data(remark) for remark in finding.related],
        'run': evidence_data(finding.run) if finding.run else None,
        'closing': finding.run.closing if finding.run else '',
        'left_out': finding.run.left_out if finding.run else 0,
    }


def _remark_data(remark: Remark) -> Data:
    return {'place': str(remark.place), 'text': remark.text}
