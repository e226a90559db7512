"""
Random networks that use much of the language: nested arrays, loops, early returns, errors.

``networks.py`` draws the shapes of automata; this draws what stands on their edges.
"""

from __future__ import annotations

import random

from tests.support.networks import RandomModel
from tests.support.published import document
from tests.support.small import automaton

_DECLARATION = """
typedef int[1, 2] Id;
typedef int[0, 2] Small;
const int SHIFT[2][2] = {{0, 1}, {2, 1}};
chan go[Id]; urgent chan now[Id]; broadcast chan all; urgent broadcast chan hot[Id];
Small m[2][2]; int[-3, 3] s; bool f[Id]; Small last;

int[0, 6] above(Small limit) {
    for (i : int[0, 1]) for (j : int[0, 1]) if (m[i][j] > limit) return 2 * i + j;
    return 4;
}
Small mixed(Small row[2], bool first) {
    int k = 3;
    do { k--; row[k % 2] = (row[0] + k) % 3; } while (k > 0 && row[1] != 2);
    if (first) { return row[0]; }
    { Small k = row[1]; if (k == 1) return k; }
    return row[1] <? 2;
}
void push(Small &cell, int by) {
    int old = cell, n = 0;
    while (true) { if (n == 2 || (old + by) % 3 == 0) { cell = (old + n) % 3; return; } n++; }
}
int[-3, 3] half(int v) { return v < 0 ? -((-v) >> 1) : v / 2; }
bool any() { return exists (i : Id) f[i] && s >= 0; }
void all_off() { for (i : Id) { f[i] = false; } last = above(0) % 3; }
"""


class _Writer:
    """Writes two or three templates; one network in ten breaks a range sooner or later."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self._is_risky = self._random.random() < 0.1
        self._locations: dict[str, int] = {}

    def _pick(self, *options: str) -> str:
        return self._random.choice(options)

    def model(self) -> RandomModel:
        templates = ''
        names = []
        for number in range(self._random.randint(2, 3)):
            name = f'T{number}'
            count = self._random.randint(2, 3)
            templates += automaton(name, self._drawing(count), 'const Id id', 'Small own; bool p;')
            for instance in (1, 2):
                self._locations[f'{name}({instance})'] = count
            names.append(name)
        text = document(_DECLARATION, templates, f'system {", ".join(names)};')
        return RandomModel(text, self._formulas())

    def _drawing(self, count: int) -> str:
        marks = ['', '', '', '', 'U:', 'C:']
        head = ' '.join(f'{self._pick(*marks)}l{i}' for i in range(count))
        edges = [self._edge(i % count, count) for i in range(count + self._random.randint(0, 3))]
        return '\n'.join([head, *edges])

    def _edge(self, source: int, count: int) -> str:
        edge, index = f'l{source} -> l{self._random.randrange(count)}', 'id'
        if self._random.random() < 0.25:
            edge += '; select: i : Id, j : bool'
            index = self._pick('i', 'id', '(3 - i)', '(j ? i : id)')
        if self._random.random() < 0.6:
            edge += f'; guard: {self._condition(index)}'
        if self._random.random() < 0.65:
            channel = self._pick('go', 'go', 'now', 'all', 'hot')
            at = '' if channel == 'all' else f'[{self._pick(index, index, "1", "3 - id")}]'
            edge += f'; sync: {channel}{at}{self._pick("!", "?", "?")}'
        updates = [self._update(index) for _ in range(self._random.randint(0, 2))]
        return edge + (f'; do: {", ".join(updates)}' if updates else '')

    def _condition(self, index: str) -> str:
        return self._pick(
            f'f[{index}]', 'above(own) < 4', 'm[0] == m[1]', 's % 2 != 0', 'not p and s < 2',
            'half(s) == -1', f'm[{index} - 1][p] >= own', 'mixed(m[1], p) > 0', 'any()',
            '-s / 2 * 2 == -s', 'forall (a : Id) f[a] imply a == id', 'p || own == last',
            'sum (a : Id) (f[a] ? 1 : 0) == 1', 's >> 1 < 0', 'm[id - 1] != m[0] || !p',
        )  # fmt: skip

    def _update(self, index: str) -> str:
        risky = ('s++', 'own += 2', 'm[1][s] = 1', 's = 3 / s', 'own = above(2)')
        if self._is_risky and self._random.random() < 0.3:
            return self._pick(*risky)
        return self._pick(
            f'push(m[{self._random.randrange(2)}][1], 1)', 'push(last, -1)', 'm[0] = m[1]',
            's = half(s - 1)', 's = -s', 'own = mixed(m[0], p)', f'f[{index}] = !f[{index}]',
            's = (p = !p) ? 2 : s % 2', 'all_off()', 'own = (own + 1) % 3', 'last = own',
            f'm[{index} - 1][f[1]] = (own + 2) % 3', 's = SHIFT[p][f[2]] - 1 << p', 'p = own',
            'own = last = (s < 0 ? 0 : s) <? 2', 'p = above(1) == 4',
        )  # fmt: skip

    def _atom(self) -> str:
        process = self._random.choice(sorted(self._locations))
        location = self._random.randrange(self._locations[process])
        return self._pick(
            f'{process}.l{location}', f'{process}.l{location}', f'{process}.own == last',
            f'{process}.p', 's < 0', 'm[0][1] == 2', 'any()', 'm[0] == m[1]', 'deadlock',
            'exists (a : Id) T0(a).l1 and f[a]',
        )  # fmt: skip

    def _state_formula(self) -> str:
        left, right = self._atom(), self._atom()
        return self._pick(left, f'not ({left})', f'{left} and {right}', f'{left} imply {right}')

    def _formulas(self) -> tuple[str, ...]:
        formula = self._state_formula
        return (
            'A[] deadlock or not deadlock',
            'A[] not deadlock',
            *(f'E<> {formula()}' for _ in range(2)),
            *(f'A[] {formula()}' for _ in range(2)),
            f'A<> {formula()}',
            f'E[] {formula()}',
            *(f'({formula()}) --> ({formula()})' for _ in range(3)),
        )


def rich_model(seed: int) -> RandomModel:
    """Return the model of a seed; the same for the same seed."""
    return _Writer(seed).model()
