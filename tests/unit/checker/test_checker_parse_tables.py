"""The tables of a grammar are made once, and kept where nobody but this user can change them."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from lark import Lark, Transformer

from ros2cc_extract.checker.uppaal.language import parse_tables
from ros2cc_extract.checker.uppaal.language.parse_tables import Grammar

GRAMMAR = Grammar('start: "a"+ WORD\nWORD: /[b-z]+/\n', ('start',))


class Builder(Transformer):  # type: ignore[type-arg]
    """Says which word stands at the end."""

    def start(self, children: list[str]) -> str:
        return str(children[-1])


@pytest.fixture
def places(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    """The folder of byte code, and that of the user's cache."""
    bytecode, users = tmp_path / '__pycache__', tmp_path / 'user'
    bytecode.mkdir(mode=0o700)
    monkeypatch.setattr(sys, 'dont_write_bytecode', False)
    monkeypatch.setattr(parse_tables, 'default_cache_folder', lambda: users)
    monkeypatch.setattr(parse_tables, '__file__', str(tmp_path / 'parse_tables.py'))
    return bytecode, users


def is_made(monkeypatch: pytest.MonkeyPatch) -> bool:
    """Whether lark had to make the tables; the parser works in both cases."""
    made: list[Grammar] = []
    original = Grammar._made

    def watched(grammar: Grammar, builder: Transformer) -> Lark:  # type: ignore[type-arg]
        made.append(grammar)
        return original(grammar, builder)

    with monkeypatch.context() as patch:
        patch.setattr(Grammar, '_made', watched)
        parser = GRAMMAR.parser(Builder())
    assert parser.parse('aaword', start='start') == 'word'
    return bool(made)


def test_they_are_kept_beside_byte_code(
    places: tuple[Path, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    bytecode, users = places
    assert [is_made(monkeypatch), is_made(monkeypatch)] == [True, False]
    assert [path.suffix for path in bytecode.iterdir()] == ['.tables']
    assert not users.exists()


@pytest.mark.parametrize('reason', ['none', 'no byte code', 'open to others'])
def test_they_are_kept_in_the_users_cache_where_that_cannot_be(
    places: tuple[Path, Path], monkeypatch: pytest.MonkeyPatch, reason: str
) -> None:
    bytecode, users = places
    if reason == 'none':
        bytecode.rmdir()
    elif reason == 'no byte code':
        monkeypatch.setattr(sys, 'dont_write_bytecode', True)
    else:
        bytecode.chmod(0o777)
    assert [is_made(monkeypatch), is_made(monkeypatch)] == [True, False]
    assert [path.suffix for path in users.iterdir()] == ['.tables']
    assert not bytecode.exists() or not list(bytecode.iterdir())


def test_damaged_tables_are_made_anew(
    places: tuple[Path, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    is_made(monkeypatch)
    (kept,) = places[0].iterdir()
    kept.write_bytes(kept.read_bytes()[:-5])
    assert [is_made(monkeypatch), is_made(monkeypatch)] == [True, False]
