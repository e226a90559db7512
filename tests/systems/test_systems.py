"""
Each system says in its last lines what is found in it: code, file, and text of the line.

``tests/live/test_live_systems.py`` starts those with a circle of waits and their mended twins.
"""

from __future__ import annotations

import io
import re
import shlex
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

HERE = Path(__file__).parent
LAUNCH = HERE / 'launch'
FOUND = re.compile(r'^(\S+?):(\d+):\d+: (?:error|warning|note(?= CC704)) (CC\d+): ', re.MULTILINE)
MARK = re.compile(r'^(?:#|<!--)\s*(.*?)(?:\s*-->)?$')
NO_FINDING = ('nothing', 'observed: ')


def expected(path: Path) -> list[tuple[str, str, str]]:
    """Code, file and text of the line of each finding that the last lines of a file name."""
    lines = path.read_text(encoding='utf-8').splitlines()
    marked: list[str] = []
    while lines and (match := MARK.match(lines.pop())):
        marked.append(match.group(1))
    found = []
    for mark in reversed([mark for mark in marked if not mark.startswith(NO_FINDING)]):
        code, file, text = mark.split(maxsplit=2)
        found.append((code, file.removesuffix(':'), text))
    return found


def found_in(path: Path, *arguments: str, below: Path = HERE) -> list[tuple[str, str, str]]:
    out = io.StringIO()
    main(['check', '--no-cache', '-q', str(path), *arguments], out, io.StringIO())
    found = []
    for file, line, code in FOUND.findall(out.getvalue()):
        text = Path(file).read_text(encoding='utf-8').splitlines()[int(line) - 1]
        found.append((code, Path(file).resolve().relative_to(below).as_posix(), text))
    return found


@pytest.mark.parametrize('path', sorted(LAUNCH.iterdir()), ids=lambda path: path.name)
def test_a_system_has_the_findings_that_it_names(path: Path) -> None:
    found, wanted = found_in(path), expected(path)
    assert [each[:2] for each in found] == [each[:2] for each in wanted]
    assert all(want in has for (_, _, has), (_, _, want) in zip(found, wanted, strict=True))


@pytest.mark.parametrize(
    ('elsewhere', 'codes'), [('', []), ('namespace="robot"', ['CC701']), (None, ['CC701'])]
)
def test_who_is_not_in_sight_may_offer_what_is_wanted_in_its_namespace(
    elsewhere: str | None, codes: list[str], tmp_path: Path
) -> None:
    """Topics of sensors and what a program makes of them differ by the namespace only."""
    programs = shlex.quote(str(HERE / 'programs'))
    beside = '' if elsewhere is None else f'<node pkg="filters" exec="filter" {elsewhere}/>'
    path = tmp_path / 'all.launch.xml'
    path.write_text(
        f'<launch><executable cmd="python3 {programs}/asker.py"/>{beside}'
        f'<executable cmd="python3 {programs}/sink.py --ros-args -r request:=robot/plan"/>'
        '</launch>',
        encoding='utf-8',
    )
    out = io.StringIO()
    main(['check', '--no-cache', str(path)], out, io.StringIO())
    assert re.findall(r': (?:note|warning) (CC70\d): ', out.getvalue()) == codes


def test_who_is_started_by_a_file_that_is_not_in_sight_may_offer_anything(tmp_path: Path) -> None:
    """As a simulator, which publishes the time."""
    program = shlex.quote(str(HERE / 'programs' / 'camera.py'))
    camera = f'python3 {program} --ros-args -p use_sim_time:=true'
    path = tmp_path / 'all.launch.xml'
    text = (
        f'<launch><arg name="world"/>{{}}<executable cmd="{camera} -p frame_rate:=3.0"/></launch>'
    )
    include = '<include file="$(find-pkg-share gz_sim)/launch/gz.launch.py"/>'
    for beside, codes in (('', ['CC704']), (include, [])):
        path.write_text(text.format(beside), encoding='utf-8')
        out = io.StringIO()
        main(['check', '--no-cache', str(path)], out, io.StringIO())
        assert re.findall(r': (?:note|warning) (CC70\d): ', out.getvalue()) == codes


def test_an_argument_of_the_launch_file_decides() -> None:
    path = LAUNCH / 'calls_back_good.launch.py'
    codes = [code for code, _, _ in found_in(path, 'beside:=false')]
    assert codes == ['CC109']


@pytest.mark.parametrize(
    ('name', 'reason'),
    [
        (
            'rests_on_stuck_bad.launch.xml',
            'Relay.tick waits for service /first/request of stuck, of which that is not proven',
        ),
        (
            'rests_on_nobody_bad.launch.xml',
            'Relay.tick waits for service /first/request, which nobody offers',
        ),
        (
            'rests_on_luck_bad.launch.xml',
            'Hasty.tick waits for service /sink/request and has not waited until it is there: '
            'a request that comes too early is lost',
        ),
    ],
)
def test_a_promise_rests_on_those_of_the_neighbours(name: str, reason: str) -> None:
    out = io.StringIO()
    main(['check', '--no-cache', str(LAUNCH / name)], out, io.StringIO())
    assert f'  ? every wait ends: {reason}\n' in out.getvalue()


def test_neighbours_that_keep_theirs_let_it_be_kept() -> None:
    out = io.StringIO()
    main(['check', '--no-cache', str(LAUNCH / 'calls_back_good.launch.py')], out, io.StringIO())
    assert out.getvalue().count('\u2713 no deadlock  \u2713 every wait ends') == 2


@pytest.mark.parametrize(
    ('name', 'answer', 'other'),
    [
        ('goal_waits_bad.launch.py', 'result', 'goal'),
        ('goal_asks_bad.launch.xml', 'goal', 'result'),
    ],
)
def test_a_circle_goes_through_one_of_the_answers_of_an_action(
    name: str, answer: str, other: str
) -> None:
    """What accepts a goal, and what ends it, are two callbacks in groups of their own."""
    out = io.StringIO()
    main(['check', '--no-cache', str(LAUNCH / name)], out, io.StringIO())
    run = out.getvalue().partition('it can happen like this:')[2]
    assert f"waits on thread_0 for client '{answer} of /move'" in run
    assert f'{other} of /move' not in run


def test_a_goal_that_needs_another_one_of_its_action_is_left_undecided() -> None:
    out = io.StringIO()
    main(['check', '--no-cache', str(LAUNCH / 'goal_in_goal.launch.xml')], out, io.StringIO())
    assert 'the result of /move may need another goal of it' in out.getvalue()
