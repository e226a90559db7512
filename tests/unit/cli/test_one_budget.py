"""`--diff-base` checks twice: both take their time from one budget."""

from __future__ import annotations

import shutil
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main
from ros2cc_extract.deadline import Deadline, deadline_in
from ros2cc_extract.pipeline import check
from tests.support.packages import DEADLOCK
from tests.support.repositories import commit, make_repository


@pytest.mark.skipif(shutil.which('git') is None, reason='git is not installed')
def test_the_revision_takes_half_at_most_and_the_rest_is_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_repository(tmp_path)
    (tmp_path / 'node.py').write_text(DEADLOCK)
    commit(tmp_path, 'a node')
    given: list[tuple[float, float]] = []

    def note(seconds: float, of: float) -> Deadline:
        given.append((seconds, of))
        return deadline_in(seconds, of)

    monkeypatch.setattr(check, 'deadline_in', note)
    monkeypatch.chdir(tmp_path)
    out, err = StringIO(), StringIO()
    options = ['--no-cache', '--max-seconds', '300', '--diff-base', 'HEAD']
    assert main(['check', *options, 'node.py'], out, err) == 0
    (base, of_base), (left, of_all) = given
    assert (base, of_base, of_all) == (150, 150, 300)
    assert 150 < left < 300
