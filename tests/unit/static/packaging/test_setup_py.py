"""Programs of a ``setup.py`` whose entry points are put together."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.packaging.declarations import Declarations, Program, Script
from ros2cc_extract.extract.static.packaging.setup_py import of_setup_py
from ros2cc_extract.source_locations import Place, Unknown

HEAD = """\
import os
from glob import glob
from setuptools import find_packages, setup
name = 'robot'
"""
TALK = ('talk', 'robot.talker', 'main')
HEAR = ('hear', 'robot.hearer', 'main')


def of_setup(text: str) -> Declarations:
    return of_setup_py(HEAD + text, 'robot/setup.py')


def scripts(text: str) -> list[tuple[str, str, str]]:
    found = of_setup(text)
    assert found.unread == ()
    return [(each.name, each.module, each.function) for each in found.scripts]


def with_list(items: str) -> str:
    return f"setup(name=name, entry_points={{'console_scripts': {items}}})"


@pytest.mark.parametrize(
    'items',
    [
        "['talk = robot.talker:main']",
        "('talk=robot.talker:main',)",
        "'talk = robot.talker:main'",
        "['talk = ' + name + '.talker:main']",
        "['talk = ' + name + '.talker:main' + ' ']",
        "[f'talk = {name}.talker:main']",
        "['talk = {}.talker:main'.format(name)]",
        "['talk = {package}.talker:main'.format(package=name)]",
        "['talk = %s.talker:main' % name]",
        "['%(what)s = %(where)s.talker:main' % {'what': 'talk', 'where': name}]",
        "[' = '.join(('talk', name + '.talker:main'))]",
        "['talk = robot.talker:main [extra]']",
    ],
)
def test_an_entry_that_is_put_together_is_read(items: str) -> None:
    assert scripts(with_list(items)) == [TALK]


@pytest.mark.parametrize(
    ('before', 'items'),
    [
        ("both = ['talk', 'hear']", "[f'{n} = robot.{n}er:main' for n in both]"),
        ("both = ['talk', 'hear']", "[*(f'{n} = robot.{n}er:main' for n in both)]"),
        ("one = ['talk = robot.talker:main']", "one + ['hear = robot.hearer:main']"),
        ("one = ['talk = robot.talker:main']", "[*one, 'hear = robot.hearer:main']"),
        ("l = []\nfor n in 'talk', 'hear':\n    l.append(f'{n} = robot.{n}er:main')", 'l'),
        ("def e(n):\n    return f'{n} = {name}.{n}er:main'", "[e('talk'), e('hear')]"),
        ("e = lambda n: f'{n} = {name}.{n}er:main'", "list(map(e, ['talk', 'hear']))"),
        ("l = ['talk = robot.talker:main']\nl += ['hear = robot.hearer:main']", 'l'),
    ],
)
def test_a_list_that_is_made_is_read(before: str, items: str) -> None:
    assert scripts(f'{before}\n{with_list(items)}') == [TALK, HEAR]


@pytest.mark.parametrize(
    'text',
    [
        "given = dict(entry_points={'console_scripts': ['talk = robot.talker:main']})\n"
        'setup(**given)',
        "given = {}\ngiven['entry_points'] = {'console_scripts': ['talk = robot.talker:main']}\n"
        'setup(**given)',
        "setup(entry_points='[console_scripts]\\ntalk = robot.talker:main\\n')",
        "def go():\n    setup(entry_points={'console_scripts': ['talk = robot.talker:main']})\n"
        "if __name__ == '__main__':\n    go()",
        "import setuptools\nsetuptools.setup(entry_points={'console_scripts':"
        " ['talk = robot.talker:main']})",
        "from distutils.core import setup\nsetup(entry_points={'console_scripts':"
        " ['talk = robot.talker:main']})",
        "setup(version=open('v').read(), packages=find_packages(), data_files=[('share/robot',"
        " glob('launch/*'))], entry_points={'console_scripts': ['talk = robot.talker:main'],"
        " 'launch.frontend': ['x = robot.y:z']})",
    ],
)
def test_setup_is_found_however_it_is_called(text: str) -> None:
    assert scripts(text) == [TALK]


def test_a_branch_gives_both_of_its_ways() -> None:
    items = "['talk = robot.talker:main'] if os.environ else ['hear = robot.hearer:main']"
    assert sorted(scripts(with_list(items))) == [HEAR, TALK]


def test_files_that_become_programs() -> None:
    text = (
        "setup(scripts=['bin/' + name], data_files=[('share/robot', ['package.xml']),"
        " (os.path.join('lib', name), ['scripts/tool.py'])])"
    )
    place = Place('robot/setup.py', 5, 1)
    programs = (Program('bin/robot', place), Program('scripts/tool.py', place))
    assert of_setup(text) == Declarations(programs=programs)
    assert [each.name for each in programs] == ['robot', 'tool.py']


def test_what_is_not_known_is_named_with_its_place_and_the_rest_is_read() -> None:
    found = of_setup(
        with_list("[\n'hear = ' + os.environ['P'] + ':main',\n'talk = robot.talker:main']")
    )
    assert found.scripts == (Script(*TALK, Place('robot/setup.py', 5, 1)),)
    why = 'an entry point: an expression that could not be folded'
    assert found.unread == (Unknown(why, Place('robot/setup.py', 6, 1)),)


@pytest.mark.parametrize(
    ('text', 'why', 'line'),
    [
        ('setup(entry_points=load())', "entry points: name 'load' is not defined here", 5),
        (
            'from mine import scripts\n' + with_list('scripts'),
            'console scripts: mine.scripts is not followed',
            6,
        ),
        (with_list("['talk']"), "entry point 'talk' is not of the form name = module:function", 5),
        (
            with_list("['talk = robot']"),
            "'robot' of program 'talk' is not module:function",
            5,
        ),
        ('print(entry_points)', 'no call of setup is found', 0),
        ('setup(entry_points=', "syntax error: '(' was never closed", 0),
        ("setup(entry_points='nothing here')", None, 5),
    ],
)
def test_why_something_could_not_be_read(text: str, why: str | None, line: int) -> None:
    (unread,) = of_setup(text).unread
    assert unread.at is not None
    assert (unread.at.file, unread.at.line) == ('robot/setup.py', line)
    assert why is None or unread.reason == why


def test_a_file_that_never_ends_is_left() -> None:
    found = of_setup('n = 0\nwhile True:\n    n += 1\nx = [i for i in range(10**9)]\nscripts = x')
    assert found.scripts == ()
    assert len(found.unread) == 1


def test_nothing_of_it_is_run(tmp_path: Path) -> None:
    mark = tmp_path / 'ran'
    written = f"open({str(mark)!r}, 'w').write('x')\n"
    assert scripts(written + with_list("['talk = robot.talker:main']")) == [TALK]
    assert not mark.exists()


def test_a_module_that_happens_to_be_called_so_declares_nothing() -> None:
    assert of_setup('def setup(): ...') == Declarations()
