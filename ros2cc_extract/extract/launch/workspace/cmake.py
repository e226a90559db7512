"""
What a ``CMakeLists.txt`` installs as programs, as far as its text shows; it is never run.

Source: CMake, ``install(PROGRAMS)`` and ``install(DIRECTORY)``, ``set``, ``add_executable``;
rclcpp_components (Jazzy), ``cmake/rclcpp_components_register_node.cmake``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

_COMMAND = re.compile(r'\b(\w+)\s*\(([^()]*)\)')
_COMMENT = re.compile(r'#[^\n]*')
_WORD = re.compile(r'"([^"]*)"|(\S+)')
_VARIABLE = re.compile(r'\$\{(\w+)\}')
_MOST_LETTERS = 2_000_000
_KEYWORDS = frozenset(
    ['DESTINATION', 'RENAME', 'PERMISSIONS', 'COMPONENT', 'OPTIONAL', 'USE_SOURCE_PERMISSIONS']
)


def installed_programs(text: str) -> Iterator[tuple[str, str]]:
    """Each program with its name when it is installed; a folder ends in ``/``, and gives all."""
    variables = _Variables({'PROJECT_NAME': [], 'CMAKE_CURRENT_SOURCE_DIR': ['.']})
    for command, words in _commands(text, variables):
        if command == 'set' and words:
            variables.set(words[0], words[1:])
        elif command == 'install' and words and words[0] in ('PROGRAMS', 'DIRECTORY'):
            yield from _of_install(words)


def targets_of(text: str) -> frozenset[str]:
    """The programs that are built, also those that hold one component."""
    return frozenset(_built(text))


def _built(text: str) -> Iterator[str]:
    variables = _Variables({})
    for command, words in _commands(text, variables):
        if command == 'set' and words:
            variables.set(words[0], words[1:])
        elif command == 'project' and words:
            variables.set('PROJECT_NAME', words[:1])
        elif command == 'add_executable' and words:
            yield words[0]
        elif command == 'rclcpp_components_register_node':
            yield from (word for before, word in pairwise(words) if before == 'EXECUTABLE')


class _Variables:
    """What ``set`` has said. Values of values double: beyond a bound none is put in any more."""

    def __init__(self, values: dict[str, list[str]]) -> None:
        self._values = values
        self._left = _MOST_LETTERS

    def set(self, name: str, words: list[str]) -> None:
        self._values[name] = words

    def expanded(self, word: str) -> list[str]:
        """The words that stand for one, with the values of its variables."""
        found = [self._values.get(name) or [] for name in _VARIABLE.findall(word)]
        self._left -= sum(len(each) + 1 for words in found for each in words)
        if not any(found) or self._left < 0:
            return [word]
        if _VARIABLE.fullmatch(word):
            return found[0]
        return [_VARIABLE.sub(lambda m: ' '.join(self._values.get(m[1]) or [m[0]]), word)]


def _commands(text: str, variables: _Variables) -> Iterator[tuple[str, list[str]]]:
    for match in _COMMAND.finditer(_COMMENT.sub('', text)):
        words = [quoted or plain for quoted, plain in _WORD.findall(match.group(2))]
        yield match.group(1).lower(), [w for word in words for w in variables.expanded(word)]


def _of_install(words: list[str]) -> Iterator[tuple[str, str]]:
    ends = [number for number, word in enumerate(words) if word in _KEYWORDS]
    paths = words[1 : ends[0]] if ends else words[1:]
    after = dict(pairwise(words))
    target = after.get('DESTINATION', '')
    if not target.startswith('lib'):
        return
    for path in paths:
        if words[0] == 'DIRECTORY':
            yield f'{path.rstrip("/")}/', ''
        else:
            yield path, after.get('RENAME', path.rpartition('/')[2])
