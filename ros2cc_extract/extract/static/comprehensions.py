"""Comprehensions and generator expressions: loops that collect values."""

from __future__ import annotations

import ast
from collections.abc import Sequence as Items

from ros2cc_extract.extract.static import loops
from ros2cc_extract.extract.static.machine import Frame, Machine
from ros2cc_extract.extract.static.values import Mapping, Scope, Sequence, Value
from ros2cc_extract.places import Unknown

_NEXT = 1

Comprehension = ast.ListComp | ast.SetComp | ast.GeneratorExp | ast.DictComp


class Comprehensions(Machine):
    """Loops inside an expression."""

    def comprehend(self, node: ast.expr, frame: Frame) -> Value:
        """The value of a comprehension or generator expression."""
        assert isinstance(node, (ast.ListComp, ast.SetComp, ast.GeneratorExp, ast.DictComp))
        scope = Scope(frame.module, frame.scope)
        inner = Frame(scope, frame.function, qualname=f'{frame.qualname or ""}')
        collected: list[tuple[Value, Value]] = []
        rests: list[Unknown] = []
        self._generate(node, node.generators, inner, collected, rests)
        rest = rests[0] if rests else None
        if isinstance(node, ast.DictComp):
            return Mapping(dict(collected), rest)
        kind = 'set' if isinstance(node, ast.SetComp) else 'list'
        return Sequence(tuple(value for _, value in collected), kind, rest)

    def _generate(
        self,
        node: Comprehension,
        generators: Items[ast.comprehension],
        frame: Frame,
        collected: list[tuple[Value, Value]],
        rests: list[Unknown],
    ) -> None:
        if not generators:
            collected.append(self._element(node, frame))
            return
        generator, deeper = generators[0], generators[1:]
        place = frame.place(generator.iter)
        items, rest = self.items_of(self.evaluate(generator.iter, frame), place)
        if len(items) > loops.UNROLL_LIMIT:
            rests.append(Unknown('a long comprehension', place))
        elif rest is not None:
            rests.append(rest)

        def once(item: Value) -> int:
            self.assign(generator.target, item, frame)
            if self._passes(generator, frame, rests):
                self._generate(node, deeper, frame, collected, rests)
            return _NEXT

        loops.run_loop(self, items, rest, once, place)

    def _passes(self, generator: ast.comprehension, frame: Frame, rests: list[Unknown]) -> bool:
        for condition in generator.ifs:
            holds = self.truth(self.evaluate(condition, frame))
            if holds is False:
                return False
            if holds is None:
                place = frame.place(condition)
                rests.append(Unknown('a condition that could not be followed', place))
        return True

    def _element(self, node: Comprehension, frame: Frame) -> tuple[Value, Value]:
        if isinstance(node, ast.DictComp):
            key = self.evaluate(node.key, frame)
            return key, self.evaluate(node.value, frame)
        value = self.evaluate(node.elt, frame)
        return value, value
