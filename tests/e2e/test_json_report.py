"""``check --output-format json`` against its published schema."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from tests.e2e.conftest import EXAMPLES, ROOT, Run

SCHEMA = json.loads((ROOT / 'ros2cc_extract/report/machine/check.schema.json').read_text())
NODES = (
    EXAMPLES / 'pool_exhaustion' / 'node.py',
    EXAMPLES / 'paper_case2' / 'node.py',
    EXAMPLES / 'executor_never_spun' / 'node.py',
    ROOT / 'tests/scanner_cases/q07_group_from_elsewhere.py',
)


@pytest.mark.parametrize('path', NODES, ids=lambda path: path.parent.name)
def test_report_is_as_its_schema_says(run: Run, path: Path) -> None:
    report = json.loads(run('check', path, '--output-format', 'json').out)
    jsonschema.validate(report, SCHEMA)
    assert report['findings'] != []


def test_the_schema_is_one_and_leaves_nothing_open(run: Run) -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    report = json.loads(run('check', NODES[0], '--output-format', 'json').out)
    report['findings'][0]['colour'] = 'red'
    with pytest.raises(jsonschema.ValidationError, match='colour'):
        jsonschema.validate(report, SCHEMA)


def test_it_holds_the_promises_and_the_last_line_of_the_text(run: Run) -> None:
    path = EXAMPLES / 'service_deadlock' / 'node.py'
    report = json.loads(run('check', path, '--output-format', 'json').out)
    told = run('check', path, '--verdicts').out.splitlines()
    assert report['summary']['line'] == told[-1] == 'Found 1 error, 1 note in 1 file'
    [unit] = report['promises']
    assert unit['unit'] == report['units'][0]['node']['name']
    assert [(each['promise'], each['mark'], each['reason']) for each in unit['promises']] == [
        ('no deadlock', 'broken', 'CC101'),
        ('every wait ends', 'broken', 'CC101'),
        ('no starvation', 'broken', 'CC101'),
        ('no data race', 'kept', ''),
        ('settings have an effect', 'broken', 'CC403'),
    ]


@pytest.mark.parametrize('form', ['json', 'sarif', 'junit', 'html', 'mermaid'])
def test_every_format_says_the_last_line(run: Run, form: str) -> None:
    path = EXAMPLES / 'service_deadlock' / 'node.py'
    assert 'Found 1 error, 1 note in 1 file' in run('check', path, '--output-format', form).out
