"""The tutorial, done: its files written, its changes applied, its commands run."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.e2e.tutorial import PAGE, carried_out


def test_every_step_does_what_the_page_shows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After an intended change: ``python -m tests.e2e.expected`` renews the page."""
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / '.cache'))
    page = PAGE.read_text(encoding='utf-8')
    assert carried_out(page, tmp_path) == page
