"""Finding and reading verifyta, by a stand-in program that prints what the real one prints."""

from __future__ import annotations

import stat
from pathlib import Path

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.errors import ToolNotFoundError
from ros2cc_extract.verifyta import LicenceError, Runs, find_verifyta, run_verifyta

HEAD = r"""#!/bin/sh
for last; do :; done
printf 'Options for the verification:\n  Generating no trace\n  Search order is breadth first\n'
"""
VERDICTS = (
    HEAD
    + r"""n=0
while read -r formula; do
  n=$((n + 1))
  printf '\nVerifying formula %d at line %d\n' $n $n
  case "$formula" in
    *not*) printf '\033[2K -- Formula is NOT satisfied.\n' ;;
    *may*) printf '\033[2K -- Formula MAY be satisfied.\n' ;;
    *) printf '\033[2K -- Formula is satisfied.\n' ;;
  esac
  printf ' -- States stored : 16 states\n -- Resident memory used : 6144 KiB\n'
done < "$last"
exit 7
"""
)


def program(folder: Path, script: str) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / 'verifyta'
    path.write_text(script)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


@pytest.mark.parametrize('runs', Runs)
def test_verdicts_are_read_from_the_text(tmp_path: Path, runs: Runs) -> None:
    answers = run_verifyta(
        program(tmp_path, VERDICTS), '<nta/>', ['a', 'not b', 'may c'], runs=runs
    )
    assert [(a.verdict, a.states, a.peak_mb) for a in answers] == [
        (Verdict.SATISFIED, 16, 6.0),
        (Verdict.NOT_SATISFIED, 16, 6.0),
        (Verdict.UNDECIDED, 16, 6.0),
    ]


def test_a_missing_licence_is_explained(tmp_path: Path) -> None:
    script = HEAD + "echo 'License key is not set.' >&2\nexit 1\n"
    with pytest.raises(LicenceError, match=r'without a licence .License key is not set'):
        run_verifyta(program(tmp_path, script), '<nta/>', ['a'])


def test_a_refused_model_is_told_in_its_own_words(tmp_path: Path) -> None:
    script = HEAD + "echo '[error] syntax error' >&2\nexit 1\n"
    with pytest.raises(ToolNotFoundError, match=r'gave no verdict: .error. syntax error'):
        run_verifyta(program(tmp_path, script), '<nta/>', ['a'])


def test_a_time_limit_leaves_the_rest_undecided(tmp_path: Path) -> None:
    script = HEAD + "echo 'Verifying formula 1 at line 1'\necho ' -- Formula is satisfied.'\n"
    script += 'exec sleep 60\n'
    answers = run_verifyta(program(tmp_path, script), '<nta/>', ['a', 'b'], seconds=1)
    assert [answer.verdict for answer in answers] == [Verdict.SATISFIED, Verdict.UNDECIDED]
    assert answers[1].reason == 'time limit'


def test_it_is_looked_for_in_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('UPPAAL_HOME', raising=False)
    monkeypatch.setenv('PATH', str(tmp_path / 'path'))
    monkeypatch.setenv('HOME', str(tmp_path / 'home'))
    with pytest.raises(ToolNotFoundError, match='verifyta not found in UPPAAL_HOME, PATH or /opt'):
        find_verifyta()
    usual = program(tmp_path / 'home' / 'uppaal-5.0.0' / 'bin', VERDICTS)
    assert find_verifyta() == usual
    on_path = program(tmp_path / 'path', VERDICTS)
    assert find_verifyta() == on_path
    at_home = program(tmp_path / 'uppaal' / 'bin-Linux', VERDICTS)
    monkeypatch.setenv('UPPAAL_HOME', str(tmp_path / 'uppaal'))
    assert find_verifyta() == at_home
    given = program(tmp_path / 'given', VERDICTS)
    assert find_verifyta(given) == given


def test_a_given_path_that_is_no_program_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ToolNotFoundError, match='is no program'):
        find_verifyta(tmp_path)
