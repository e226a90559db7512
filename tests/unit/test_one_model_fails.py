"""A unit whose model has an error of ours: it is reported, and the other units are judged."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.cli.main import main
from ros2cc_extract.errors import ModelFormatError, ToolNotFoundError
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.pipeline import unit_examination
from ros2cc_extract.pipeline.unit_examination import examine
from ros2cc_extract.pipeline.unit_task import Task
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

EXAMPLES = Path(__file__).parents[2] / 'launch_free_examples'
ERROR = ModelFormatError('-1 is outside the range 0..16 of task_count', Place('two.xml', 162))
DEFECT = 'ModelFormatError: two.xml:162: -1 is outside the range 0..16 of task_count'


def fails_on(name: str) -> object:
    def verified(closed: ClosedSpec, *given: object, **named: object) -> Verification:
        if closed.spec.nodes == (name,):
            raise ERROR
        return verify_unit(closed, *given, **named)  # type: ignore[arg-type]

    return verified


def test_the_other_units_go_on(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for name in ('service_deadlock', 'two_groups'):
        node = (EXAMPLES / name / 'node.py').read_text(encoding='utf-8')
        (tmp_path / f'{name}.py').write_text(node, encoding='utf-8')
    (broken,) = scan([tmp_path / 'two_groups.py']).units
    monkeypatch.setattr(unit_examination, 'verify_unit', fails_on(broken.nodes[0]))
    monkeypatch.chdir(tmp_path)
    out, err = io.StringIO(), io.StringIO()
    assert main(['check', '.', '--no-cache'], out, err) == 1
    assert f'CC500: unit {broken.name} is not verified: {DEFECT}' in out.getvalue()
    assert 'this is a defect of the tool' in out.getvalue()
    assert 'CC101' in out.getvalue()


def test_every_query_of_such_a_unit_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    (unit,) = scan([EXAMPLES / 'two_groups' / 'node.py']).units
    monkeypatch.setattr(unit_examination, 'verify_unit', fails_on(unit.nodes[0]))
    examined = examine(Task(unit, close(unit), Options(), keeps_runs=False))
    asked = verify_unit(close(unit), Options()).results
    assert [(r.formula, r.verdict, r.reason) for r in examined.shown.results] == [
        (r.formula, Verdict.UNDECIDED, f'a defect of this tool: {DEFECT}') for r in asked
    ]
    assert examined.shown.defect == DEFECT
    assert not examined.is_final


def test_a_program_that_is_not_there_is_no_defect(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(*_: object, **__: object) -> Verification:
        raise ToolNotFoundError('verifyta is not there')

    (unit,) = scan([EXAMPLES / 'two_groups' / 'node.py']).units
    monkeypatch.setattr(unit_examination, 'verify_unit', missing)
    with pytest.raises(ToolNotFoundError):
        examine(Task(unit, close(unit), Options(), keeps_runs=False))
