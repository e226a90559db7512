"""
Random networks for comparing engines: a few processes, channels of all kinds, small data.

``ROS2CC_PARITY_NETWORKS`` sets their number for all comparisons; 5000 is the number of record.
"""

from __future__ import annotations

import os
import random
from dataclasses import dataclass

from tests.support.published import document
from tests.support.small import automaton

NETWORKS = int(os.environ.get('ROS2CC_PARITY_NETWORKS', '125'))

_CHANNELS = {
    'b': 'chan b',
    'u': 'urgent chan u',
    'r': 'broadcast chan r',
    's': 'urgent broadcast chan s',
}


@dataclass(frozen=True)
class RandomModel:
    """A model file and queries that fit it."""

    text: str
    formulas: tuple[str, ...]


class _Writer:
    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self._templates = self._random.randint(1, 3)
        self._processes: list[str] = []
        self._locations: dict[str, int] = {}

    def _pick(self, *options: str) -> str:
        return self._random.choice(options)

    def model(self) -> RandomModel:
        templates, system = '', ''
        for number in range(self._templates):
            name = f'T{number}'
            count = self._random.randint(2, 4)
            for instance in range(self._random.randint(1, 2)):
                process = f'p{number}{instance}'
                system += f'{process} = {name}({instance});\n'
                self._processes.append(process)
                self._locations[process] = count
            templates += automaton(
                name,
                self._drawing(count),
                parameters='const int[0, 1] id',
                local='int[0, 2] own; bool flag;',
            )
        system += f'system {", ".join(self._processes)};'
        channels = ''.join(f'{text}[2];\n' for text in _CHANNELS.values())
        declaration = f'{channels}int[0, 2] x; int[-1, 1] y; bool a[2]; int[0, 3] c;\n{_FUNCTIONS}'
        return RandomModel(document(declaration, templates, system), self._formulas())

    def _drawing(self, count: int) -> str:
        marks = ['', '', '', 'U:', 'C:']
        head = ' '.join(f'{self._pick(*marks)}l{i}' for i in range(count))
        edges = [self._edge(i % count, count) for i in range(count + self._random.randint(0, 4))]
        return '\n'.join([head, *edges])

    def _edge(self, source: int, count: int) -> str:
        edge = f'l{source} -> l{self._random.randrange(count)}'
        if self._random.random() < 0.15:
            edge += '; select: i : int[0, 1]'
            index = 'i'
        else:
            index = self._pick('0', '1', 'id', '1 - id', 'a[0]', 'flag')
        if self._random.random() < 0.5:
            edge += f'; guard: {self._condition()}'
        if self._random.random() < 0.6:
            channel = self._pick(*_CHANNELS)
            edge += f'; sync: {channel}[{index}]{self._pick("!", "?", "?")}'
        if self._random.random() < 0.7:
            updates = [self._update(index) for _ in range(self._random.randint(1, 2))]
            edge += f'; do: {", ".join(updates)}'
        return edge

    def _condition(self) -> str:
        return self._pick(
            'x > 0', 'x < 2', 'y != 0', 'own == x', 'flag', '!flag', 'a[id]', '!a[1 - id]',
            'own < 2 && !flag', 'count_set() > 0', 'x + own != 2', 'y <= 0 || a[0]',
            'exists (k : int[0, 1]) a[k]', 'forall (k : int[0, 1]) a[k] || flag',
        )  # fmt: skip

    def _update(self, index: str) -> str:
        return self._pick(
            'x = (x + 1) % 3', 'x = 0', 'y = -y', 'y = own - 1', 'own = (own + 1) % 3',
            'own = x', 'flag = !flag', 'flag = false', 'a[id] = !a[id]', f'a[{index}] = flag',
            'c = (c + own) % 4', 'bump()', 'own = next(own)', 'x = (y = 1) + 1', 'a[x > 0]= true',
        )  # fmt: skip

    def _atom(self) -> str:
        process = self._random.choice(self._processes)
        location = self._random.randrange(self._locations[process])
        return self._pick(
            f'{process}.l{location}', f'{process}.l{location}', f'{process}.own == x',
            f'{process}.flag', 'x == 1', 'y < 0', 'a[0]', 'c == 2', 'count_set() == 2', 'deadlock',
        )  # fmt: skip

    def _state_formula(self) -> str:
        left, right = self._atom(), self._atom()
        return self._pick(left, f'not {left}', f'{left} and {right}', f'{left} or not {right}',
                          f'{left} imply {right}')  # fmt: skip

    def _formulas(self) -> tuple[str, ...]:
        formula = self._state_formula
        return (
            'A[] not deadlock',
            *(f'E<> {formula()}' for _ in range(2)),
            *(f'A[] {formula()}' for _ in range(2)),
            *(f'A<> {formula()}' for _ in range(2)),
            *(f'E[] {formula()}' for _ in range(2)),
            *(f'({formula()}) --> ({formula()})' for _ in range(3)),
        )


_FUNCTIONS = """
int count_set() {
    int n = 0;
    for (k : int[0, 1]) if (a[k]) n++;
    return n;
}
void bump() {
    int k = 0;
    while (k < 2) { if (a[k]) c = (c + 1) % 4; else a[k] = x == 2; k++; }
}
int next(int n) { return n < 2 ? n + 1 : 0; }
"""


def random_model(seed: int) -> RandomModel:
    """Return the model of a seed; the same for the same seed."""
    return _Writer(seed).model()
