"""
A baseline: findings that are known, so that only what a change adds is reported.

A finding is recognised by its fingerprint; code, path and message stand in the file for its
readers.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.errors import InputError
from ros2cc_extract.findings.base.fingerprints import fingerprints, relative
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.json_text import read_json
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.text_escaping import json_text

VERSION = 1
_MEND = 'write it anew by --write-baseline'


@dataclass(frozen=True)
class Compared:
    """
    Findings against a baseline.

    :param new: not in the baseline.
    :param known: in the baseline.
    :param gone: fingerprints of the baseline that were not found any more.
    """

    new: tuple[Finding, ...]
    known: tuple[Finding, ...]
    gone: frozenset[str]


def write_baseline(findings: Iterable[Finding], root: str = '') -> str:
    """Write the baseline of errors and warnings; notes are not kept."""
    kept = [f for f in findings if f.severity is not Severity.NOTE]
    entries = [
        {
            'fingerprint': fingerprint,
            'code': finding.code,
            'path': relative(finding.place.file, root),
            'message': finding.message,
        }
        for finding, fingerprint in zip(kept, fingerprints(kept, root), strict=True)
    ]
    entries.sort(key=lambda entry: (entry['path'], entry['code'], entry['fingerprint']))
    data = {'ros2cc_baseline': VERSION, 'findings': entries}
    return json_text(data)


def read_baseline(text: str, file: str) -> frozenset[str]:
    """
    Read the fingerprints of a baseline.

    :raises InputError: when ``text`` is no baseline of this version.
    """
    try:
        data = read_json(text)
    except json.JSONDecodeError as error:
        place = Place(file, error.lineno, error.colno)
        raise InputError(f'no JSON: {error.msg}', place, _MEND) from None
    except ValueError as error:
        raise InputError(f'no JSON that can be read: {error}', Place(file), _MEND) from None
    if not isinstance(data, dict) or data.get('ros2cc_baseline') != VERSION:
        raise InputError(f'no baseline of version {VERSION}', Place(file), _MEND)
    entries = data.get('findings')
    if not isinstance(entries, list) or not all(_is_entry(entry) for entry in entries):
        raise InputError('a finding of the baseline has no fingerprint', Place(file), _MEND)
    return frozenset(entry['fingerprint'] for entry in entries)


def compare(findings: Sequence[Finding], known: frozenset[str], root: str = '') -> Compared:
    """Divide findings by a baseline, or by the fingerprints of another revision; notes are new."""
    weighty = [f for f in findings if f.severity is not Severity.NOTE]
    marks = dict(zip(map(id, weighty), fingerprints(weighty, root), strict=True))
    new: list[Finding] = []
    old: list[Finding] = []
    for finding in findings:
        (old if marks.get(id(finding)) in known else new).append(finding)
    return Compared(tuple(new), tuple(old), known - set(marks.values()))


def _is_entry(entry: object) -> bool:
    return isinstance(entry, dict) and isinstance(entry.get('fingerprint'), str)
