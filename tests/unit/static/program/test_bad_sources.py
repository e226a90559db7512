"""Odd and hostile files end in a result or in a diagnostic with its place, never in a crash."""

from __future__ import annotations

import ast
import os
import sys
from pathlib import Path

import pytest

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.static.api import scan, scan_text
from ros2cc_extract.extract.static.program.newer_syntax import needs_newer_python

HEAD = 'import rclpy\n'
SPIN = 'rclpy.spin(rclpy.create_node("a"))\n'


def slugs(extraction_of: bytes | str, folder: Path) -> list[tuple[str, int]]:
    path = folder / 'node.py'
    data = extraction_of.encode() if isinstance(extraction_of, str) else extraction_of
    path.write_bytes(data)
    found = scan([path], root=folder).diagnostics
    return [(diagnostic.slug, diagnostic.place.line) for diagnostic in found]


@pytest.mark.parametrize(
    ('content', 'expected'),
    [
        ('', []),
        (HEAD + 'def f(:\n', [('syntax-error', 2)]),
        (HEAD + 'print "x"\n', [('python-2', 2)]),
        (b'import rclpy\x00\nx = 1\n', [('binary-file', 1)]),
        (b'import rclpy\nx = "\xe9"\n', [('undecodable-file', 2)]),
        (b'# coding: nonsense\nimport rclpy\n', [('undecodable-file', 1)]),
        (HEAD + 'x = ' + '(' * 5000 + ')' * 5000, [('nested-too-deeply', 2)]),
        (HEAD + 'x = 1\n' * 290_000, []),
        (HEAD + 'x = 1\n' * 310_000, [('file-too-large', 0)]),
        (HEAD + f'# {" " * 70}\n' * 120_000, [('file-too-large', 0)]),
        (HEAD + 'x = a' + '()' * 2_000 + '\n', []),
    ],
    ids=lambda value: None,
)
def test_odd_file(content: bytes | str, expected: list[tuple[str, int]], tmp_path: Path) -> None:
    assert slugs(content, tmp_path) == expected


@pytest.mark.parametrize(
    'content',
    [HEAD + 'x = ' + '+'.join(['a'] * 10_000) + '\n', HEAD + 'x = a' + '.b' * 5_000 + '\n'],
    ids=['sum', 'attributes'],
)
def test_depth_is_limited_by_the_interpreter_alone(content: str, tmp_path: Path) -> None:
    """Python 3.12 and 3.13 have a limit of their own that nobody can raise."""
    assert slugs(content, tmp_path) == ([] if parses(content) else [('nested-too-deeply', 1)])


def parses(text: str) -> bool:
    before = sys.getrecursionlimit()
    sys.setrecursionlimit(100_000)
    try:
        ast.parse(text)
    except RecursionError:
        return False
    finally:
        sys.setrecursionlimit(before)
    return True


@pytest.mark.parametrize(
    'content',
    [
        b'\xef\xbb\xbf' + (HEAD + SPIN).encode(),
        (HEAD + SPIN).replace('\n', '\r\n').encode(),
        b'# -*- coding: latin-1 -*-\nname = "\xe9"\n' + (HEAD + SPIN).encode(),
    ],
    ids=['bom', 'crlf', 'latin-1'],
)
def test_unusual_encodings_are_read(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / 'node.py'
    path.write_bytes(content)
    assert [unit.name for unit in scan([path]).units] == ['a']


@pytest.mark.parametrize(
    ('statement', 'running', 'expected'),
    [
        ('class Box[T]:', (3, 11), 'Python 3.12 or newer, which knows type parameters'),
        ('async def first[T](of: T): ...', (3, 10), 'Python 3.12 or newer, which knows type'),
        ('class Box[T = int]:', (3, 12), 'Python 3.13 or newer, which knows defaults'),
        ('type Pair = tuple[int, int]', (3, 11), 'Python 3.12 or newer, which knows the type'),
        ('except* OSError:', (3, 10), 'Python 3.11 or newer, which knows except*'),
        ("name = t'{x}'", (3, 13), 'Python 3.14 or newer, if this is a template string'),
        ("""log(f'{x['a']}')""", (3, 11), 'Python 3.12 or newer, if it is for quotes'),
    ],
)
def test_syntax_of_a_newer_python_is_told_by_its_version(
    statement: str, running: tuple[int, int], expected: str
) -> None:
    assert f'run ros2cc-extract by {expected}' in (
        needs_newer_python(f'x = 1\n{statement}\n', 2, running) or ''
    )
    assert needs_newer_python(statement, 1, (3, 14)) is None


@pytest.mark.parametrize('statement', ['x = = 1', 'class Box(T:', "type('x'", 'def f(x[0]):', ''])
def test_other_syntax_errors_are_of_every_python(statement: str) -> None:
    assert needs_newer_python(statement, 1, (3, 10)) is None


@pytest.mark.skipif(sys.version_info >= (3, 12), reason='this Python knows that syntax')
def test_the_rest_of_a_program_is_scanned_without_a_file_of_newer_syntax(tmp_path: Path) -> None:
    (tmp_path / 'box.py').write_text(HEAD + 'class Box[T]:\n    pass\n')
    (tmp_path / 'node.py').write_text(HEAD + SPIN)
    found = scan([tmp_path], root=tmp_path)
    assert [unit.name for unit in found.units] == ['a']
    assert [(str(d.place), d.help.partition(';')[0]) for d in found.diagnostics] == [
        ('box.py:2:10', 'run ros2cc-extract by Python 3.12 or newer, which knows type parameters')
    ]


def test_program_without_end_is_cut_off_once(tmp_path: Path) -> None:
    """Callbacks share one budget: what is left over is missing, and one place says why."""
    callbacks = ''.join(
        f'    def on_{n}(self):\n' + '        self.x = 1\n' * 1_000 for n in range(40)
    )
    made = ''.join(f'        self.create_timer(1.0, self.on_{n % 40})\n' for n in range(300))
    init = '    def __init__(self):\n        super().__init__("a")\n'
    program = f'{HEAD}class A(rclpy.node.Node):\n{init}{made}{callbacks}\nrclpy.spin(A())\n'
    path = tmp_path / 'node.py'
    path.write_text(program)
    found = scan([path])
    assert [d.slug for d in found.diagnostics] == ['not-followed']
    assert [len(unit.callbacks) for unit in found.units] == [300]
    (lacking,) = [fact.source for fact in found.units[0].unresolved if fact.fact == 'entities']
    assert lacking == found.diagnostics[0].place


NODE = """\
class A(rclpy.node.Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick)
    def tick(self):
        pass
class A0(A):
    pass
"""


def test_a_long_line_of_classes_is_followed_soon() -> None:
    classes = ''.join(f'class A{n + 1}(A{n}):\n    pass\n' for n in range(3_000))
    found = scan_text(f'{HEAD}{NODE}{classes}rclpy.spin(A3000())\n')
    assert [len(unit.callbacks) for unit in found.units] == [1]


def test_a_line_of_classes_that_would_fill_the_memory_is_cut_off_and_told() -> None:
    classes = ''.join(f'class A{n + 1}(A{n}):\n    pass\n' for n in range(10_000))
    found = scan_text(f'{HEAD}{NODE}{classes}rclpy.spin(A10000())\n')
    assert {d.slug for d in found.diagnostics} == {'not-followed'}


def test_what_lies_too_deep_is_told() -> None:
    """Calls within calls are no recursion: what the last would make is missing."""
    form = 'class A{m}(A{n}):\n    def __init__(self):\n        super().__init__()\n'
    classes = ''.join(form.format(m=n + 1, n=n) for n in range(60))
    found = scan_text(f'{HEAD}{NODE}{classes}rclpy.spin(A60())\n')
    (told,) = (d for d in found.diagnostics if d.slug == 'not-followed')
    assert told.message == 'what is called here, 40 calls deep, is not followed'


@pytest.mark.parametrize('value', ['range(10**30)', '[1] * -10**30'])
def test_numbers_beyond_those_that_python_counts_with(value: str) -> None:
    found = scan_text(f'{HEAD}x = {value}\n{SPIN}')
    assert (found.diagnostics, len(found.units)) == ((), 1)


def test_missing_path_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='no such file or directory'):
        scan([tmp_path / 'none.py'])


def test_directory_without_python_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='no Python file'):
        scan([tmp_path])


@pytest.mark.skipif(os.geteuid() == 0, reason='root may read everything')
def test_unreadable_file_is_a_diagnostic(tmp_path: Path) -> None:
    path = tmp_path / 'node.py'
    path.write_text(HEAD)
    path.chmod(0)
    assert [d.slug for d in scan([path]).diagnostics] == ['unreadable-file']


def test_broken_link_is_a_diagnostic(tmp_path: Path) -> None:
    (tmp_path / 'gone.py').symlink_to(tmp_path / 'nowhere.py')
    (tmp_path / 'node.py').write_text(HEAD + SPIN)
    found = scan([tmp_path])
    assert [d.slug for d in found.diagnostics] == ['unreadable-file']
    assert [unit.name for unit in found.units] == ['a']


def test_links_in_a_circle_are_not_followed(tmp_path: Path) -> None:
    (tmp_path / 'inner').mkdir()
    (tmp_path / 'inner' / 'loop').symlink_to(tmp_path)
    (tmp_path / 'node.py').write_text(HEAD + SPIN)
    assert scan([tmp_path], root=tmp_path).files_seen == ('node.py',)


ENDLESS = {
    'exponential calls': 'def f0(x): return x\n'
    + ''.join(f'def f{i}(x): return f{i - 1}(f{i - 1}(x))\n' for i in range(1, 30))
    + 'f29(1)\n',
    'deep loops': 'def f():\n'
    + ''.join('  ' * (i + 1) + f'for i{i} in range(60):\n' for i in range(8))
    + '  ' * 9
    + 'x = 1\nf()\n',
}


def test_calls_on_plain_data_without_end_are_left_and_the_rest_is_followed() -> None:
    extraction = scan_text(HEAD + ENDLESS['exponential calls'] + SPIN)
    assert [(unit.nodes, unit.executor.spun) for unit in extraction.units] == [
        (('a',), 'rclpy.spin')
    ]
    assert extraction.diagnostics == ()


def test_a_program_without_end_is_cut_off_and_said_so() -> None:
    text = HEAD + ENDLESS['deep loops'] + SPIN
    assert [d.slug for d in scan_text(text).diagnostics] == ['not-followed']


@pytest.mark.parametrize(
    'text',
    [
        'class A(B): pass\nclass B(A): pass\nclass C(C): pass\n',
        'def f(n): return g(n)\ndef g(n): return f(n) + g(n)\nf(1)\n',
        'x = "a" * 10**9\ny = 2 ** 10**9\nz = "%1000000000d" % 1\nu = [0] * 10**9\n',
        'w = "{:>1000000000}".format(1)\nv = f"{1:>1000000000}"\ns = "a".zfill(10**9)\n',
        'for i in range(10**12): x = i\n',
        'import sys\nsys.exit(1)\n',
        'a, *b, c = unknown\n(d, e), f = (1, 2), 3\nglobal g\n',
        'x: int\ndel y\nassert z, w\nraise ValueError\n',
    ],
)
def test_odd_programs_end(text: str) -> None:
    assert scan_text(HEAD + text).diagnostics == ()


def test_progress_ends_at_the_total(tmp_path: Path) -> None:
    (tmp_path / 'one.py').write_text(HEAD + SPIN)
    (tmp_path / 'two.py').write_text(HEAD)
    steps: list[tuple[int, int]] = []
    scan([tmp_path], progress=lambda done, total: steps.append((done, total)))
    assert steps[-1][0] == steps[-1][1]


def test_two_scans_say_the_same() -> None:
    text = HEAD + 'def main():\n    n = rclpy.create_node("a")\n' + SPIN
    assert scan_text(text) == scan_text(text)


def test_scanned_code_is_never_run(tmp_path: Path) -> None:
    flag = tmp_path / 'flag'
    scan_text(f'import rclpy\nopen({str(flag)!r}, "w").write("x")\n' + SPIN)
    assert not flag.exists()


def timers(set_up: str, before: str = '') -> str:
    lines = (HEAD, before, 'n = rclpy.create_node("a")\n', set_up, 'rclpy.spin(n)\n')
    return ''.join(lines)


CALLS_THAT_DOUBLE = ''.join(
    f'def f{i}(n):\n    f{i - 1}(n)\n    f{i - 1}(n)\n' for i in range(1, 31)
)
LAMBDAS_THAT_DOUBLE = 'f0 = lambda n: n.create_timer(1.0, print)\n' + ''.join(
    f'f{i + 1} = lambda n: (f{i}(n), f{i}(n))\n' for i in range(30)
)
FIRST = 'def f0(n):\n    n.create_timer(1.0, print)\n'


@pytest.mark.parametrize(
    ('content', 'is_followed'),
    [
        (timers('x = [n]\n' + 'x = x + x\n' * 12), True),
        (timers('x = [n]\n' + 'x = x + x\n' * 60), False),
        (timers('x = [n]\n' + 'x += x\n' * 60), False),
        (timers('x = [n]\n' + 'x.extend(x)\n' * 60), False),
        (timers('x = [n]\n' + 'x = [*x, *x]\n' * 60), False),
        (timers('x = [n]\n' + 'x = x * 900\n' * 60), False),
        (timers('f8(n)\n', FIRST + CALLS_THAT_DOUBLE), True),
        (timers('f30(n)\n', FIRST + CALLS_THAT_DOUBLE), False),
        (timers('f8(n)\n', LAMBDAS_THAT_DOUBLE), True),
        (timers('f30(n)\n', LAMBDAS_THAT_DOUBLE), False),
    ],
)
def test_what_doubles_is_followed_for_some_time(
    content: str, is_followed: bool, tmp_path: Path
) -> None:
    found = slugs(content, tmp_path)
    assert (not found) is is_followed
    assert len(found) <= 1


def test_a_text_that_doubles_is_unknown(tmp_path: Path) -> None:
    text = timers('x = "x"\n' + 'x = f"{x}{x}"\n' * 60 + 'n.create_publisher(int, x, 1)\n')
    path = tmp_path / 'node.py'
    path.write_text(text)
    assert scan([path], root=tmp_path).diagnostics == ()


def test_a_pool_has_as_many_threads_as_can_matter(tmp_path: Path) -> None:
    path = tmp_path / 'node.py'
    path.write_text(
        HEAD
        + 'from rclpy.executors import MultiThreadedExecutor\n'
        + 'n = rclpy.create_node("a")\nn.create_timer(1.0, print)\n'
        + 'e = MultiThreadedExecutor(10**9)\ne.add_node(n)\ne.spin()\n'
    )
    [unit] = scan([path], root=tmp_path).units
    assert len(unit.executor.threads) == 128
    assert unit.executor.assumed == '128 threads behave as 1000000000 do'
