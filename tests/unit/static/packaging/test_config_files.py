"""Programs of ``setup.cfg`` and ``pyproject.toml``."""

from __future__ import annotations

import sys
import time

import pytest

from ros2cc_extract.extract.static.packaging.config_files import of_cfg, of_toml
from ros2cc_extract.extract.static.packaging.declarations import Declarations, Program, Script
from ros2cc_extract.source_locations import Place, Unknown

needs_toml = pytest.mark.skipif(sys.version_info < (3, 11), reason='no tomllib before 3.11')


def test_a_cfg_gives_entry_points_and_scripts() -> None:
    text = """\
[metadata]
name = robot
[options]
scripts =
    bin/tool
[options.entry_points]
console_scripts =
    # a remark
    talk = robot.talker:main
    Hear-2 = robot.hearer:Hearer.main [extra]
pytest11 =
    no = robot.plugin:none
"""
    assert of_cfg(text, 'setup.cfg') == Declarations(
        scripts=(
            Script('talk', 'robot.talker', 'main', Place('setup.cfg', 9)),
            Script('Hear-2', 'robot.hearer', 'Hearer.main', Place('setup.cfg', 10)),
        ),
        programs=(Program('bin/tool', Place('setup.cfg', 5)),),
    )


def test_a_broken_cfg_is_named() -> None:
    (why,) = of_cfg('console_scripts\n', 'setup.cfg').unread
    assert why.at == Place('setup.cfg')
    assert why.reason.startswith('it cannot be read: File contains no section headers')


@needs_toml
@pytest.mark.parametrize(
    'text',
    [
        '\n[project.scripts]\ntalk = "robot.talker:main"\n',
        '\n[project.gui-scripts]\n"talk" = "robot.talker:main"\n',
        '\n[project.entry-points.console_scripts]\ntalk = "robot.talker:main"\n',
        '\n[tool.poetry.scripts]\ntalk = "robot.talker:main"\n',
        '\n[tool.poetry.scripts]\ntalk = {callable = "robot.talker:main", extras = ["x"]}\n',
    ],
)
def test_a_toml_file_gives_its_scripts(text: str) -> None:
    script = Script('talk', 'robot.talker', 'main', Place('pyproject.toml', 3))
    assert of_toml(text, 'pyproject.toml') == Declarations(scripts=(script,))


@needs_toml
def test_script_files_of_a_toml_file() -> None:
    text = '[tool.setuptools]\nscript-files = ["bin/tool"]\n'
    programs = (Program('bin/tool', Place('pyproject.toml', 2)),)
    assert of_toml(text, 'pyproject.toml') == Declarations(programs=programs)


@needs_toml
@pytest.mark.parametrize(
    ('text', 'why'),
    [
        ('[project.scripts]\ntalk = 3\n', "target of program 'talk' is no text"),
        ('[project.scripts]\ntalk = "a"\n', "'a' of program 'talk' is not module:function"),
    ],
)
def test_what_is_no_entry_is_named(text: str, why: str) -> None:
    unread = (Unknown(why, Place('pyproject.toml', 2)),)
    assert of_toml(text, 'pyproject.toml') == Declarations(unread=unread)


@needs_toml
def test_a_broken_toml_file_is_named_where_it_may_declare_something() -> None:
    (why,) = of_toml('[project.scripts]\ntalk =\n', 'pyproject.toml').unread
    assert why.at == Place('pyproject.toml')
    assert of_toml('[tool.x\n', 'pyproject.toml') == Declarations()


@pytest.mark.parametrize('line', ['console_scints]\n', 'a = b.c:d\n', '[x]\n'])
def test_what_is_long_costs_little(line: str) -> None:
    begun = time.process_time()
    text = '[options.entry_points]\nconsole_scripts =\n' + line * (1_000_000 // len(line))
    (why,) = of_cfg(text, 'setup.cfg').unread
    assert why.reason == 'it cannot be read: it is longer than 100000 letters'
    head, indented = '[options.entry_points]\nconsole_scripts =\n', f'  {line}'
    of_cfg(head + indented * (99_000 // len(indented)), 'setup.cfg')
    assert time.process_time() - begun < 8


@needs_toml
def test_programs_without_number_have_their_lines_at_little_cost() -> None:
    begun = time.process_time()
    names = ''.join(f'"n{number}"="m:f"\n' for number in range(50_000))
    found = of_toml(f'[project.scripts]\n{names}', 'pyproject.toml')
    assert len(found.scripts) == 50_000
    assert found.scripts[-1].place == Place('pyproject.toml', 50_001)
    assert time.process_time() - begun < 8
