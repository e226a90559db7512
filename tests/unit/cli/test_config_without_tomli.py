"""Python 3.10 without tomli, as on ROS Humble: what needs no TOML works, the rest is reported."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from ros2cc_extract.errors import InputError
from ros2cc_extract.pipeline.config import Config, load_config


@pytest.fixture(autouse=True)
def no_reader(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ('tomli', 'tomllib'):
        monkeypatch.setitem(sys.modules, name, None)


def test_a_file_that_says_nothing_of_us_is_not_needed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / 'pyproject.toml').write_text('[tool.ruff]\nline-length = 99\n')
    monkeypatch.chdir(tmp_path)
    assert load_config(tmp_path) == Config(root=tmp_path)


def test_a_table_of_ours_that_cannot_be_read_is_an_error(tmp_path: Path) -> None:
    (tmp_path / 'pyproject.toml').write_text('[tool.ros2cc]\nignore = ["CC403"]\n')
    with pytest.raises(InputError, match='cannot read TOML by itself; install tomli'):
        load_config(tmp_path)
