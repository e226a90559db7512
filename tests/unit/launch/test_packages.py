"""Which file an executable of a package runs."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from ros2cc_extract.extract.launch.workspace.packages import Executable, Packages
from ros2cc_extract.files import DISK
from ros2cc_extract.source_locations import Place, Unknown
from tests.unit.launch.following import package


def packages(home: Path) -> Packages:
    return Packages(DISK, home / 'launch' / 'a.launch.py')


@pytest.mark.parametrize(
    ('file', 'text'),
    [
        (
            'setup.py',
            'from setuptools import setup\n'
            "setup(entry_points={'console_scripts': ['talk = robot.talker:main']})",
        ),
        (
            'setup.py',
            "from setuptools import setup\np = 'robot'\n"
            "setup(entry_points={'console_scripts': ['talk = ' + p + '.talker:main']})",
        ),
        ('setup.cfg', '[options.entry_points]\nconsole_scripts =\n    talk = robot.talker:main\n'),
        ('pyproject.toml', '[project.scripts]\ntalk = "robot.talker:main"\n'),
    ],
)
def test_a_console_script_is_a_function(file: str, text: str, tmp_path: Path) -> None:
    home = package(tmp_path)
    (home / file).write_text(text)
    (home / 'robot').mkdir()
    talker = home / 'robot' / 'talker.py'
    talker.write_text('def main(): ...')
    assert packages(home).executable('robot', 'talk') == Executable(talker, 'main')
    assert packages(home).executable('robot', 'other') is None
    assert packages(home).executable('elsewhere', 'talk') is None


@pytest.mark.parametrize(
    'text',
    [
        'install(PROGRAMS scripts/talk.py DESTINATION lib/${PROJECT_NAME})',
        'install(PROGRAMS # both\n scripts/talk.py DESTINATION lib/robot)',
        'set(ALL scripts/talk.py)\ninstall(PROGRAMS ${ALL} DESTINATION lib/${PROJECT_NAME})',
        'install(DIRECTORY scripts/ DESTINATION lib/${PROJECT_NAME})',
    ],
)
def test_an_installed_program_is_a_script(text: str, tmp_path: Path) -> None:
    home = package(tmp_path)
    (home / 'CMakeLists.txt').write_text(text)
    (home / 'scripts').mkdir()
    script = home / 'scripts' / 'talk.py'
    script.write_text('')
    assert packages(home).executable('robot', 'talk.py') == Executable(script)


def test_a_program_may_be_renamed_and_a_built_one_is_no_python(tmp_path: Path) -> None:
    home = package(tmp_path)
    (home / 'CMakeLists.txt').write_text(
        'install(PROGRAMS talk.py RENAME talk DESTINATION lib/robot)\nadd_executable(fast f.cpp)'
    )
    (home / 'talk.py').write_text('')
    assert packages(home).executable('robot', 'talk') == Executable(home / 'talk.py')
    assert packages(home).executable('robot', 'fast') == Executable(None)


@pytest.mark.parametrize(
    'text',
    [
        'set(program fast)\nadd_executable(${program} f.cpp)',
        'project(fast VERSION 1.0)\nadd_executable(${PROJECT_NAME} f.cpp)',
        'add_library(part SHARED f.cpp)\n'
        'rclcpp_components_register_node(part PLUGIN "robot::Fast" EXECUTABLE fast)',
    ],
)
def test_what_is_built_under_a_name_of_a_variable_or_for_a_component(
    text: str, tmp_path: Path
) -> None:
    home = package(tmp_path)
    (home / 'CMakeLists.txt').write_text(text)
    assert packages(home).executable('robot', 'fast') == Executable(None)
    assert packages(home).executable('robot', 'part') is None


def test_an_installed_package_has_its_programs_in_lib(tmp_path: Path) -> None:
    home = package(tmp_path / 'share')
    program = tmp_path / 'lib' / 'robot' / 'talk'
    program.parent.mkdir(parents=True)
    program.write_text('#!/usr/bin/python3\n')
    assert packages(home).executable('robot', 'talk') == Executable(program)


def test_what_of_a_setup_file_is_not_known_is_told(tmp_path: Path) -> None:
    home = package(tmp_path)
    (home / 'setup.py').write_text(
        'from setuptools import setup\nimport mine\n'
        "setup(entry_points={'console_scripts': mine.scripts})"
    )
    place = Place(str(home / 'setup.py'), 3, 1)
    why = 'console scripts: mine.scripts is not followed'
    assert packages(home).unread('robot') == (Unknown(why, place),)
    assert packages(home).unread('elsewhere') == ()


def test_variables_that_double_are_put_in_up_to_a_bound(tmp_path: Path) -> None:
    """Of 2 to the 60 words there would be no end; what comes before them is still read."""
    home = package(tmp_path)
    doubled = 'set(A ${A} ${A})\nset(B "${B}${B}")\n' * 60
    (home / 'CMakeLists.txt').write_text(
        'install(PROGRAMS talk.py DESTINATION lib/robot)\nset(A a.py)\nset(B b)\n'
        f'{doubled}install(PROGRAMS ${{A}} ${{B}} DESTINATION lib/robot)\n'
        'set(C late.py)\ninstall(PROGRAMS ${C} DESTINATION lib/robot)\n'
    )
    for name in ('talk.py', 'late.py'):
        (home / name).write_text('')
    assert packages(home).executable('robot', 'talk.py') == Executable(home / 'talk.py')
    assert packages(home).executable('robot', 'late.py') is None


def test_a_word_without_an_end_is_looked_at_once(tmp_path: Path) -> None:
    home = package(tmp_path)
    begun = time.process_time()
    (home / 'CMakeLists.txt').write_text('a' * 900_000 + '\n' + 'set(' * 20_000)
    assert packages(home).executable('robot', 'talk.py') is None
    assert time.process_time() - begun < 5
