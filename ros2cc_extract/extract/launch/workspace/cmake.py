"""
What a ``CMakeLists.txt`` installs as programs, as far as its text tells; it is never run.

Source: CMake, ``install(PROGRAMS)`` and ``install(DIRECTORY)``, ``set``, ``add_executable``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

_COMMAND = re.compile(r'(\w+)\s*\(([^()]*)\)')
_COMMENT = re.compile(r'#[^\n]*')
_WORD = re.compile(r'"([^"]*)"|(\S+)')
_VARIABLE = re.compile(r'\$\{(\w+)\}')
_KEYWORDS = frozenset(
    ['DESTINATION', 'RENAME', 'PERMISSIONS', 'COMPONENT', 'OPTIONAL', 'USE_SOURCE_PERMISSIONS']
)


def installed_programs(text: str) -> Iterator[tuple[str, str]]:
    """Each program with its name when it is installed; a folder ends in ``/``, and gives all."""
    variables: dict[str, list[str]] = {'PROJECT_NAME': [], 'CMAKE_CURRENT_SOURCE_DIR': ['.']}
    for command, words in _commands(text, variables):
        if command == 'set' and words:
            variables[words[0]] = words[1:]
        elif command == 'install' and words and words[0] in ('PROGRAMS', 'DIRECTORY'):
            yield from _of_install(words)


def targets_of(text: str) -> frozenset[str]:
    """The programs that are built."""
    found = _commands(text, {})
    return frozenset(words[0] for command, words in found if command == 'add_executable' and words)


def _commands(text: str, variables: dict[str, list[str]]) -> Iterator[tuple[str, list[str]]]:
    for match in _COMMAND.finditer(_COMMENT.sub('', text)):
        words = [quoted or plain for quoted, plain in _WORD.findall(match.group(2))]
        yield match.group(1).lower(), [w for word in words for w in _expanded(word, variables)]


def _expanded(word: str, variables: dict[str, list[str]]) -> list[str]:
    whole = _VARIABLE.fullmatch(word)
    if whole and variables.get(whole.group(1)):
        return variables[whole.group(1)]
    return [_VARIABLE.sub(lambda m: ' '.join(variables.get(m.group(1)) or [m.group(0)]), word)]


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
