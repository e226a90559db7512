"""Launch files that are small, or nearly, and cost too much when followed without counting."""

from __future__ import annotations

import random
from collections.abc import Callable

from tests.attack.bombs import LARGEST, numbered
from tests.unit.launch.following import HEAD

Bomb = tuple[str, str, dict[str, str]]
"""The name of the launch file, its text, and other files of its workspace."""
NODE = '<node pkg="systems" exec="relay.py" name="n#"/>\n'


def of_xml(*parts: str, **others: str) -> Bomb:
    return 'evil.launch.xml', f'<launch>\n{"".join(parts)}</launch>\n', others


def of_yaml(*parts: str) -> Bomb:
    return 'evil.launch.yaml', f'launch:\n{"".join(parts)}', {}


def of_python(body: str) -> Bomb:
    return 'evil.launch.py', HEAD + ''.join(f'    {line}\n' for line in body.splitlines()), {}


def includes_of_itself(size: int) -> Bomb:
    one = (
        '<include file="$(dirname)/evil.launch.xml"><arg name="a" value="$(var a)x"/></include>\n'
    )
    return of_xml('<arg name="a" default="x"/>\n', one * (size % 4 + 1))


def includes_that_double(size: int) -> Bomb:
    files = {}
    for number in range(1, size):
        two = f'<include file="$(dirname)/b{number + 1}.launch.xml"/>\n' * 2
        files[f'launch___b{number}__launch__xml'] = f'<launch>\n{two}</launch>'
    files[f'launch___b{size}__launch__xml'] = f'<launch>{NODE}</launch>'
    return of_xml('<include file="$(dirname)/b1.launch.xml"/>\n', **files)


def texts_that_double(size: int) -> Bomb:
    lets = numbered('<let name="a@" value="$(var a#)$(var a#)"/>\n', size)
    node = f'<node pkg="systems" exec="relay.py" name="$(var a{size})"/>\n'
    return of_xml('<let name="a0" value="xy"/>\n', lets, node)


def groups_within_groups(size: int) -> Bomb:
    depth = 100 * size
    push = '<group><push-ros-namespace namespace="a"/>\n'
    return of_xml(push * depth, NODE, '</group>\n' * depth)


def nodes_without_number(size: int) -> Bomb:
    return of_xml(numbered(NODE, 100 * size))


def ring_of_processes(size: int) -> Bomb:
    form = """\
<node pkg="systems" exec="relay.py" name="n#">
  <remap from="request" to="r#"/><remap from="next" to="r@"/><param name="begins" value="true"/>
</node>
"""
    return of_xml(numbered(form, size).replace(f'r{size}"', 'r0"'))


def many_remaps(size: int) -> Bomb:
    remaps = numbered('<remap from="a#" to="a@"/>\n', 50 * size)
    return of_xml(f'<node pkg="systems" exec="relay.py">{remaps}</node>' * 20)


def parameters_without_number(size: int) -> Bomb:
    rows = numbered('    p#: [1, 2, 3]\n', 1000 * size)
    node = NODE.replace('/>', '><param from="$(find-pkg-share systems)/config/p.yaml"/></node>')
    stars = '/'.join(['**'] * size)
    text = f'/{stars}/x:\n  ros__parameters:\n{rows}/**:\n  ros__parameters:\n{rows}'
    return of_xml(numbered(node, 20), config___p__yaml=text)


def aliases_that_double(size: int) -> Bomb:
    first = '  - &a0 {node: {pkg: systems, exec: relay.py}}\n'
    return of_yaml(first, numbered('  - group: &a@ [*a#, *a#]\n', size))


def merges_that_double(size: int) -> Bomb:
    lines = numbered('      - &m@ {name: x, param: [*m#, *m#]}\n', size)
    head = (
        '  - node:\n      pkg: systems\n      exec: relay.py\n      param:\n      - &m0 {a: 1}\n'
    )
    return of_yaml(head, lines)


def deep_flow(size: int) -> Bomb:
    return of_yaml('  - ' + '[' * 1000 * size + ']' * 1000 * size + '\n')


VALUES = ('9**9**9', "'a'*10**12", '[0]*10**10', '1<<10**10', "'%1000000000d'%3", '(((((1)))))')


def expressions(size: int) -> Bomb:
    value = VALUES[size % len(VALUES)]
    deep = '-' * 300 * size + '1'
    return of_xml(
        f'<let name="a" value="$(eval &quot;{value}&quot;)"/>\n'.replace('<<', '&lt;&lt;'),
        f'<let name="b" value="$(eval &quot;{deep}&quot;)"/>\n',
        '<node pkg="systems" exec="relay.py" name="$(var a)$(var b)"/>\n',
    )


def substitutions_within(size: int) -> Bomb:
    depth = 100 * size
    value = '$(var ' * depth + 'a' + ')' * depth
    return of_xml(f'<node pkg="systems" exec="relay.py" name="{value}"/>\n')


def conditions_that_double(size: int) -> Bomb:
    form = '<arg name="c#"/><group if="$(var c#)"><let name="v" value="$(var v)#"/></group>\n'
    node = '<node pkg="systems" exec="relay.py" name="$(var v)"/>\n'
    return of_xml('<let name="v" value=""/>\n', numbered(form, size), node)


def loops_of_nodes(size: int) -> Bomb:
    return of_python(
        f'n = [Node(package="systems", executable="relay.py", name=str(i) + str(j))\n'
        f'     for i in range({100 * size}) for j in range({100 * size})]\n'
        'return LaunchDescription(n)'
    )


def lists_of_actions_that_double(size: int) -> Bomb:
    return of_python(
        'n = [Node(package="systems", executable="relay.py")]\n'
        + 'n = [GroupAction(n), GroupAction(n)]\n' * size
        + 'return LaunchDescription(n)'
    )


def functions_that_return_themselves(size: int) -> Bomb:
    calls = ', '.join(['OpaqueFunction(function=f)'] * (size % 3 + 1))
    return of_python(f'def f(context):\n    return [{calls}]\nreturn LaunchDescription([{calls}])')


def handlers_of_each_other(size: int) -> Bomb:
    return of_python(
        'a = []\n'
        f'for i in range({10 * size}):\n'
        '    a.append(RegisterEventHandler(OnProcessExit(on_exit=a)))\n'
        'return LaunchDescription(a)'
    )


def substitutions_that_double(size: int) -> Bomb:
    return of_python(
        's = LaunchConfiguration("x", default="y")\n'
        + 's = PythonExpression([s, "+", s])\n' * size
        + 'return LaunchDescription([Node(package="systems", executable="relay.py", name=[s, s])])'
    )


def variables_of_cmake(size: int) -> Bomb:
    sets = 'set(A programs/relay.py)\n' + 'set(A ${A} ${A})\n' * size
    texts = 'set(B xy)\n' + 'set(B "z${B}${B}")\n' * size
    install = 'install(PROGRAMS ${A} ${B} DESTINATION lib/systems)\n'
    return of_xml(NODE, CMakeLists__txt=f'project(systems)\n{sets}{texts}{install}')


def brackets_of_cmake(size: int) -> Bomb:
    text = 'set(' * 20_000 * size + '\n' + '"' * 20_000 * size + '\n' + '#' * 20_000 * size
    return of_xml(NODE, CMakeLists__txt=text)


def entry_points_that_double(size: int) -> Bomb:
    text = (
        'from setuptools import setup\n'
        "x = ['relay.py = systems.relay:main']\n"
        + 'x = x + x\n' * size
        + "setup(entry_points={'console_scripts': x})\n"
    )
    return of_xml(NODE, setup__py=text, CMakeLists__txt='')


def faults_of_setup_cfg(size: int) -> Bomb:
    line = ('console_scints]\n', '  a = b.c:d\n', '[x]\n', 'a\n')[size % 4]
    text = '[options.entry_points]\nconsole_scripts =\n' + line * (15_000 * size // len(line))
    return of_xml(numbered(NODE, 20), setup__cfg=text, CMakeLists__txt='')


def programs_without_number(size: int) -> Bomb:
    names = numbered('"p#" = "systems.relay:main"\n', 400 * size)
    text = f'[project.scripts]\n{names}'
    return of_xml(numbered(NODE, 20), pyproject__toml=text, CMakeLists__txt='')


def long_names(size: int) -> Bomb:
    push = f'<push-ros-namespace namespace="{"x" * 8_000 * size}"/>\n'
    return of_xml(push, numbered(NODE, 50 * size))


def many_settings(size: int) -> Bomb:
    return of_xml(numbered('<let name="a#" value="1"/>\n', 400 * size), NODE)


BOMBS: tuple[Callable[[int], Bomb], ...] = (
    includes_of_itself,
    includes_that_double,
    texts_that_double,
    groups_within_groups,
    nodes_without_number,
    ring_of_processes,
    many_remaps,
    parameters_without_number,
    aliases_that_double,
    merges_that_double,
    deep_flow,
    expressions,
    substitutions_within,
    conditions_that_double,
    loops_of_nodes,
    lists_of_actions_that_double,
    functions_that_return_themselves,
    handlers_of_each_other,
    substitutions_that_double,
    variables_of_cmake,
    brackets_of_cmake,
    entry_points_that_double,
    faults_of_setup_cfg,
    programs_without_number,
    long_names,
    many_settings,
)


def launch_bomb(chance: random.Random) -> Bomb:
    """One of them, of any size."""
    return chance.choice(BOMBS)(chance.randint(1, LARGEST))
