"""
Hostile launch files, what a workspace holds beside them, and specifications of systems.

As in ``hostile``: what is valid is damaged, and what a stranger would bring in is mixed with it.
"""

from __future__ import annotations

import io
import json
import random
import shutil
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import yaml

from ros2cc_extract.cli.main import main
from tests.attack.arena import Attempt
from tests.attack.launch_bombs import launch_bomb
from tests.attack.mutations import damaged, reshaped, with_words
from tests.attack.words import (
    OF_CMAKE,
    OF_LAUNCH,
    OF_LAUNCH_PYTHON,
    OF_PYTHON,
    OF_TOML,
    OF_XML,
    OF_YAML,
    RUNS,
)
from tests.unit.launch.following import HEAD
from tests.unit.launch.test_frontends import XML, YAML

SYSTEMS = Path(__file__).parents[1] / 'systems'
LAUNCH = SYSTEMS / 'launch'
KEPT = ('package.xml', 'CMakeLists.txt', 'launch', 'config', 'programs')
WORDS = {
    '.xml': (*OF_XML, *OF_LAUNCH),
    '.yaml': (*OF_YAML, *OF_LAUNCH),
    '.py': (*OF_PYTHON, *OF_LAUNCH, *OF_LAUNCH_PYTHON),
}
PYTHON = f"""\
{HEAD}
    ns = LaunchConfiguration('ns')
    share = get_package_share_directory('systems')
    nodes = [Node(package='systems', executable=e, namespace=ns) for e in ('sink.py', 'asker.py')]
    def more(context):
        return [Node(package='systems', executable='relay.py', name=ns.perform(context))]
    return LaunchDescription([
        DeclareLaunchArgument('ns', default_value='x'),
        GroupAction([PushRosNamespace(ns), SetRemap('s', 't'), *nodes], condition=IfCondition(ns)),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(os.path.join(share, 'launch', 'names_good.launch.py')),
            launch_arguments={{'ns': ['y', ns]}}.items()),
        OpaqueFunction(function=more),
        RegisterEventHandler(OnProcessExit(target_action=nodes[0], on_exit=[nodes[1]])),
        ExecuteProcess(cmd=['python3', PathJoinSubstitution([share, 'programs', 'boss.py'])]),
        Node(package='systems', executable='keeper.py',
             parameters=[os.path.join(share, 'config', 'first.yaml'), {{'a': {{'b': 2.0}}}}],
             remappings=[('x', PythonExpression(["'/' + '", ns, "'"]))])])
"""
FORMATS = ('yaml', 'json', 'html', 'mermaid', 'dot')
SEARCH = ('--no-cache', '--timeout', '2')


@cache
def launch_texts(suffix: str) -> tuple[str, ...]:
    own = {'.xml': XML, '.yaml': YAML, '.py': PYTHON}[suffix]
    return (own, *(path.read_text() for path in sorted(LAUNCH.glob(f'*{suffix}'))))


def workspace(**changed: bytes) -> Callable[[Path], None]:
    """The package of ``tests/systems`` with files of others; names as in ``hostile.writing``."""

    def prepare(folder: Path) -> None:
        for name in KEPT:
            source = SYSTEMS / name
            if source.is_dir():
                shutil.copytree(source, folder / name)
            else:
                shutil.copy(source, folder / name)
        for name, content in changed.items():
            path = folder / name.replace('___', '/').replace('__', '.')
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)

    return prepare


def evil(text: str, words: Sequence[str], chance: random.Random, canary: Path) -> bytes:
    """As ``hostile.text_of``."""
    if chance.random() < 0.25:
        return damaged(text.encode(), chance)
    drawn = with_words(text, words, chance).replace('CANARY', str(canary))
    return drawn.encode('utf-8', 'surrogatepass')


def asking(file: str, chance: random.Random) -> tuple[str, ...]:
    """What reads a launch file."""
    form = chance.choice(FORMATS)
    arguments = chance.choice(((), (), ('ns:=robot',), ('ns:=$(var ns)',), ('ns:=\x1b[2J\n',)))
    return chance.choice(
        (
            ('system', file, *arguments, '--output-format', form),
            ('system', file, *arguments, '--strict', '--no-cache'),
            ('system', '.', '--output-format', form),
            ('check', file, *arguments, *SEARCH),
            ('diff', file, 'launch/names_good.launch.py', *arguments),
        )
    )


def launch_files(suffix: str) -> Callable[[random.Random, Path], Attempt]:
    def draw(chance: random.Random, canary: Path) -> Attempt:
        text = evil(chance.choice(launch_texts(suffix)), WORDS[suffix], chance, canary)
        if suffix == '.py' and chance.random() < 0.7:
            text = f'{chance.choice(RUNS)}\n'.replace('CANARY', str(canary)).encode() + text
        name = f'evil.launch{suffix}'
        files = workspace(**{f'launch___{name.replace(".", "__")}': text})
        return Attempt(asking(f'launch/{name}', chance), files)

    return draw


def launch_bombs(chance: random.Random, canary: Path) -> Attempt:
    name, text, others = launch_bomb(chance)
    files = {f'launch___{name.replace(".", "__")}': text, **others}
    prepare = workspace(**{key: content.encode() for key, content in files.items()})
    return Attempt(asking(f'launch/{name}', chance), prepare)


SETUP = """\
from setuptools import setup
NAME = 'systems'
setup(name=NAME, entry_points={'console_scripts': [f'relay.py = {NAME}.relay:main']})
"""
OF_PACKAGE = {
    'package__xml': ((SYSTEMS / 'package.xml').read_text(), (*OF_XML, *OF_LAUNCH)),
    'CMakeLists__txt': ((SYSTEMS / 'CMakeLists.txt').read_text(), OF_CMAKE),
    'setup__py': (SETUP, OF_PYTHON),
    'setup__cfg': (
        '[options.entry_points]\nconsole_scripts =\n    relay.py = systems.relay:main\n',
        (*OF_TOML, '%(x)s', '[DEFAULT]', '    = =', '[options.entry_points]'),
    ),
    'pyproject__toml': ('[project.scripts]\n"relay.py" = "systems.relay:main"\n', OF_TOML),
    'config___first__yaml': (
        (SYSTEMS / 'config/first.yaml').read_text(),
        (*OF_YAML, '/**/**/**:', '/*:', 'ros__parameters:', '"/**": {ros__parameters: {}}'),
    ),
}
"""What is read beside a launch file: its text, and words that mean something there."""


def workspaces(chance: random.Random, canary: Path) -> Attempt:
    files = {}
    for name in chance.sample(sorted(OF_PACKAGE), chance.randint(1, 3)):
        files[name] = evil(*OF_PACKAGE[name], chance, canary)
    if files.keys() & {'setup__py', 'setup__cfg', 'pyproject__toml'}:
        files.setdefault('CMakeLists__txt', b'')
    launch = chance.choice(('relays_bad.launch.xml', 'names_good.launch.py'))
    return Attempt(asking(f'launch/{launch}', chance), workspace(**files))


@cache
def system_specifications() -> tuple[str, ...]:
    """As ``system`` writes them."""
    found = []
    for name in ('relays_good.launch.yaml', 'settings_bad.launch.py', 'goal_waits_bad.launch.py'):
        out = io.StringIO()
        main(['system', '--no-cache', str(LAUNCH / name)], out, io.StringIO())
        found.append(out.getvalue())
    return tuple(found)


def system_specs(chance: random.Random, canary: Path) -> Attempt:
    good = chance.choice(system_specifications())
    if chance.random() < 0.6:
        tree = reshaped(yaml.safe_load(good), chance)
        written = yaml.safe_dump(tree).encode(errors='replace')
    else:
        written = evil(good, OF_YAML, chance, canary)
    arguments = chance.choice(
        (
            ('system', 'evil.yaml', '--output-format', chance.choice(FORMATS)),
            ('system', 'good.yaml', 'evil.yaml'),
            ('system', 'evil.yaml', 'good.yaml', '--output-format', chance.choice(FORMATS)),
            ('diff', 'good.yaml', 'evil.yaml'),
            ('diff', 'evil.yaml', 'good.yaml', '--output-format', 'mermaid'),
            ('diff', 'evil.yaml', 'good.yaml', '--output-format', 'json'),
            ('check', 'evil.yaml', *SEARCH),
        )
    )

    def prepare(folder: Path) -> None:
        (folder / 'good.yaml').write_text(good)
        (folder / 'evil.yaml').write_bytes(written)

    return Attempt(arguments, prepare)


def json_systems(chance: random.Random, canary: Path) -> Attempt:
    """The same as JSON, which is YAML too."""
    tree = reshaped(yaml.safe_load(chance.choice(system_specifications())), chance)
    text = json.dumps(tree)
    return Attempt(
        ('system', 'evil.yaml', '--output-format', chance.choice(FORMATS)),
        lambda folder: (folder / 'evil.yaml').write_text(text, errors='replace') and None,
    )
