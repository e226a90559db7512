"""
Each way is a piece of a callback that comes to ``wait``, which waits for another callback.

Each was run in Python first, with the wait replaced by what notes that it was reached.
"""

from __future__ import annotations

from collections.abc import Iterator
from textwrap import indent
from typing import NamedTuple


class Way(NamedTuple):
    """
    :param use: what the callback does.
    :param method: a method of ``Gate`` that waits: its head and what it returns.
    :param more: other methods of the node.
    :param before: what stands before the node.
    :param base: of ``Gate``, or a second one of the node.
    :param init: what the constructor does.
    """

    name: str
    use: str
    method: tuple[str, str] | None = None
    more: str = ''
    before: str = ''
    base: str = ''
    init: str = ''


PROGRAM = """
import asyncio, collections, contextlib, copy, enum, functools, heapq, itertools, math
import queue, threading, time, types, typing
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
{before}

class Planner(Node{base}):
    def __init__(self):
        super().__init__('planner')
        self.ready = {made}
        self.items = [1, 2]
        self.create_subscription(String, 'map', self.on_map, 10)
        self.create_timer(1.0, self.on_timer)
{init}

    def on_map(self, msg):
        {ended}

    def on_timer(self):
{use}

    def wait(self, *args):
{wait}
        return 1

{more}

rclpy.init()
rclpy.spin(Planner())
"""
GATE = """
class Gate{base}:
    def __init__(self, node):
        self.node = node

    def {head}:
        self.node.wait()
        return {given}
{rest}
"""
KINDS = {
    'Event.wait': ('threading.Event()', 'self.ready.set()', 'self.ready.wait()'),
    'Queue.get': ('queue.Queue()', 'self.ready.put(1)', 'self.ready.get()'),
    'Semaphore.acquire': (
        'threading.Semaphore(0)',
        'self.ready.release()',
        'self.ready.acquire()',
    ),
    'polling loop': (
        'False',
        'self.ready = True',
        'while not self.ready:\n    time.sleep(0.01)',
    ),
}


def text_of(way: Way, kind: str) -> str:
    """The program in which ``way`` leads to a wait of that kind."""
    made, ended, wait = KINDS[kind]
    before, init = way.before, way.init
    if way.method is not None:
        head, given = way.method
        rest = indent(way.more, ' ' * 4)
        before += GATE.format(base=way.base, head=head, given=given, rest=rest)
        init += '\nself.gate = Gate(self)'
    return PROGRAM.format(
        before=before,
        base='' if way.method is not None else way.base,
        made=made,
        ended=ended,
        init=indent(init, ' ' * 8),
        use=indent(way.use, ' ' * 8),
        wait=indent(wait, ' ' * 8),
        more='' if way.method is not None else indent(way.more, ' ' * 4),
    )


_OWN_ITER = '\ndef __iter__(self):\n    return self\n'
_CHAIN = 'self.known = collections.ChainMap'
_HEAP = 'self.rows = []\nheapq.heappush(self.rows, (1, self.wait))'
_OBJECTS = 'self.rows = []\nheapq.heappush(self.rows, Gate(self))'
_LATER = "time.strftime('later')"
_UPDATED = f'self.__dict__.update({{{_LATER}: self.wait}})'
_MISSING = """
class Gates(dict):
    def __init__(self, node):
        self.node = node

    def __missing__(self, key):
        self.node.wait()
        return 1
"""
_DISPATCHED = """
class Step: ...
class Leg(Step): ...

@functools.singledispatch
def handle(item, node):
    {other}

@handle.register({kind})
def _(item, node):
    {one}
"""
_BOX = """
class Box:
    def __init__(self, node):
        self.node = node

    def {}
"""
_RUN = 'asyncio.run(self.work_off())'
_ASYNC = """
async def work_off(self):
    {}

async def items_of(self):
    self.wait()
    yield 1
"""
_STEPS = 'self.steps = '
_FOR = 'for item in {}:\n    pass'

FOUND = [
    Way('call', 'self.wait()'),
    # Tests
    Way('if', 'if self.gate:\n    pass', ('__bool__(self)', 'True')),
    Way('not', 'free = not self.gate', ('__bool__(self)', 'True')),
    Way('and', 'free = self.gate and 1', ('__bool__(self)', 'True')),
    Way('bool', 'free = bool(self.gate)', ('__bool__(self)', 'True')),
    Way('assert', 'assert self.gate', ('__bool__(self)', 'True')),
    Way('while', _FOR.replace('for item in {}', 'while self.gate'), ('__bool__(self)', 'False')),
    Way('if a length', 'if self.gate:\n    pass', ('__len__(self)', '1')),
    Way('guard of a case', 'match 1:\n    case 1 if self.wait():\n        pass'),
    # Texts and numbers
    Way('str', 'text = str(self.gate)', ('__str__(self)', "''")),
    Way('f-string', "text = f'at {self.gate}'", ('__str__(self)', "''")),
    Way('f-string, formatted', "text = f'{self.gate:x}'", ('__format__(self, spec)', "''")),
    Way('f-string, repr', "text = f'{self.gate!r}'", ('__repr__(self)', "''")),
    Way('%', "text = 'at %s' % self.gate", ('__str__(self)', "''")),
    Way('% of two', "text = '%s %s' % (1, self.gate)", ('__str__(self)', "''")),
    Way('repr', 'text = repr(self.gate)', ('__repr__(self)', "''")),
    Way('print', 'print(self.gate)', ('__str__(self)', "''")),
    Way('int', 'number = int(self.gate)', ('__int__(self)', '1')),
    Way('float', 'number = float(self.gate)', ('__float__(self)', '1.0')),
    Way('abs', 'number = abs(self.gate)', ('__abs__(self)', '1')),
    Way('round', 'number = round(self.gate)', ('__round__(self)', '1')),
    Way('minus', 'number = -self.gate', ('__neg__(self)', '1')),
    Way('invert', 'number = ~self.gate', ('__invert__(self)', '1')),
    Way('hash', 'number = hash(self.gate)', ('__hash__(self)', '1')),
    Way('copy', 'other = copy.copy(self.gate)', ('__copy__(self)', 'None')),
    # Items
    Way('list', 'items = list(self.gate)', ('__iter__(self)', 'iter([])')),
    Way('star', 'items = [*self.gate]', ('__iter__(self)', 'iter([])')),
    Way('unpack', 'one, two = self.gate', ('__iter__(self)', 'iter([1, 2])')),
    Way('comprehension', 'items = [i for i in self.gate]', ('__iter__(self)', 'iter([])')),
    Way('sum', 'number = sum(self.gate)', ('__iter__(self)', 'iter([])')),
    Way('join', "text = ','.join(self.gate)", ('__iter__(self)', 'iter([])')),
    Way('extend', 'self.items.extend(self.gate)', ('__iter__(self)', 'iter([])')),
    Way('list of an iterator', 'items = list(self.gate)', ('__next__(self)', '1'), _OWN_ITER),
    Way('enumerate', _FOR.format('enumerate(self.gate)'), ('__next__(self)', '1'), _OWN_ITER),
    Way('zip', _FOR.format('zip([1], self.gate)'), ('__next__(self)', '1'), _OWN_ITER),
    # Generators that the constructor has made
    Way('generator expression', 'next(self.steps)', init=f'{_STEPS}(self.wait() for _ in "ab")'),
    Way('filter of one', 'next(self.steps)', init=f'{_STEPS}(_ for _ in "ab" if self.wait())'),
    Way('map', 'self.steps.__next__()', init=f"{_STEPS}map(self.wait, 'ab')"),
    Way('filter', 'for item in self.steps:\n    break', init=f"{_STEPS}filter(self.wait, 'ab')"),
    Way(
        'generator that is primed',
        'self.steps.send(1)',
        more='def script(self):\n    got = yield\n    self.wait()\n    yield got\n',
        init=f'{_STEPS}self.script()\nnext(self.steps)',
    ),
    # Functions that call what they are given
    Way('sorted', 'sorted(self.items, key=self.wait)'),
    Way('sort', 'self.items.sort(key=self.wait)'),
    Way('max', 'max(self.items, key=self.wait)'),
    Way('reduce', 'functools.reduce(self.wait, self.items)'),
    Way('accumulate', 'list(itertools.accumulate(self.items, self.wait))'),
    Way('groupby', _FOR.format('itertools.groupby(self.items, key=self.wait)')),
    Way('takewhile', 'list(itertools.takewhile(self.wait, self.items))'),
    Way('starmap', 'list(itertools.starmap(self.wait, [(1,)]))'),
    Way('nlargest', 'heapq.nlargest(1, self.items, key=self.wait)'),
    Way(
        '__getattr__',
        'self.box.go()',
        before=_BOX.format('__getattr__(self, name):\n        return self.node.wait'),
        init='self.box = Box(self)',
    ),
    Way(
        '__getattribute__',
        'self.box.go()',
        before=_BOX.format(
            "__getattribute__(self, name):\n        return super().__getattribute__('node').wait"
        ),
        init='self.box = Box(self)',
    ),
    Way(
        '__getattribute__ that waits',
        'self.box.node',
        before=_BOX.format(
            "__getattribute__(self, name):\n        object.__getattribute__(self, 'node').wait()\n"
            '        return super().__getattribute__(name)'
        ),
        init='self.box = Box(self)',
    ),
    # Texts that are run
    Way('eval', "eval('self.wait()')"),
    Way('exec', "exec('for i in range(2):\\n    node.wait()', {'node': self})"),
    Way('eval of compile', "eval(compile('self.wait', 'text', 'eval'))()"),
    Way('text of a name', 'exec(TEXT)', before="\nTEXT = 'self.wait()'\n"),
    # Collections of functions
    Way('chain', "self.known['go']()", init=f"{_CHAIN}({{}}, {{'go': self.wait}})"),
    Way('get of a chain', "self.known.get('go')()", init=f"{_CHAIN}({{'go': self.wait}})"),
    Way('heap', 'heapq.heappop(self.rows)[1]()', init='self.rows = [(1, self.wait)]'),
    Way('heap that is filled', 'heapq.heappop(self.rows)[1]()', init=_HEAP),
    Way('heap of objects', 'heapq.heappop(self.rows).go()', ('go(self)', '1'), init=_OBJECTS),
    Way('partialmethod', 'self.later()', more='later = functools.partialmethod(wait, 1)'),
    # Classes that stand for collections
    Way(
        'method of a NamedTuple',
        'self.step.go()',
        before='\nclass Step(typing.NamedTuple):\n    node: object\n\n    def go(self):\n'
        '        self.node.wait()\n',
        init='self.step = Step(self)',
    ),
    Way('__missing__', "item = self.gates['a']", before=_MISSING, init='self.gates = Gates(self)'),
    # One of several functions
    Way(
        'singledispatch',
        'handle(1, self)',
        before=_DISPATCHED.format(other='pass', kind='int', one='node.wait()'),
    ),
    Way(
        'singledispatch of a class',
        'handle(Leg(), self)',
        before=_DISPATCHED.format(other='pass', kind='Step', one='node.wait()'),
    ),
    Way(
        'singledispatch of nothing else',
        "handle('a', self)",
        before=_DISPATCHED.format(other='node.wait()', kind='int', one='pass'),
    ),
    Way(
        'singledispatchmethod',
        'self.handle(1)',
        more='@functools.singledispatchmethod\ndef handle(self, item):\n    pass\n\n'
        '@handle.register\ndef _(self, item: int):\n    self.wait()\n',
    ),
    # Coroutines
    Way('async for', _RUN, more=_ASYNC.format('async for item in self.items_of():\n        pass')),
    Way('anext', _RUN, more=_ASYNC.format('await anext(self.items_of())')),
    Way('__anext__', _RUN, more=_ASYNC.format('await self.items_of().__anext__()')),
    Way('asend', _RUN, more=_ASYNC.format('await self.items_of().asend(None)')),
    Way(
        'async comprehension',
        _RUN,
        more=_ASYNC.format('self.rows = [each async for each in self.items_of()]'),
    ),
    Way(
        'async for of a class',
        _RUN,
        more=_ASYNC.format('async for item in Items(self):\n        pass'),
        before='\nclass Items:\n    def __init__(self, node):\n        self.node = node\n\n'
        '    def __aiter__(self):\n        return self\n\n    async def __anext__(self):\n'
        '        self.node.wait()\n        raise StopAsyncIteration\n',
    ),
    Way(
        'group of tasks',
        _RUN,
        more=_ASYNC.format(
            'async with asyncio.TaskGroup() as group:\n        group.create_task(self.work())'
        )
        + '\nasync def work(self):\n    self.wait()\n',
    ),
    # Names that are computed
    Way('setattr of a computed name', 'self.later()', init=f'setattr(self, {_LATER}, self.wait)'),
    Way('setattr of a class', 'self.later()', init=f'setattr(Planner, {_LATER}, Planner.wait)'),
    Way('item of __dict__', 'self.later()', init=f'self.__dict__[{_LATER}] = self.wait'),
    Way('item of vars', 'self.later()', init=f'vars(self)[{_LATER}] = self.wait'),
    Way('update of __dict__', 'self.later()', init=_UPDATED),
    Way('__setattr__', 'self.later()', init=f'object.__setattr__(self, {_LATER}, self.wait)'),
    # Attributes
    Way('property()', 'self.later', more='later = property(wait)'),
    Way('property() of a lambda', 'self.later', more='later = property(lambda self: self.wait())'),
    Way('property() that sets', 'self.later = 1', more='later = property(None, wait)'),
    Way(
        'deleter',
        'del self.later',
        more='@property\ndef later(self):\n    return 1\n\n'
        '@later.deleter\ndef later(self):\n    self.wait()\n',
    ),
    Way('MethodType', 'self.later()', init='self.later = types.MethodType(Planner.wait, self)'),
    Way('namespace', 'self.ns.go()', init='self.ns = types.SimpleNamespace(go=self.wait)'),
    Way(
        'member of an enumeration',
        'State.IDLE.run(self)',
        before='\nclass State(enum.Enum):\n    IDLE = 1\n\n    def run(self, node):\n'
        '        node.wait()\n',
    ),
    Way(
        'class that is told of its classes',
        'class Other(Base, node=self):\n    pass',
        before='\nclass Base:\n    def __init_subclass__(cls, node=None):\n        node.wait()\n',
    ),
    Way(
        'recursion',
        'self.again(5)',
        more='def again(self, left):\n    if left == 0:\n        self.wait()\n    else:\n'
        '        self.again(left - 1)\n',
    ),
]
"""The tool says at the wait that it never ends."""

OPEN = [
    Way('dict of objects', 'known = {self.gate: 1}', ('__hash__(self)', '1')),
    Way('index', 'item = self.items[self.gate]', ('__index__(self)', '1')),
    Way('order', 'items = sorted([self.gate, self.gate])', ('__lt__(self, other)', 'True')),
    Way('same as one of', 'found = self.gate in [1, 2]', ('__eq__(self, other)', 'True')),
    Way('end', 'self.gate = None', ('__del__(self)', 'None')),
]
"""It says that nobody is known to call what waits."""


def cases() -> Iterator[tuple[str, str]]:
    """Each way with some kind of wait, and each kind with the plain call."""
    for number, way in enumerate(FOUND):
        yield way.name, list(KINDS)[number % len(KINDS)]
    for kind in KINDS:
        yield FOUND[0].name, kind
