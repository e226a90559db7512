"""Comprehensions and generator expressions: loops that collect values."""

from __future__ import annotations

import ast
from collections.abc import Callable
from collections.abc import Sequence as Items

from ros2cc_extract.extract.static.python.branching import open_tests
from ros2cc_extract.extract.static.python.machine import path_facts
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.values.containers import Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import Mystery, Scope, Value
from ros2cc_extract.source_locations import Unknown

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
        many: dict[Value, Value] = {}

        def collect(why: Unknown | None) -> None:
            key, value = self._element(node, inner)
            collected.append((key, value))
            if why is not None or isinstance(self.world.count, Unknown):
                many[key] = Mystery(why) if why is not None else self.why_many()

        ready = self.world.ready
        # Code that takes from a generator may stop before its end, as ``any`` does.
        is_whole = not isinstance(node, ast.GeneratorExp)
        self._generate(node.generators, inner, collect, None, is_whole=is_whole)
        picked = self.world.ready - ready - path_facts.perhaps(self.world.ready)
        self.world.ready = path_facts.back_to(ready, self.world.ready)
        if isinstance(node, ast.DictComp):
            return Mapping(dict(collected), None, many)
        values = tuple(value for _, value in collected)
        if isinstance(node, ast.SetComp):
            return loops.set_of(loops.Items(values, None, many), frame.place(node))
        made = Sequence(values, 'list', None, many)
        if picked:
            self.world.picked[made.serial] = picked
        return made

    def _generate(
        self,
        generators: Items[ast.comprehension],
        frame: Frame,
        collect: Callable[[Unknown | None], None],
        why: Unknown | None,
        *,
        is_whole: bool,
    ) -> None:
        """Run the loops; ``why`` an element may stand for several, or for none."""
        if not generators:
            collect(why)
            return
        generator, deeper = generators[0], generators[1:]
        place = frame.place(generator.iter)
        items = loops.items_to_run(self, self.evaluate(generator.iter, frame), place)
        self.note_iteration(generator.iter, frame)
        is_long = len(items.known) > loops.UNROLL_LIMIT
        here = Unknown('a long comprehension', place) if is_long else why

        def rounds(begin: Callable[[Value], None] | None) -> None:
            def once(item: Value) -> int:
                if begin is not None:
                    begin(item)
                self.assign(generator.target, item, frame)
                passes, unsure = self._passes(generator, frame)
                if passes:
                    is_sure = is_whole and unsure is None
                    self._generate(deeper, frame, collect, unsure or here, is_whole=is_sure)
                return _NEXT

            loops.run_loop(self, items, once, place)

        if is_whole and not generator.ifs:
            with loops.repeated(self, items, []) as begin:
                rounds(begin)
        else:
            rounds(None)

    def _passes(self, generator: ast.comprehension, frame: Frame) -> tuple[bool, Unknown | None]:
        """Whether an item may pass the conditions, and why that is not certain."""
        unsure: Unknown | None = None
        for condition in generator.ifs:
            holds = open_tests.decide(self, condition, frame)
            self.world.assume(path_facts.implied_by(self.world.tested), holds=True)
            if holds is False:
                return False, None
            if holds is None:
                place = frame.place(condition)
                unsure = Unknown('a condition that could not be followed', place)
        return True, unsure

    def _element(self, node: Comprehension, frame: Frame) -> tuple[Value, Value]:
        if isinstance(node, ast.DictComp):
            key = self.evaluate(node.key, frame)
            return key, self.evaluate(node.value, frame)
        value = self.evaluate(node.elt, frame)
        return value, value
