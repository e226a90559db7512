"""Texts that broke a parser once: each is refused with an error of ours, or read."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from ros2cc_extract.checker.runs.printed_runs import NamedState
from ros2cc_extract.conform.trace import read_traces
from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.recordings.recording import read_recording
from ros2cc_extract.findings.filters.baseline import read_baseline
from ros2cc_extract.pipeline.config import read_config
from ros2cc_extract.verify.uppaal.verifyta_trace import read_runs

READERS: dict[str, Callable[[Path], object]] = {
    'baseline': lambda path: read_baseline(path.read_text(), str(path)),
    'configuration': read_config,
    'recording': lambda path: read_recording(path, path.parent),
    'trace': read_traces,
}
DEEP = {'configuration': 'tool = ' + '[' * 20_000}
LONG = {
    'configuration': 'tool = 1' + '0' * 5_000,
    'baseline': '{"ros2cc_baseline": 1' + '0' * 5_000 + '}',
    'recording': '{"version": 1' + '0' * 5_000 + '}',
    'trace': '{"process": 1' + '0' * 5_000 + '}',
}


@pytest.mark.parametrize('reader', READERS)
def test_brackets_without_end_are_refused(tmp_path: Path, reader: str) -> None:
    path = tmp_path / 'hostile'
    path.write_text(DEEP.get(reader, '[' * 100_000))
    with pytest.raises(InputError, match='hostile'):
        READERS[reader](path)


@pytest.mark.parametrize('reader', READERS)
def test_numbers_longer_than_python_reads_are_refused(tmp_path: Path, reader: str) -> None:
    path = tmp_path / 'hostile'
    path.write_text(LONG[reader])
    with pytest.raises(InputError, match='hostile'):
        READERS[reader](path)


def test_a_printed_run_may_lack_its_first_state() -> None:
    ((state,),) = read_runs('State:\n( damaged\nTransitions:\n  a->b\nState:\n( P.busy )\nn=1\n')
    assert state == NamedState({'P': 'busy'}, {'n': 1})
