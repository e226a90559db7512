"""Compiled templates are kept beside byte code, and are never believed too much."""

from __future__ import annotations

import sys
from pathlib import Path

import jinja2
import pytest

from ros2cc_extract.generator import templates


def rendered(folder: Path, text: str) -> tuple[str, int]:
    """One template, with the number of times that Jinja had to compile it."""
    compiled: list[str] = []

    class Environment(jinja2.Environment):
        def _compile(self, source: str, filename: str) -> object:  # type: ignore[override]
            compiled.append(source)
            return super()._compile(source, filename)

    environment = Environment(
        loader=jinja2.DictLoader({'a.j2': text}), bytecode_cache=templates.KeptBytecode(folder)
    )
    return environment.get_template('a.j2').render(name='arm'), len(compiled)


@pytest.fixture(autouse=True)
def _writes_byte_code(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, 'dont_write_bytecode', False)


def test_a_template_is_compiled_once(tmp_path: Path) -> None:
    assert rendered(tmp_path, 'I am {{ name }}') == ('I am arm', 1)
    assert rendered(tmp_path, 'I am {{ name }}') == ('I am arm', 0)


def test_another_text_version_or_option_is_compiled_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rendered(tmp_path, 'I am {{ name }}')
    assert rendered(tmp_path, 'You are {{ name }}') == ('You are arm', 1)
    monkeypatch.setattr(jinja2, '__version__', '9.0')
    assert rendered(tmp_path, 'You are {{ name }}') == ('You are arm', 1)
    monkeypatch.setattr(templates, 'OPTIONS', {'trim_blocks': False})
    assert rendered(tmp_path, 'You are {{ name }}') == ('You are arm', 1)


def test_damaged_files_count_as_none(tmp_path: Path) -> None:
    rendered(tmp_path, 'I am {{ name }}')
    (kept,) = tmp_path.iterdir()
    whole = kept.read_bytes()
    for damaged in (b'', whole[:3], whole[:-10], whole[:30] + b'?' * 20, b'?' * 100):
        kept.write_bytes(damaged)
        assert rendered(tmp_path, 'I am {{ name }}') == ('I am arm', 1)


def test_where_nothing_can_or_may_be_written_it_is_compiled_each_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for _ in range(2):
        assert rendered(tmp_path / 'none', '{{ name }}') == ('arm', 1)
    monkeypatch.setattr(sys, 'dont_write_bytecode', True)
    assert rendered(tmp_path, '{{ name }}') == ('arm', 1)
    assert list(tmp_path.iterdir()) == []


def test_files_lie_beside_the_byte_code_of_the_module() -> None:
    cache = templates.environment().bytecode_cache
    assert isinstance(cache, templates.KeptBytecode)
    assert Path(cache.directory) == Path(templates.__file__).parent / '__pycache__'
