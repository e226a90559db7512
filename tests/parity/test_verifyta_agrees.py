"""
UPPAAL's own checker gives our verdicts, and runs that we can replay.

Asked where it is installed and licensed; and always a stand-in that answers by our checker and
prints what the real one prints, so that the way there and back is walked.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import pytest

from ros2cc_extract.errors import ToolNotFoundError
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.generator.build import Text
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.given_queries import verify_model
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Checker, Options
from ros2cc_extract.verify.unit import verify_unit
from ros2cc_extract.verify.uppaal.verifyta import find_verifyta, run_verifyta
from tests.e2e.conftest import EXAMPLES

ROOT = Path(__file__).parents[2]
MODELS = ROOT / 'tests' / 'models'


STANDIN = """#!/bin/sh
PYTHONPATH='{root}' exec '{python}' -m tests.support.verifyta "$@"
"""


@pytest.fixture(params=['stand-in', 'installed'])
def theirs(request: pytest.FixtureRequest, tmp_path: Path) -> Options:
    """Options that ask the other program."""
    if request.param == 'stand-in':
        program = tmp_path / 'verifyta'
        program.write_text(STANDIN.format(root=ROOT, python=sys.executable))
        program.chmod(0o755)
        return Options(checker=Checker.VERIFYTA, verifyta=program)
    try:
        program = find_verifyta()
        run_verifyta(program, (MODELS / 'peterson.xml').read_bytes(), ['E<> P0.critical'])
    except ToolNotFoundError as error:
        pytest.skip(f'verifyta: {error.what}')
    return Options(checker=Checker.VERIFYTA, verifyta=program)


def verdicts(verification: Verification) -> list[tuple[str, str]]:
    return [(result.formula, result.verdict.value) for result in verification.results]


def told(verification: Verification) -> list[list[str] | None]:
    """The sentences of each run, none for verdicts without one."""
    return [
        [s.text for m in result.evidence.moments for s in m.sentences] if result.evidence else None
        for result in verification.results
    ]


@pytest.mark.parametrize('name', ['peterson', 'philosophers', 'buffer', 'fischer'])
def test_models_of_somebody_else(name: str, theirs: Options) -> None:
    path = MODELS / f'{name}.xml'
    found, ours = verify_model(path, options=theirs), verify_model(path)
    assert (verdicts(found), found.notes) == (verdicts(ours), ())
    assert [run is None for run in told(found)] == [run is None for run in told(ours)]


@pytest.mark.parametrize('text', Text)
@pytest.mark.parametrize('case', ['paper_case1', 'paper_case2', 'paper_case3'])
def test_published_cases(case: str, text: Text, theirs: Options) -> None:
    (unit,) = scan([EXAMPLES / case / 'node.py'], root=EXAMPLES).units
    found = verify_unit(close(unit), replace(theirs, text=text))
    ours = verify_unit(close(unit), Options(text=text))
    assert (verdicts(found), found.engine) == (verdicts(ours), 'verifyta')
    assert [run is None for run in told(found)] == [run is None for run in told(ours)]
