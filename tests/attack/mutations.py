"""Damages what is valid, by chance and repeatably: bytes, lines, trees of JSON."""

from __future__ import annotations

import copy
import json
import random
from collections.abc import Sequence
from typing import Any

from tests.property.test_scanner_fuzz import mutated

LONGEST = 2_000_000
DIGITS = '9' * 3_000 + 'digits'
"""Stands for a number that Python itself does not write; see ``as_json``."""
VALUES: tuple[Any, ...] = (
    None,
    True,
    [],
    {},
    '',
    '\0',
    '\ud800',
    '\x1b[2J\r\n::error::x',
    '../../../etc/passwd',
    'x' * 100_000,
    -1,
    0,
    2**31,
    2**63,
    10**30,
    DIGITS,
    1e308,
    float('nan'),
    float('inf'),
    [[[[]]]],
    {'a': {'a': {}}},
    ['a', 1, None],
)


def damaged(content: bytes, chance: random.Random) -> bytes:
    """Flip bits, cut, overwrite, splice or repeat."""
    data = bytearray(content or b'\0')
    for _ in range(chance.randint(1, 3)):
        at, end = sorted(chance.randrange(len(data) + 1) for _ in range(2))
        action = chance.randrange(6)
        if action == 0:
            for _ in range(chance.randint(1, 14)):
                bit = chance.randrange(8 * len(data))
                data[bit // 8] ^= 1 << bit % 8
        elif action == 1:
            del data[at:end]
        elif action == 2:
            data[at : at + 16] = chance.randbytes(chance.randint(1, 64))
        elif action == 3:
            data[at:at] = data[end : end + 400]
        elif action == 4:
            data[at:end] = data[at:end] * min(chance.randint(2, 3_000), LONGEST // (len(data) + 1))
        else:
            data[at:at] = chance.choice(
                (b'\0', b'\xff', b'\xed\xa0\x80', b'\r', b'\x85', b'\xfe\xff')
            )
        data = data or bytearray(b'\0')
    return bytes(data)


def with_words(text: str, words: Sequence[str], chance: random.Random) -> str:
    """Change lines and words, and bring in words that mean something where the text is read."""
    text = mutated(text, chance)
    for _ in range(chance.randint(1, 3)):
        lines = text.split('\n')
        number = chance.randrange(len(lines))
        line, word = lines[number], chance.choice(words)
        if chance.random() < 0.3:
            lines.insert(number, word)
        else:
            at, end = sorted(chance.randrange(len(line) + 1) for _ in range(2))
            lines[number] = line[:at] + word + (line[end:] if chance.random() < 0.5 else line[at:])
        text = '\n'.join(lines)
    return text


def reshaped(tree: Any, chance: random.Random) -> Any:
    """Other values, keys and shapes at some places of a tree of JSON."""
    tree = copy.deepcopy(tree)
    for _ in range(chance.randint(1, 3)):
        places = list(_places(tree))
        if not places:
            return chance.choice(VALUES)
        _change(*chance.choice(places), chance)
    return tree


def _change(holder: Any, key: Any, chance: random.Random) -> None:
    action = chance.randrange(6)
    if action == 0:
        del holder[key]
    elif action == 1 and isinstance(holder, list):
        holder.extend([holder[key]] * chance.choice((1, 2, 500)))
    elif action == 2 and isinstance(holder, dict):
        name = chance.choice([*holder, '', 'x', '__class__', '\ud800'])
        holder[name] = holder.pop(key)
    elif action == 3:
        others = list(_places(holder))
        near, there = chance.choice(others)
        holder[key] = copy.deepcopy(near[there])
    else:
        holder[key] = copy.deepcopy(chance.choice(VALUES))


def _places(tree: Any) -> Any:
    items = (
        tree.items()
        if isinstance(tree, dict)
        else enumerate(tree)
        if isinstance(tree, list)
        else ()
    )
    for key, value in items:
        yield tree, key
        yield from _places(value)


def as_json(tree: Any) -> str:
    """The text of a tree, with numbers that are too long."""
    return json.dumps(tree).replace(f'"{DIGITS}"', '9' * 5_000)
