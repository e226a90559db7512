"""Random expressions of the UPPAAL language, with the value that the C language gives them."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass

from ros2cc_extract.checker.network.network import INT32

#: Values of the variables that an expression may read.
VARIABLES = {'x': -7, 'y': 3, 'z': 0, 'big': 30000, 'yes': 1, 'no': 0}
TABLE = (4, -1, 9, 0)
DECLARATION = (
    'int x = -7, y = 3, z = 0, big = 30000; bool yes = true, no = false; '
    'int t[4] = {4, -1, 9, 0}; int[-2147483647, 2147483647] result;'
)


class InvalidError(Exception):
    """An evaluation that UPPAAL calls invalid: it aborts the verification."""


@dataclass(frozen=True)
class Drawn:
    """
    An expression: its text, and its value with and without the short cuts of ``&&`` and ``?``.

    :param level: how strongly the outermost operator binds; a greater one more strongly.
    """

    text: str
    level: int
    lazy: Callable[[], int]
    eager: Callable[[], int]


def _within(value: int) -> int:
    if not INT32[0] <= value <= INT32[1]:
        raise InvalidError
    return value


def _divided(a: int, b: int) -> int:
    if b == 0:
        raise InvalidError
    return _within(abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1))


def _shifted(a: int, b: int, *, left: bool) -> int:
    if not 0 <= b <= 31:
        raise InvalidError
    return _within(a << b if left else a >> b)


# Page "Expressions" of the documentation: from weak to strong, the words beside their signs.
_LEVELS: tuple[dict[str, Callable[[int, int], int]], ...] = (
    {
        '||': lambda a, b: int(bool(a or b)),
        'or': lambda a, b: int(bool(a or b)),
        'imply': lambda a, b: int(not a or bool(b)),
        'xor': lambda a, b: int(bool(a) != bool(b)),
    },
    {'&&': lambda a, b: int(bool(a and b)), 'and': lambda a, b: int(bool(a and b))},
    {'|': lambda a, b: a | b},
    {'^': lambda a, b: a ^ b},
    {'&': lambda a, b: a & b},
    {'==': lambda a, b: int(a == b), '!=': lambda a, b: int(a != b)},
    {
        '<': lambda a, b: int(a < b),
        '<=': lambda a, b: int(a <= b),
        '>': lambda a, b: int(a > b),
        '>=': lambda a, b: int(a >= b),
    },
    {'<?': min, '>?': max},
    {
        '<<': lambda a, b: _shifted(a, b, left=True),
        '>>': lambda a, b: _shifted(a, b, left=False),
    },
    {'+': lambda a, b: _within(a + b), '-': lambda a, b: _within(a - b)},
    {
        '*': lambda a, b: _within(a * b),
        '/': _divided,
        '%': lambda a, b: _within(a - b * _divided(a, b)),
    },
)
_CHOICE, _PREFIX, _ATOM = -1, len(_LEVELS), len(_LEVELS) + 1
_DECIDED_BY = {'||': 1, 'or': 1, '&&': 0, 'and': 0, 'imply': 0}


class Drawing:
    """Draws expressions; the same for the same seed."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)

    def expression(self, depth: int) -> Drawn:
        """Return an expression at most so deep."""
        kind = self._random.random()
        if depth == 0 or kind < 0.1:
            return self._atom()
        if kind < 0.2:
            return self._prefixed(depth - 1)
        if kind < 0.3:
            return self._choice(depth - 1)
        if kind < 0.35:
            return self._element(depth - 1)
        return self._infixed(depth - 1)

    def _atom(self) -> Drawn:
        if self._random.random() < 0.5:
            value = self._random.choice([0, 1, 2, 3, 5, 31, 1000])
            return Drawn(str(value), _ATOM, lambda: value, lambda: value)
        name, value = self._random.choice(sorted(VARIABLES.items()))
        return Drawn(name, _ATOM, lambda: value, lambda: value)

    def _bracketed(self, part: Drawn, least: int) -> str:
        if part.level < least or self._random.random() < 0.1:
            return f'({part.text})'
        return part.text

    def _prefixed(self, depth: int) -> Drawn:
        sign = self._random.choice(['!', 'not ', '-', '+'])
        part = self.expression(depth)
        compute: dict[str, Callable[[int], int]] = {
            '!': lambda a: int(not a),
            'not ': lambda a: int(not a),
            '-': lambda a: _within(-a),
            '+': lambda a: a,
        }
        of = compute[sign]
        # A blank, so that two signs are no decrement.
        text = f'{sign} {self._bracketed(part, _PREFIX)}'
        return Drawn(text, _PREFIX, lambda: of(part.lazy()), lambda: of(part.eager()))

    def _choice(self, depth: int) -> Drawn:
        asked, then, other = (self.expression(depth) for _ in range(3))
        text = f'{self._bracketed(asked, 0)} ? {then.text} : {self._bracketed(other, _CHOICE)}'

        def eager() -> int:
            values = then.eager(), other.eager()
            return values[0] if asked.eager() else values[1]

        return Drawn(text, _CHOICE, lambda: then.lazy() if asked.lazy() else other.lazy(), eager)

    def _element(self, depth: int) -> Drawn:
        index = self.expression(depth)

        def at(position: int) -> int:
            if not 0 <= position < len(TABLE):
                raise InvalidError
            return TABLE[position]

        return Drawn(
            f't[{index.text}]', _ATOM, lambda: at(index.lazy()), lambda: at(index.eager())
        )

    def _infixed(self, depth: int) -> Drawn:
        level = self._random.randrange(len(_LEVELS))
        sign = self._random.choice(sorted(_LEVELS[level]))
        left, right = self.expression(depth), self.expression(depth)
        of = _LEVELS[level][sign]
        text = f'{self._bracketed(left, level)} {sign} {self._bracketed(right, level + 1)}'

        def lazy() -> int:
            first = left.lazy()
            if sign in _DECIDED_BY and bool(first) == bool(_DECIDED_BY[sign]):
                return of(first, 0)
            return of(first, right.lazy())

        return Drawn(text, level, lazy, lambda: of(left.eager(), right.eager()))


def value_of(compute: Callable[[], int]) -> int | None:
    """Return a value; None where the evaluation is invalid."""
    try:
        return compute()
    except InvalidError:
        return None
