"""``upgrade`` names what changes between two releases; ``--distro`` judges for one."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.commands import upgrade
from ros2cc_extract.cli.main import main
from ros2cc_extract.pipeline import unit_examination
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.unit import verify_unit
from tests.support.knots import knot

RELEASES = Path(__file__).parents[1] / 'releases'
NODE = """\
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.client = self.create_client(Trigger, 'go')
        self.create_timer(1.0, self.on_timer)
        self.create_timer(1.0, self.on_call)

    def on_timer(self):
        rclpy.spin_once(self)

    def on_call(self):
        self.client.call(Trigger.Request(), timeout_sec=1.0)
        rclpy.shutdown()


rclpy.init()
rclpy.spin(Arm())
"""


@pytest.fixture
def node(tmp_path: Path) -> str:
    path = tmp_path / 'arm.py'
    path.write_text(NODE)
    return str(path)


def run(*arguments: str) -> tuple[int, str, str]:
    out, err = StringIO(), StringIO()
    return main(arguments, out, err), out.getvalue(), err.getvalue()


def upgraded(node: str, old: str, new: str) -> tuple[int, list[str]]:
    status, out, _ = run('upgrade', '--from', old, '--to', new, node)
    lines = [line.replace(node, 'arm.py') for line in out.splitlines()]
    return status, [': '.join(line.split(': ')[:2]) for line in lines]


def test_upgrade_over_distributions_names_each_change_with_its_switch(node: str) -> None:
    assert upgraded(node, 'humble', 'lyrical') == (
        1,
        [
            'arm.py:14:9: CC106 changes',
            '    because of spin-refused-twice: ros2/rclpy pull request 1510, `executors.py` '
            '(`spin`, `spin_once`)',
            'arm.py:17:9: behaves otherwise',
            '    because of call-takes-timeout: `client.py` (`Client.call`) of 3.3.21 and 7.1.11',
            'arm.py:18:9: CC118 goes',
            '    because of shutdown-waits-not: ros2/rclpy issue 944, `executors.py` '
            '(`Executor.shutdown`)',
            'from rclpy 3.3.22 to 10.0.10: 3 changes',
        ],
    )


def test_upgrade_within_a_distribution(node: str) -> None:
    status, lines = upgraded(node, '7.1.6', '7.1.9')
    assert status == 1
    assert [line for line in lines if not line.startswith(' ')] == [
        'arm.py:14:9: CC106 changes',
        'from rclpy 7.1.6 to 7.1.9: 1 change',
    ]


def test_upgrade_that_changes_nothing(node: str) -> None:
    assert upgraded(node, '7.1.9', 'jazzy') == (0, ['from rclpy 7.1.9 to 7.1.11: no change'])


@pytest.fixture
def knotted(node: str, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A node that is not decided in time."""
    monkeypatch.setattr(upgrade, 'SECONDS', 0.3)
    path = Path(node).with_name('knot.py')
    path.write_text(knot(6), encoding='utf-8')
    return path


def test_what_is_decided_on_neither_is_told(knotted: Path) -> None:
    """That nothing changes in it is not known: the turn of its task depends on the release."""
    call = 'self.client0.call(Trigger.Request())'
    text = knotted.read_text(encoding='utf-8')
    knotted.write_text(text.replace(call, f'self.executor.create_task(print); {call}'))
    status, out, _ = run('upgrade', '--from', '7.1.6', '--to', 'jazzy', str(knotted))
    assert (status, out.splitlines()) == (
        3,
        [
            'knot: not all of it is compared, because a limit was reached',
            'from rclpy 7.1.6 to 7.1.11: no change',
        ],
    )


def test_one_model_of_two_releases_is_asked_once(
    knotted: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What changes in it is known, though not all of it is decided."""
    asked = []

    def ask(closed: ClosedSpec, *arguments: object) -> Verification:
        asked.append(closed.spec.rclpy)
        return verify_unit(closed, *arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(unit_examination, 'verify_unit', ask)
    status, out, _ = run('upgrade', '--from', '7.1.9', '--to', 'jazzy', str(knotted))
    assert (status, out) == (0, 'from rclpy 7.1.9 to 7.1.11: no change\n')
    assert asked == ['7.1.9']


def test_release_that_nobody_has_looked_at_is_told(node: str) -> None:
    told = 'rclpy 7.1.12 is judged as 7.1.11, the newest known\n'
    assert run('upgrade', '--from', 'jazzy', '--to', '7.1.12', node)[2] == told
    assert run(node, '--rclpy', '7.1.12')[2] == told


def test_a_file_that_cannot_be_read_is_no_file_without_changes(node: str) -> None:
    broken = Path(node).with_name('broken.py')
    broken.write_text('import rclpy; f(:\n')
    status, out, err = run('upgrade', '--from', '7.1.9', '--to', 'jazzy', str(broken))
    assert (status, out, 'broken.py:1:' in err) == (2, '', True)
    status, out, err = run('upgrade', '--from', '7.1.9', '--to', 'jazzy', str(broken.parent))
    assert (status, 'broken.py:1:' in err) == (3, True)
    assert out == 'from rclpy 7.1.9 to 7.1.11: no change\n'


def test_no_release(node: str) -> None:
    assert run('upgrade', '--from', 'foxy', '--to', 'jazzy', node)[0] == 2


@pytest.mark.parametrize(
    ('distro', 'told', 'found'),
    [
        ('humble', 'callbacks of other groups run inside this one, members of', ['CC118']),
        ('jazzy', 'from rclpy 7.1.9 on the executor refuses to be spun twice', []),
        ('rolling', 'inside a callback: it raises RuntimeError, because that executor', []),
    ],
)
def test_distro_says_which_consequence_holds(
    node: str, distro: str, told: str, found: list[str]
) -> None:
    _, out, _ = run(node, '--distro', distro)
    assert told in out
    assert [code for code in ('CC118',) if f' {code}: ' in out] == found


OTHER_THREAD = """\
import threading

import rclpy
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Empty


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_subscription(Empty, 'go', self.on_go, 10)

    async def on_go(self, message):
        future = Future()
        threading.Thread(target=future.set_result, args=(None,), daemon=True).start()
        await future


rclpy.init()
rclpy.spin(Arm())
"""
WOKEN_BY_NOBODY = ' (on Humble before 3.3.21, Jazzy before 7.1.9, Kilted before 9.1.4)\n'


def test_without_a_release_all_supported_ones_are_judged(tmp_path: Path) -> None:
    (tmp_path / 'arm.py').write_text(OTHER_THREAD)
    path = str(tmp_path / 'arm.py')
    _, of_all, _ = run(path, '--no-cache')
    assert ('CC120' in of_all, of_all.count(WOKEN_BY_NOBODY)) == (True, 1)
    assert '? no deadlock' in of_all
    _, of_old, _ = run(path, '--no-cache', '--rclpy', '7.1.6')
    assert ('CC120' in of_old, WOKEN_BY_NOBODY in of_old) == (True, False)
    _, of_new, _ = run(path, '--no-cache', '--rclpy', '7.1.11')
    assert ('CC120' in of_new, '✓ no deadlock  ✓ every wait ends' in of_new) == (False, True)


TASK_IN_A_POOL = """\
import rclpy
from rclpy.executors import {executor}
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.move)

    async def move(self):
        await self.executor.create_task(self.plan)

    def plan(self):
        self.planned = True


rclpy.init()
executor = {executor}()
executor.add_node(Arm())
executor.spin()
"""


@pytest.mark.parametrize(
    ('executor', 'release', 'is_open'),
    [
        ('MultiThreadedExecutor', '9.1.2', True),
        ('MultiThreadedExecutor', '9.1.5', False),
        ('SingleThreadedExecutor', '9.1.2', False),
    ],
)
def test_a_task_of_a_pool_wakes_no_executor_on_old_releases(
    tmp_path: Path, executor: str, release: str, is_open: bool
) -> None:
    (tmp_path / 'arm.py').write_text(TASK_IN_A_POOL.format(executor=executor))
    _, out, _ = run(str(tmp_path / 'arm.py'), '--no-cache', '--rclpy', release)
    assert ('the end of a task wakes no executor' in out) is is_open
    assert ('✓ every wait ends' in out) is not is_open


DONE_CALLBACK_IN_A_POOL = """\
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        answers = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'plan', callback_group=answers)
        self.create_timer(0.1, self.move)

    async def move(self):
        self.planned = Future()
        self.client.call_async(Trigger.Request()).add_done_callback(self.done)
        await self.planned

    def done(self, answer):
        self.planned.set_result(answer)


rclpy.init()
executor = MultiThreadedExecutor()
executor.add_node(Arm())
executor.spin()
"""


@pytest.mark.parametrize(('release', 'mark'), [('7.1.6', '?'), ('7.1.11', '✓')])
def test_a_done_callback_in_a_pool_wakes_no_executor_on_old_releases(
    tmp_path: Path, release: str, mark: str
) -> None:
    """Measured: with a service that answers it stood in 4 of 4 runs on 7.1.6 and 9.1.2."""
    (tmp_path / 'arm.py').write_text(DONE_CALLBACK_IN_A_POOL)
    _, out, _ = run(str(tmp_path / 'arm.py'), '--no-cache', '--rclpy', release)
    assert f'{mark} every wait ends' in out


def test_what_only_new_releases_do_is_found_without_a_release(tmp_path: Path) -> None:
    (tmp_path / 'arm.py').write_text(NODE)
    _, cold, _ = run(str(tmp_path / 'arm.py'))
    _, cached, _ = run(str(tmp_path / 'arm.py'))
    assert cold == cached
    assert 'and from rclpy 7.1.9 on the executor refuses to be spun twice' in cold


def test_verify_has_a_table_for_each_group_of_releases(node: str) -> None:
    _, out, _ = run('verify', node, '--profile', 'rclpy')
    models = [line for line in out.splitlines() if line.startswith('model ')]
    assert models == ['model arm@9.1.2', 'model arm@11.0.0']
    text = ' '.join(out.split())  # a line may be broken
    assert 'rclpy is that of Humble, Jazzy before 7.1.9, Kilted before 9.1.5' in text
    assert 'rclpy is that of Jazzy from 7.1.9 on, Kilted from 9.1.5 on, Lyrical, Rolling' in text


def test_verify_of_one_release_has_one_table(node: str) -> None:
    _, out, _ = run('verify', node, '--profile', 'rclpy', '--rclpy', '7.1.6')
    assert [line for line in out.splitlines() if line.startswith('model ')] == ['model arm']


@pytest.mark.parametrize('release', ['12.0.0', '12.1.3-1noble'])
def test_release_beyond_the_table_is_told_by_every_command(
    node: str, release: str, tmp_path: Path
) -> None:
    told = f'rclpy {release.split("-")[0]} is judged as 11.0.1, the newest known'
    recorded = tmp_path / 'recorded.yaml'
    recorded.write_text(run('spec', node)[1].replace('rclpy: null', f'rclpy: {release}', 1))
    row = 'tasks_oldest_first'
    traced = (RELEASES / 'traces' / f'{row}_9.1.5.jsonl').read_text()
    trace = tmp_path / 'trace.jsonl'
    trace.write_text(traced.replace('"rclpy": "9.1.5"', f'"rclpy": "{release}"', 1))
    for command in (
        [node, '--rclpy', release],
        ['verify', node, '--rclpy', release],
        ['verify', str(recorded)],
        ['model', str(recorded), '-o', str(tmp_path / 'model')],
        ['conform', str(trace), str(RELEASES / 'rows' / f'{row}.py')],
    ):
        assert run(*command)[2].splitlines().count(told) == 1, command
