"""
CC301, CC305: ways in which two callbacks keep and change common state, each bad and under a lock.
"""

from __future__ import annotations

from textwrap import indent

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

NODE = """\
import array, collections, copy, itertools, threading, time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Counter(Node):
    def __init__(self):
        super().__init__('counter')
        self.guard = threading.Lock()
        {made}
        one, two = MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()
        self.create_subscription(String, 'a', self.on_a, 10, callback_group=one)
        self.create_subscription(String, 'b', self.on_b, 10, callback_group=two)

    def cost(self, msg):
        time.sleep(0.01)
        return len(msg.data)

    def on_a(self, msg):
{on_a}

    def on_b(self, msg):
{on_b}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Counter())
executor.spin()
"""
SAME = {
    'attr': ('self.n = 0', 'self.n += self.cost(msg)'),
    'attr_split': ('self.n = 0', 'x = self.n\nself.n = x + self.cost(msg)'),
    'dict': ('self.t = {"n": 0}', 'self.t["n"] += self.cost(msg)'),
    'dict_get': ('self.t = {}', 'self.t["n"] = self.t.get("n", 0) + self.cost(msg)'),
    'dict_ior': ('self.t = {"n": 0}', 'self.t |= {"n": self.t["n"] + self.cost(msg)}'),
    'defaultdict': ('self.t = collections.defaultdict(int)', 'self.t["n"] += self.cost(msg)'),
    'counter': ('self.t = collections.Counter()', 'self.t["n"] += self.cost(msg)'),
    'list': ('self.l = [0]', 'self.l[0] += self.cost(msg)'),
    'list_alias': ('self.l = [0]', 'l = self.l\nl[0] += self.cost(msg)'),
    'bytearray': ('self.l = bytearray(4)', 'self.l[0] = self.l[0] + self.cost(msg)'),
    'array': ('self.l = array.array("i", [0])', 'self.l[0] += self.cost(msg)'),
    'dunder_dict': ('self.n = 0', 'self.__dict__["n"] += self.cost(msg)'),
    'closure': (
        'n = 0\ndef bump(k):\n    nonlocal n\n'
        '    x = n\n    time.sleep(0.01)\n    n = x + k\nself.bump = bump',
        'self.bump(self.cost(msg))',
    ),
    'closure_list': (
        'n = [0]\ndef bump(k):\n    x = n[0]\n'
        '    time.sleep(0.01)\n    n[0] = x + k\nself.bump = bump',
        'self.bump(self.cost(msg))',
    ),
    'walrus': ('self.n = 0', 'self.n = (x := self.n) + self.cost(msg)'),
    'tuple_assign': (
        'self.n = 0\nself.m = 0',
        'self.n, self.m = self.n + self.cost(msg), self.m + 1',
    ),
    'string': ('self.log = ""', 'self.log += msg.data + str(self.cost(msg))'),
    'list_plus': ('self.l = []', 'self.l = self.l + [self.cost(msg)]'),
    'list_filter': ('self.l = [1, 2]', 'self.l = [x for x in self.l if self.cost(msg) < x]'),
    'list_slice': (
        'self.l = [1, 2]',
        'y = [x for x in self.l if x > 1]\ntime.sleep(0.01)\nself.l[:] = y',
    ),
    'set_diff': (
        'self.s = set()',
        'x = self.s - {1}\ntime.sleep(0.01)\nself.s = x | {self.cost(msg)}',
    ),
    'deque_rot': (
        'self.d = collections.deque([0])',
        'x = self.d[-1]\ntime.sleep(0.01)\nself.d[-1] = x + 1',
    ),
    'check_act_list': ('self.l = [1]', 'if self.l:\n    time.sleep(0.01)\n    self.l.pop()'),
    'check_act_len': (
        'self.l = [1]',
        'if len(self.l) > 0:\n    time.sleep(0.01)\n    self.l.pop(0)',
    ),
    'check_act_in': (
        'self.t = {"k": 1}',
        'if "k" in self.t:\n    time.sleep(0.01)\n    del self.t["k"]',
    ),
    'check_act_none': (
        'self.arm = None',
        'if self.arm is None:\n    time.sleep(0.01)\n    self.arm = object()',
    ),
    'check_act_flag': (
        'self.busy = False',
        'if not self.busy:\n    time.sleep(0.01)\n'
        '    self.busy = True\n    self.cost(msg)\n    self.busy = False',
    ),
    'check_act_state': (
        'self.state = "idle"',
        'if self.state == "idle":\n    time.sleep(0.01)\n    self.state = "run"',
    ),
    'match_state': (
        'self.state = "idle"',
        'match self.state:\n    case "idle":\n        time.sleep(0.01)\n'
        '        self.state = "run"\n    case _:\n        self.state = "idle"',
    ),
    'itertools_count': (
        'self.c = itertools.count()',
        'x = next(self.c)\nif x == 3:\n    time.sleep(0.01)\n    self.c = itertools.count()',
    ),
    'swap': ('self.x = 0\nself.y = 1', 'self.x, self.y = self.y, self.x + self.cost(msg)'),
    'minmax': ('self.n = 0', 'self.n = max(self.n, self.cost(msg))'),
    'ternary': ('self.n = 0', 'self.n = self.n + 1 if self.cost(msg) else self.n'),
    'copy_mod': (
        'self.t = {}',
        'c = copy.deepcopy(self.t)\ntime.sleep(0.01)\nc["n"] = 1\nself.t = c',
    ),
    'dict_comp': (
        'self.t = {}',
        't = {k: x for k, x in self.t.items()}\nt[msg.data] = 1\ntime.sleep(0.01)\nself.t = t',
    ),
}
"""What is made, and what both callbacks do."""
DIFFERENT = {
    'iter_dict': (
        'self.t = {}',
        'for k, x in self.t.items():\n    time.sleep(0.01)',
        'self.t[msg.data] = 1',
    ),
    'iter_set': (
        'self.s = set()',
        'for k in self.s:\n    time.sleep(0.01)',
        'self.s.add(msg.data)',
    ),
    'iter_deque': (
        'self.d = collections.deque(maxlen=5)',
        'for k in self.d:\n    time.sleep(0.01)',
        'self.d.append(1)',
    ),
    'iter_list_idx': (
        'self.l = []',
        'for i in range(len(self.l)):\n    time.sleep(0.01)\n    x = self.l[i]',
        'self.l.clear()',
    ),
    'iter_comp': (
        'self.s = set()',
        'x = sum(self.cost(msg) + y for y in self.s)',
        'self.s.discard(msg.data)',
    ),
    'none_use': (
        'self.arm = []',
        'if self.arm:\n    time.sleep(0.01)\n    self.arm.append(1)',
        'self.arm = None',
    ),
    'none_use_early': (
        'self.arm = []',
        'if self.arm is None:\n    return\ntime.sleep(0.01)\nself.arm.append(1)',
        'self.arm = None',
    ),
    'torn_pair': (
        'self.x = 0\nself.y = 0',
        'self.x = self.cost(msg)\ntime.sleep(0.01)\nself.y = self.x',
        'print(self.x - self.y)',
    ),
    'torn_list': (
        'self.p = [0, 0]',
        'self.p[0] = self.cost(msg)\ntime.sleep(0.01)\nself.p[1] = self.p[0]',
        'print(self.p[0] - self.p[1])',
    ),
    'torn_dict': (
        'self.p = dict(x=0, y=0)',
        'self.p["x"] = self.cost(msg)\ntime.sleep(0.01)\nself.p["y"] = self.p["x"]',
        'print(self.p["x"] - self.p["y"])',
    ),
    'cond_reset': (
        'self.n = 0',
        'if self.n >= 10:\n    time.sleep(0.01)\n    self.n = 0',
        'self.n += self.cost(msg)',
    ),
    'publish_clear': (
        'self.buf = []',
        'for x in list(self.buf):\n    time.sleep(0.01)\nself.buf.clear()',
        'self.buf.append(self.cost(msg))',
    ),
}
"""What is made, and what each callback does."""
WAYS = {**{name: (made, both, both) for name, (made, both) in SAME.items()}, **DIFFERENT}


def told(made: str, on_a: str, on_b: str) -> set[str]:
    text = NODE.format(
        made=indent(made, ' ' * 8).strip(), on_a=indent(on_a, ' ' * 8), on_b=indent(on_b, ' ' * 8)
    )
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    races = (each for each in found if each.code.startswith('CC3'))
    return {each.code for each in races if each.severity is Severity.WARNING}


@pytest.mark.parametrize('way', WAYS)
def test_what_two_callbacks_change_together_is_told(way: str) -> None:
    assert told(*WAYS[way]) <= {'CC301', 'CC305'}
    assert told(*WAYS[way])


@pytest.mark.parametrize('way', WAYS)
def test_the_same_under_one_lock_is_not(way: str) -> None:
    made, on_a, on_b = WAYS[way]
    locked = (f'with self.guard:\n{indent(each, " " * 4)}' for each in (on_a, on_b))
    assert told(made, *locked) == set()
