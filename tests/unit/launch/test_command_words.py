"""The words of a command in one text, as launch divides it."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.launch.language.command_words import words_of
from ros2cc_extract.extract.launch.language.substitutions import Configuration, Expression, Text

DIR = Configuration((Text('dir'),))


@pytest.mark.parametrize(
    ('command', 'words'),
    [
        (('python3 x.py --fast',), [('python3',), ('x.py',), ('--fast',)]),
        (("python3 '/the sources'/x.py",), [('python3',), ('/the sources/x.py',)]),
        (('python3 ', DIR, '/x.py  -v'), [('python3',), (DIR, '/x.py'), ('-v',)]),
        ((DIR, ' ', DIR), [(DIR,), (DIR,)]),
        ((DIR, DIR), [(DIR, DIR)]),
        (('a b', DIR), [('a',), ('b', DIR)]),
        (('  ',), []),
    ],
)
def test_texts_are_divided_and_substitutions_are_not(
    command: tuple[object, ...], words: list[tuple[object, ...]]
) -> None:
    assert words_of(expression(command)) == [expression(word) for word in words]


def test_an_open_quotation_is_refused() -> None:
    with pytest.raises(ValueError, match='No closing quotation'):
        words_of((Text("python3 'x.py"),))


def expression(parts: tuple[object, ...]) -> Expression:
    return tuple(Text(part) if isinstance(part, str) else DIR for part in parts)
