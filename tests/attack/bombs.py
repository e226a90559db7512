"""Sources that are small, or nearly, and cost too much when followed without counting."""

from __future__ import annotations

import random
from collections.abc import Callable

HEAD = """\
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
"""
NODE = """
class A(Node):
    def __init__(self):
        super().__init__(NAME)
        self.create_timer(1.0, self.tick)
        self.begin()
    def begin(self):
        pass
    def tick(self):
        pass
"""
BEGIN = '    def begin(self):\n'
TICK = '    def tick(self):\n'
MAIN = 'def main():\n    rclpy.init()\n    rclpy.spin(LAST())\n'


def program(
    *members: str, top: str = '', name: str = "'a'", after: str = '', last: str = 'A'
) -> str:
    """A node with these members, text before and after it, and its main."""
    node = NODE.replace('NAME', name)
    return ''.join((HEAD, top, node, *members, after, MAIN.replace('LAST', last)))


def numbered(form: str, count: int) -> str:
    """So many copies, with their number and the next one in them."""
    return ''.join(form.replace('#', str(i)).replace('@', str(i + 1)) for i in range(count))


def calls_that_double(size: int) -> str:
    bodies = numbered('    def f#(self):\n        self.f@()\n        self.f@()\n', size)
    return program(BEGIN, '        self.f0()\n', bodies)


def calls_with_arguments_that_double(size: int) -> str:
    form = '    def f#(self, x):\n        self.f@(x + [1])\n        self.f@(x + [2])\n'
    last = f'    def f{size}(self, x):\n        self.client.call(x)\n'
    return program(TICK, '        self.f0([])\n', numbered(form, size), last)


def functions_that_double(size: int) -> str:
    return program(
        top='f0 = lambda x: x\n'
        + numbered('f@ = lambda x: (f#(x), f#([x]))\n', size)
        + f'print(f{size}(1))\n'
    )


def texts_that_double(size: int) -> str:
    return program(top="x = 'ab'\n" + 'x = x + x\n' * size, name='x')


def formats_that_double(size: int) -> str:
    return program(top="x = 'ab'\n" + "x = f'{x}{x}'\n" * size, name='x')


def lists_that_double(size: int) -> str:
    return program(top='x = [1, 2]\n' + 'x = x + x\n' * size, name='str(x)')


def lists_within_lists(size: int) -> str:
    top = 'x = [1]\n' + 'x = [x, x]\n' * size
    return program(TICK, '        if x == x:\n            print(str(x))\n', top=top, name='str(x)')


def dictionaries_within_dictionaries(size: int) -> str:
    top = 'x = {}\n' + 'x = {"a": x, "b": x, **x}\n' * size
    return program(TICK, '        for k, v in x.items():\n            v[k].get(k)\n', top=top)


def timers_under_conditions(size: int) -> str:
    form = """\
        if self.get_parameter('p#').value:
            self.t = self.create_timer(1.0, self.c#)
"""
    bodies = numbered('    def c#(self):\n        self.x = #\n', 8 * size)
    return program(BEGIN, numbered(form, 8 * size), bodies)


def many_timers(size: int) -> str:
    bodies = numbered('    def c#(self):\n        self.x = self.x + 1\n', 10 * size)
    return program(BEGIN, numbered('        self.create_timer(@.0, self.c#)\n', 10 * size), bodies)


def line_of_inheritance(size: int) -> str:
    classes = 'class A0(A):\n    pass\n' + numbered('class A@(A#):\n    pass\n', 50 * size)
    return program(after=classes, last=f'A{50 * size}')


def line_of_constructors(size: int) -> str:
    form = 'class A@(A#):\n    def __init__(self):\n        super().__init__()\n'
    classes = 'class A0(A):\n    pass\n' + numbered(form, 50 * size)
    return program(after=classes, last=f'A{50 * size}')


def lattice_of_inheritance(size: int) -> str:
    form = 'class L@(L#):\n    pass\nclass R@(R#):\n    pass\nclass A@(L@, R@):\n    pass\n'
    classes = 'class L0(A):\n    pass\nclass R0(A):\n    pass\n' + numbered(form, size)
    return program(after=classes, last=f'A{size}')


def threads_without_number(size: int) -> str:
    run = f'e = MultiThreadedExecutor(num_threads=10**{size})\ne.add_node(A())\ne.spin()\n'
    return program(after=run)


def loops_within_loops(size: int) -> str:
    depth = min(size, 15)
    lines = ''.join(f'{" " * (8 + i)}for i{i} in range(1000):\n' for i in range(depth))
    return program(BEGIN, lines, f'{" " * (8 + depth)}self.create_timer(1.0, self.tick)\n')


def ring_of_services(size: int) -> str:
    form = """\
        self.c# = self.create_client(X, 's#')
        self.create_service(X, 's#', self.f#)
"""
    bodies = numbered('    def f#(self, a, b):\n        self.c@.call(a)\n', size)
    return program(BEGIN, numbered(form, size), bodies)


def locks_in_every_order(size: int) -> str:
    form = """\
        self.l# = threading.Lock()
        self.create_timer(1.0, self.f#)
"""
    bodies = []
    for number in range(size):
        locks = ', '.join(f'self.l{(number + k) % size}' for k in range(min(size, 20)))
        bodies.append(f'    def f{number}(self):\n        with {locks}:\n            pass\n')
    return program(BEGIN, numbered(form, size), *bodies)


def branches(size: int) -> str:
    form = """\
        if self.a# and self.f#.done():
            self.g = self.f#
        else:
            self.g = self.h#
"""
    return program(TICK, numbered(form, size), '        self.g.wait()\n')


def recursion(size: int) -> str:
    form = """\
    def f#(self, x=0):
        for y in self.f@(x + 1):
            self.f#(y)
"""
    last = f'    def f{size}(self, x=0):\n        return self.f0(x)\n'
    return program(BEGIN, '        self.f0()\n', numbered(form, size), last)


def expressions_that_nest(size: int) -> str:
    deep = (
        '-' * 500 * size + '1',
        '(' * 3 * size + ')' * 3 * size,
        'rclpy' + '.a' * 500 * size,
        '+'.join(['1'] * 500 * size),
    )
    return program(top=f'x = {deep[size % 4]}\n')


LARGE = (
    '9**9**9',
    '1 << (1 << 40)',
    "'a' * 10**12",
    '[0] * 10**12',
    "'%1000000000d' % 3",
    "f'{3:1000000000}'",
    "'a'.ljust(10**11)",
    'list(range(10**18))',
    'bytes(10**11)',
    "'x'.join(['y' * 1000] * 10**8)",
    "int('9' * 4000) ** 4000",
    'sum(range(10**18))',
    'set(range(10**9))',
    "'a'.replace('a', 'b' * 10**9)",
    '{i: i for i in range(10**9)}',
    "'{:1000000000}'.format(1)",
    'tuple(map(str, range(10**9)))',
    "'ab'.center(10**12)",
    "'\\t'.expandtabs(10**11)",
    '(1).to_bytes(10**11)',
    'list(zip(range(10**9)))',
    '2**100000000',
    'range(10**30)',
    '[[0] * 10**6] * 10**6',
    "'a'.zfill(10**12)",
    'float(10**400)',
    'round(1e308, -10**9)',
    '-(-9**9**9)',
    'max(range(10**12))',
    '"%s" % ([1] * 10**9)',
)


def large_values(size: int) -> str:
    lines = [f'x{i} = {LARGE[(size + i) % len(LARGE)]}\n' for i in range(4)]
    period = f'        self.create_timer({LARGE[size % len(LARGE)]}, self.tick)\n'
    return program(BEGIN, period, top=''.join(lines), name='str(x0)')


BOMBS: tuple[Callable[[int], str], ...] = (
    calls_that_double,
    calls_with_arguments_that_double,
    functions_that_double,
    texts_that_double,
    formats_that_double,
    lists_that_double,
    lists_within_lists,
    dictionaries_within_dictionaries,
    timers_under_conditions,
    many_timers,
    line_of_inheritance,
    line_of_constructors,
    lattice_of_inheritance,
    threads_without_number,
    loops_within_loops,
    ring_of_services,
    locks_in_every_order,
    branches,
    recursion,
    expressions_that_nest,
    large_values,
)
LARGEST = 60


def bomb(chance: random.Random) -> str:
    """One of them, of any size."""
    return chance.choice(BOMBS)(chance.randint(1, LARGEST))
