"""Syntax that the Python which runs us does not know yet; a file is parsed by no other."""

from __future__ import annotations

import re
from sys import version_info

_HERE = version_info[:2]
_REST = 'the rest of the program is scanned without this file'

WITHOUT_FILE = (
    f'{_REST}; where the node needs a newer Python than {_HERE[0]}.{_HERE[1]}, run ros2cc-extract '
    'by that one'
)

_STRING = r'(?:.*[^\w\'"])?(?:{0}[rR]?|[rR]{0})[\'"]'
_NEWER = (
    ('3.11', 'which knows except*', re.compile(r'\s*except\s*\*')),
    (
        '3.13',
        'which knows defaults of type parameters',
        re.compile(r'\s*(?:class|def|type)\s+\w+\s*\[[^\]]*='),
    ),
    (
        '3.12',
        'which knows type parameters',
        re.compile(r'\s*(?:class|(?:async\s+)?def)\s+\w+\s*\['),
    ),
    (
        '3.12',
        'which knows the type statement',
        re.compile(r'\s*type\s+\w+\s*(?:\[.*\])?\s*='),
    ),
    ('3.14', 'if this is a template string', re.compile(_STRING.format('[tT]'))),
    (
        '3.12',
        'if it is for quotes, backslashes or comments within the braces',
        re.compile(_STRING.format('[fF]') + '.*{'),
    ),
)


def needs_newer_python(text: str, line: int, running: tuple[int, int] = _HERE) -> str | None:
    """How to mend the syntax error in that line, where a newer Python may understand it."""
    lines = text.splitlines()
    statement = lines[line - 1] if 0 < line <= len(lines) else ''
    for version, why, pattern in _NEWER:
        major, minor = version.split('.')
        if (int(major), int(minor)) > running and pattern.match(statement):
            return f'run ros2cc-extract by Python {version} or newer, {why}; {_REST}'
    return None
