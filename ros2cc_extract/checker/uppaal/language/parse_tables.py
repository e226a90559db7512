"""
The tables that lark makes from the grammar, made once and kept.

Making them takes half of the time that a small model needs. They are kept where Python keeps the
byte code of this module, or in the user's cache where the user cannot write there. Lark has a
cache of its own, of pickles, which could make anything run; here they are kept as JSON, and lark
makes of them what a parser consists of. Works with lark 1.x and with lark-parser 0.12, which ROS
environments bring.
"""

from __future__ import annotations

import hashlib
import importlib.util
import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2cc_extract.cache_file import (
    default_cache_folder,
    load_content,
    store_content,
)
from ros2cc_extract.light_dataclasses import dataclass

if TYPE_CHECKING:
    from lark import Lark, Transformer

_UNUSABLE = (ValueError, TypeError, KeyError, AttributeError, IndexError, RecursionError)


@dataclass(frozen=True)
class Grammar:
    """
    A grammar.

    :param starts: rules that a text may be.
    """

    text: str
    starts: tuple[str, ...]

    def parser(self, builder: Transformer[Any, Any]) -> Lark:
        """Give its parser; ``builder`` makes the values of the rules."""
        paths = [folder / f'{self._key}.tables' for folder in _folders()]
        for path in paths:
            known = _loaded(path, builder)
            if known is not None:
                return known
        made = self._made(builder)
        any(store_content(path, _dumped(made)) for path in paths)
        return made

    def _made(self, builder: Transformer[Any, Any]) -> Lark:
        from lark import Lark

        starts = list(self.starts)
        return Lark(
            self.text, parser='lalr', start=starts, transformer=builder, maybe_placeholders=False
        )

    @property
    def _key(self) -> str:
        """Equal where the tables are: they are of lark's own making."""
        import lark

        text = '\0'.join((lark.__version__, self.text, *self.starts))
        return hashlib.sha256(text.encode()).hexdigest()


def _folders() -> list[Path]:
    """Where tables may be kept, the best place first."""
    bytecode = Path(importlib.util.cache_from_source(__file__)).parent
    users = default_cache_folder()
    takes_more = os.access(bytecode, os.W_OK) and not sys.dont_write_bytecode
    return [*([bytecode] if takes_more else []), *([users] if users is not None else [])]


def _dumped(parser: Lark) -> bytes:
    """Tables as lark itself gives them away; a builder stays behind."""
    from lark.grammar import Rule
    from lark.lexer import TerminalDef

    tables = parser.memo_serialize([TerminalDef, Rule])
    return json.dumps(tables, separators=(',', ':'), default=lambda left: None).encode()


def _loaded(path: Path, builder: Transformer[Any, Any]) -> Lark | None:
    from lark import Lark
    from lark.exceptions import LarkError

    content = load_content(path)
    if content is None:
        return None
    try:
        data, memo = json.loads(content, object_pairs_hook=_with_numbers)
        load: Any = Lark._load_from_dict  # lark has no types for it
        parser: Lark = load(data, memo, transformer=builder)
    except (*_UNUSABLE, LarkError):
        return None
    return parser


def _with_numbers(pairs: list[tuple[str, Any]]) -> dict[str | int, Any]:
    """States and tokens have numbers, and JSON has no keys but texts."""
    return {int(key) if key.isdecimal() else key: value for key, value in pairs}
