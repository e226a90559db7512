"""Following calls: functions, methods, classes, partials, library functions."""

from __future__ import annotations

import ast
from collections.abc import Callable
from functools import partial

from ros2cc_extract.extract.static.program.text_queries import is_test, mangled
from ros2cc_extract.extract.static.python.builtins import (
    computed_names,
    generators,
    given_functions,
)
from ros2cc_extract.extract.static.python.builtins.code_behind import ACCESSORS, with_accessor
from ros2cc_extract.extract.static.python.builtins.default_values import keep_defaults
from ros2cc_extract.extract.static.python.language import plain_data_calls, recursive_loops
from ros2cc_extract.extract.static.python.machine.block_exits import DEAD, NEXT, RETURN
from ros2cc_extract.extract.static.python.machine.frame import BudgetError, CannotCallError, Frame
from ros2cc_extract.extract.static.python.machine.incomplete_runs import note_cut
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import AWAITED
from ros2cc_extract.extract.static.python.machine.machine import ENTRIES, Machine
from ros2cc_extract.extract.static.python.machine.path_facts import of_all
from ros2cc_extract.extract.static.python.machine.world import Cut, note_once
from ros2cc_extract.extract.static.python.objects import memoization, subclass_registry
from ros2cc_extract.extract.static.python.objects.metaclasses import bind_by_name, of_metaclass
from ros2cc_extract.extract.static.python.values import enumerations
from ros2cc_extract.extract.static.python.values.argument_binding import fits, sources_of
from ros2cc_extract.extract.static.python.values.containers import Generator, Mapping, Sequence
from ros2cc_extract.extract.static.python.values.method_resolution import (
    cost_of_order,
    resolution_order,
)
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Choice,
    Class,
    Const,
    Coroutine,
    Function,
    Instance,
    Library,
    Mystery,
    Native,
    Partial,
    Scope,
    Super,
    Value,
    choice,
    options_of,
    source_text,
)
from ros2cc_extract.source_locations import Place, Unknown

_CALL_DEPTH = 40
_TOO_DEEP = f'what is called here, {_CALL_DEPTH} calls deep, is not followed'
_SAME_FUNCTION = 2
_TOLD = '__init_subclass__'


class Calls(Machine):
    """
    How values are called.

    :ivar in_plain: a call that works on plain data alone is running.
    """

    in_plain = False

    def call(self, function: Value, call: Call) -> Value:
        """The result of a call, after its effects."""
        if isinstance(function, Choice):
            options = options_of(function)
            able = [option for option in options if not isinstance(option, Const)] or options
            acts = [partial(self.call, option, call) for option in able]
            return self.branch(acts, call.place) if len(acts) > 1 else acts[0]()
        handler = _CALLABLE.get(type(function))
        if handler is not None:
            return handler(self, function, call)
        return self.unknown_call(function, call)

    def unknown_call(self, function: Value, call: Call) -> Value:
        """The result of calling something that cannot be followed."""
        generators.run_given(self, function, call)
        self.library_call(function, call)
        if isinstance(function, Mystery):
            self.note_unknown_call(function, call)
            computed_names.note_by_name(self, function, 'getattr', call.place)
            return Mystery(function.unknown, call.text or f'{function.text}(…)')
        name = function.name if isinstance(function, Library) else 'this value'
        return self.mystery(f'result of {name}, which is not followed', call.place, name)

    def call_function(self, function: Function, call: Call) -> Value:
        """Run a scanned function; that of a coroutine or generator only makes it."""
        if generators.is_generator(function):
            return Generator(function, call)
        if function.is_coroutine:
            return Coroutine(function, call)
        run = partial(self.run_shortly, function)
        if memoization.is_kept(function):
            return memoization.recall(self, function, call, run)
        return memoization.doubted(self, function, call, run)

    def run_function(self, function: Function, call: Call) -> Value:
        """Run the body of a scanned function with the arguments of ``call``."""
        self.charge(0)  # calls within one expression double too, and no statement looks meanwhile
        self.world.called[id(function.node)] = function
        if self.world.effects is not None:
            self.world.effects.begun += 1
        again = self.stack.count(function)
        wider = _any_numbers(function, call) if again == _SAME_FUNCTION else None
        if wider is not None and len(self.stack) < _CALL_DEPTH:
            call = wider
        elif len(self.stack) >= _CALL_DEPTH or again >= _SAME_FUNCTION:
            if len({*self.stack, function}) > len(self.stack):  # none calls itself
                note_cut(self.world, call.place, _TOO_DEEP)
            return self.mystery(f'recursion in {function.name}', call.place)
        trying = self.world.trying
        if trying == (len(self.stack), self.store.depth) and self._surely_fails(function, call):
            raise CannotCallError
        scope = Scope(function.module, function.scope)
        scope.function, scope.born = function, self.world.effects
        qualname = f'{function.qualname}.<locals>'
        frame = Frame(scope, function, qualname=qualname, path=self.world.path)
        for name, value in self.bind(function, call).items():
            scope.slots[name] = value
        if call.sources:
            frame.sources.update(sources_of(function, call))
        chain, count = self.world.chain, self.world.count
        path = self.world.path
        self.world.chain = (*chain, call.place)
        self.stack.append(function)
        try:
            return self._run_body(function, frame, call)
        finally:
            self.stack.pop()
            self.world.chain, self.world.count, self.world.path = chain, count, path

    def run_shortly(self, function: Function, call: Call) -> Value:
        """Run a function; one that works on plain data alone is left after some steps."""
        world = self.world
        is_short = self.steps < plain_data_calls.LONG or self.in_plain or world.effects is not None
        if is_short or not plain_data_calls.is_plain(self, function):
            return self.run_function(function, call)
        limit, began, depth = self.step_limit, self.steps, self.store.depth
        held, trying = world.held, world.trying
        self.in_plain = True
        self.step_limit = min(limit, began + plain_data_calls.allowance(world, function))
        try:
            return self.run_function(function, call)
        except BudgetError:
            if self.steps > limit:
                raise
            self.store.unwind(depth)
            world.held, world.trying, world.stopped = held, trying, False
            return plain_data_calls.leave(self, function, call)
        finally:
            self.in_plain, self.step_limit = False, limit
            plain_data_calls.note_spent(world, function, self.steps - began)

    def _surely_fails(self, function: Function, call: Call) -> bool:
        return function not in self.world.doubted and not fits(function, call)

    def running_classes(self) -> frozenset[Class]:
        """The classes whose methods are running."""
        return frozenset(f.owner for f in self.stack if f.owner is not None)

    def _run_body(self, function: Function, frame: Frame, call: Call) -> Value:
        if isinstance(function.node, ast.Lambda):
            return self.evaluate(function.node.body, frame)
        flow = self.execute_block(recursive_loops.body_of(function.node), frame)
        self.note_left(frame, goes_on=bool(flow & NEXT))
        if frame.known_at_return:
            ends = [self.world.ready] if flow & NEXT else []
            self.world.ready = of_all([*ends, *frame.known_at_return])
        if frame.yields:
            made = Sequence(tuple(frame.yields), 'generator', None, dict(frame.many))
            self.world.yielding = made, frame.held
            return made
        if not flow & (NEXT | RETURN) and flow & DEAD:
            self._note_dead_end(function)
            reason = f'{function.name} only raises, as far as it can be followed'
            return self.mystery(reason, call.place, function.name)
        results = [*frame.results, NONE] if flow & NEXT else frame.results
        return choice(results) if results else NONE

    def _note_dead_end(self, function: Function) -> None:
        """A constructor that raises on every path was not followed well enough."""
        if function.name == '__init__' and not self.world.stopped:
            reason = 'its constructor only raises, as far as it can be followed'
            note_once(self.world.cut, Cut(reason, function.place, self.running_classes()))

    def bind(self, function: Function, call: Call) -> dict[str, Value]:
        """The parameters of ``function`` as ``call`` fills them."""
        arguments = function.node.args
        names = [parameter.arg for parameter in (*arguments.posonlyargs, *arguments.args)]
        bound = dict(zip(names, call.args, strict=False))
        keywords = dict(call.keywords)
        for name in (*names, *(parameter.arg for parameter in arguments.kwonlyargs)):
            if name in keywords and name not in bound:
                bound[name] = keywords.pop(name)
        if arguments.vararg:
            bound[arguments.vararg.arg] = Sequence(
                tuple(call.args[len(names) :]), 'tuple', call.more
            )
        if arguments.kwarg:
            rest: dict[Value, Value] = {Const(name): keywords[name] for name in keywords}
            bound[arguments.kwarg.arg] = Mapping(rest, call.more)
        self._bind_defaults(function, call, names, bound)
        return bound

    def _bind_defaults(
        self, function: Function, call: Call, names: list[str], bound: dict[str, Value]
    ) -> None:
        first = len(names) - len(function.defaults)
        defaults = dict(zip(names[first:], function.defaults, strict=False))
        defaults.update(function.keyword_defaults)
        wanted = [*names, *(parameter.arg for parameter in function.node.args.kwonlyargs)]
        for name in wanted:
            if name in bound:
                continue
            default = defaults.get(name)
            if call.more is None and default is not None:
                bound[name] = default
            else:
                reason = call.more.reason if call.more else f'argument {name!r} is not passed'
                at = (call.more.at if call.more else None) or call.place
                bound[name] = Mystery(Unknown(reason, at), name, default)

    def zero_argument_super(self, frame: Frame) -> Value:
        """``super()`` in the method that is running."""
        scope: Scope | None = frame.scope
        function = frame.function
        while function is not None and function.owner is None and scope is not None:
            scope = scope.parent
            function = next((f for f in reversed(self.stack) if f.owner is not None), None)
        if function is None or function.owner is None:
            return self.mystery('super() outside a method', None)
        arguments = function.node.args
        first = next(iter((*arguments.posonlyargs, *arguments.args)), None)
        receiver = self._find_receiver(first.arg if first else 'self', frame.scope)
        return Super(function.owner, receiver)

    def _find_receiver(self, name: str, scope: Scope | None) -> Value:
        while scope is not None:
            if name in scope.slots:
                value = scope.slots[name]
                return value if isinstance(value, Value) else NONE
            scope = scope.parent
        return NONE

    def make_function(self, node: ast.AST, frame: Frame) -> Value:
        """A function from its definition, its decorators applied."""
        assert isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda))
        name = '<lambda>' if isinstance(node, ast.Lambda) else node.name
        qualname = f'{frame.qualname}.{name}' if frame.qualname else name
        in_class = self._class_body_owner(frame)
        scope: Scope | None = frame.scope
        if in_class is not None:
            scope = frame.scope.parent
        elif not frame.qualname:
            scope = None
        function = Function(node, frame.module, qualname, scope)
        function.owner = in_class
        if in_class is not None and name == _TOLD:
            function.binding = 'class'
        keep_defaults(self, function, frame)
        if isinstance(node, ast.Lambda):
            return function
        return self._decorate(function, node, frame)

    def _class_body_owner(self, frame: Frame) -> Class | None:
        owner = frame.scope.slots.get('__class_body__')
        return owner if isinstance(owner, Class) else None

    def _decorate(
        self, function: Function, node: ast.FunctionDef | ast.AsyncFunctionDef, frame: Frame
    ) -> Value:
        value: Value = function
        for decorator in reversed(node.decorator_list):
            binding = _BINDINGS.get(_last_name(decorator))
            if binding is not None and isinstance(value, Function):
                value.binding = binding
                memoization.keep_if_cached(self, value, _last_name(decorator))
                continue
            if isinstance(decorator, ast.Attribute) and decorator.attr in ACCESSORS:
                return self._with_accessor(function, decorator, frame)
            wrapper = self.evaluate(decorator, frame)
            self.world.decorated.append(function)
            if isinstance(wrapper, (Function, Bound, Partial, Class, Native)):
                result = self.call(wrapper, Call(frame.place(decorator), [value]))
                value = result if not isinstance(result, Mystery) else value
            else:
                memoization.doubt(self.world, function, 'is decorated by', decorator)
                self._keep_handler(function, decorator, frame, wrapper)
        return value

    def _with_accessor(self, function: Function, decorator: ast.Attribute, frame: Frame) -> Value:
        """``@name.setter``: the property of that name, with what assigns it."""
        known = self.evaluate(decorator.value, frame)
        made = with_accessor(self, known, decorator.attr, function)
        old = made or frame.scope.slots.get(function.name)
        return old if isinstance(old, Value) else function

    def _keep_handler(self, function: Function, node: ast.expr, frame: Frame, by: Value) -> None:
        """Code that is not scanned has the function now, as a web server has its handlers."""
        of_tests = source_text(node).startswith('pytest') or is_test(function.name)
        if function.owner is None and not of_tests:
            self.world.escaped.append((function, frame.place(node)))
            self.note_handed([function], frame.place(node), source_text(node), by)

    def make_class(self, node: ast.ClassDef, frame: Frame) -> Class:
        """A class from its statement, its body run."""
        qualname = f'{frame.qualname}.{node.name}' if frame.qualname else node.name
        cls = Class(node.name, qualname, frame.module, node)
        bases = [self.evaluate(base, frame) for base in node.bases]
        cls.bases = tuple(
            choice(list(options_of(base))) if isinstance(base, Choice) else base for base in bases
        )
        self.charge(cost_of_order(cls) // ENTRIES)
        cls.mro = resolution_order(cls)
        self._give_metaclass(cls, node, frame)
        subclass_registry.register(self.world, cls)
        scope = Scope(frame.module, frame.scope if frame.qualname else None)
        scope.slots['__class_body__'] = cls
        body = Frame(scope, None, qualname=qualname)
        self.execute_block(node.body, body)
        enumerations.settle(cls, scope.slots)
        for name, value in scope.slots.items():
            if name != '__class_body__':
                self.store.write(cls, mangled(name, cls.name), value)
                bind_by_name(name, value)
                self._name_described(cls, name, value)
        self._tell_base(cls, node, frame)
        return cls

    def _name_described(self, cls: Class, name: str, value: Value) -> None:
        """Python tells each object of a class body its name; it may stand for an attribute."""
        naming = self.special_method(value, '__set_name__', cls.place)
        if naming is not None:
            self.call(naming, Call(cls.place, [cls, Const(name)]))
        self.world.intercepts |= name == '__getattribute__'
        if self.special_method(value, '__set__', cls.place) is not None:
            self.world.described.add(name)

    def _tell_base(self, cls: Class, node: ast.ClassDef, frame: Frame) -> None:
        """``__init_subclass__`` of a base class is called with each class that is made of it."""
        bases = (base.slots for base in cls.mro[1:] if isinstance(base, Class))
        hook = next((slots[_TOLD] for slots in bases if _TOLD in slots), None)
        if isinstance(hook, Function):
            given = {
                each.arg: self.evaluate(each.value, frame)
                for each in node.keywords
                if each.arg not in (None, 'metaclass')
            }
            self.call(Bound(cls, hook), Call(frame.place(node), [], given))

    def _give_metaclass(self, cls: Class, node: ast.ClassDef, frame: Frame) -> None:
        """The metaclass of the class statement, or that of a base."""
        given = next((k.value for k in node.keywords if k.arg == 'metaclass'), None)
        value = self.evaluate(given, frame) if given is not None else None
        inherited = (base.metaclass for base in cls.bases if isinstance(base, Class))
        found = value if isinstance(value, Class) else next(filter(None, inherited), None)
        cls.metaclass = found
        if given is not None and isinstance(value, (Mystery, Library)):
            memoization.doubt(self.world, cls, 'has the metaclass', given)

    def await_value(self, value: Value, place: Place) -> Value:
        """``await value``: coroutines run, everything else gives a mystery."""
        awaited = value.slots.get(AWAITED) if isinstance(value, Instance) else None
        if isinstance(awaited, Native):
            return self.call(awaited, Call(place))
        turns = self._turns_of(value, place)
        if turns is not None:
            for turn in turns:
                if turn == NONE:
                    self.note_turn(place)
                else:
                    self.note_await(turn, place)
            return self.mystery('result of an await', place)
        self.note_await(value, place)
        if isinstance(value, Coroutine):
            return self.run_function(value.function, value.call)
        if isinstance(value, Instance) and isinstance(value.state, PlainState):
            given = self.awaited(value, place)
            if given is not None:
                return given
        return self.mystery('result of an await', place)

    def _turns_of(self, value: Value, place: Place) -> tuple[Value, ...] | None:
        """What a generator gives the executor, behind ``__await__`` of a class of the program."""
        if not isinstance(value, Instance) or not self.has_attribute(value, '__await__'):
            return None
        turn = self.attribute(value, '__await__', place)
        if not isinstance(turn, Bound) or not isinstance(turn.function, Function):
            return None
        given = self.call(turn, Call(place))
        generators.run(self, given, place, turns=True)
        is_whole = isinstance(given, Sequence) and not given.others
        return given.items if is_whole and isinstance(given, Sequence) and given.items else None

    def run_if_coroutine(self, value: Value, place: Place) -> Value:
        """Run ``value`` if it is a coroutine, which is awaited elsewhere."""
        if isinstance(value, Coroutine):
            return self.run_function(value.function, value.call)
        return value


_BINDINGS = {
    'staticmethod': 'static',
    'classmethod': 'class',
    'property': 'property',
    'cached_property': 'property',
    'abstractmethod': 'method',
    'override': 'method',
}


def _any_numbers(function: Function, call: Call) -> Call | None:
    """
    The same call with any numbers, which stands for all further calls of a recursion.

    ``None`` where no number is handed on: then the next run is as the last one.
    """

    def any_number(value: Value) -> Value:
        is_number = isinstance(value, Const) and type(value.value) in (int, float)
        reason = f'a number that {function.name} hands on to itself'
        return Mystery(Unknown(reason, call.place), 'n') if is_number else value

    args = [any_number(each) for each in call.args]
    keywords = {name: any_number(each) for name, each in call.keywords.items()}
    if args == call.args and keywords == call.keywords:
        return None
    wider = Call(call.place, args, keywords, call.more, call.text)
    wider.sources = call.sources
    return wider


def _last_name(node: ast.expr) -> str:
    if isinstance(node, ast.Name):
        return node.id
    return node.attr if isinstance(node, ast.Attribute) else ''


def _call_bound(machine: Calls, function: Bound, call: Call) -> Value:
    result = machine.call_function(function.function, call.bound_to(function.receiver))
    name = function.function.name
    if name.startswith(('acquire', 'release')):
        machine.note_lock_method(function.receiver, name)
    return result


def _call_partial(machine: Calls, function: Partial, call: Call) -> Value:
    keywords = {**function.keywords, **call.keywords}
    args = [*function.args, *call.args]
    return machine.call(function.function, Call(call.place, args, keywords, call.more, call.text))


def _call_native(machine: Calls, function: Native, call: Call) -> Value:
    generators.run_given(machine, function, call)
    return function.handler(machine, function.receiver, call)


def _call_library(machine: Calls, function: Library, call: Call) -> Value:
    generators.run_given(machine, function, call)
    given_functions.run_by(machine, function, call)
    return machine.call_library(function, call)


def _call_instance(machine: Calls, function: Instance, call: Call) -> Value:
    method = machine.attribute(function, '__call__', call.place)
    if isinstance(method, (Bound, Native)):
        return machine.call(method, call)
    return machine.unknown_call(function, call)


def _call_class(machine: Calls, function: Class, call: Call) -> Value:
    maker = of_metaclass(function, '__call__')
    return machine.call(maker, call) if maker is not None else machine.instantiate(function, call)


def _call_function(machine: Calls, function: Function, call: Call) -> Value:
    return machine.call_function(function, call)


_CALLABLE: dict[type[Value], Callable[..., Value]] = {
    Function: _call_function,
    Bound: _call_bound,
    Class: _call_class,
    Partial: _call_partial,
    Native: _call_native,
    Library: _call_library,
    Instance: _call_instance,
}
