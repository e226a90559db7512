"""What the paths of ``system`` may name, and how several of them are joined."""

from __future__ import annotations

import io
import json
import shutil
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

from ros2cc_extract.cli.main import main
from ros2cc_extract.errors import SpecFormatError
from ros2cc_extract.spec.system.system_reading import read_systems
from ros2cc_extract.spec.system.system_yaml import write_system
from tests.unit.live.recordings import data, executor, node, stay, timer

HERE = Path(__file__).parent
LAUNCH = HERE / 'launch'
CALLS_BACK = LAUNCH / 'calls_back_bad.launch.py'


def told(*words: str) -> tuple[int, str, str]:
    out, err = io.StringIO(), io.StringIO()
    return main(['system', '--no-cache', *words], out, err), out.getvalue(), err.getvalue()


def systems_of(*words: str) -> list[dict[str, Any]]:
    status, out, err = told(*words)
    assert status == 0, err
    return [each['system'] for each in yaml.safe_load_all(out)]


def entity(number: int, kind: str, key: str, **facts: Any) -> dict[str, Any]:
    row = timer(number, 2, 3, 'Arm.on_it', kind=kind, key=key, period_s=None)
    return {**row, 'resolved_key': f'/{key}', **facts}


QOS = {
    'reliability': 'reliable',
    'durability': 'volatile',
    'deadline_s': None,
    'liveliness': 'automatic',
    'lease_s': None,
}
GROUP = {
    'number': 3,
    'class': 'MutuallyExclusiveCallbackGroup',
    'kind': 'exclusive',
    'node': 2,
    'default': True,
    'rate': False,
    'created': None,
}


def record(folder: Path, **facts: Any) -> Path:
    """A recording of an arm that subscribes, and publishes."""
    folder.mkdir(exist_ok=True)
    publisher = {'key': 'state', 'resolved_key': '/state', 'type': 'std_msgs/msg/Bool', 'qos': QOS}
    row = {**node(2, 'arm', stay(1, 0, None)), 'publishers': [publisher]}
    found = data(
        executors=[executor(1)],
        nodes=[{**row, **facts}],
        groups=[GROUP],
        entities=[entity(4, 'subscription', 'goal', type='std_msgs/msg/String', qos=QOS)],
    )
    (folder / '7-1.json').write_text(json.dumps(found), encoding='utf-8')
    return folder


CODE = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool, String


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_subscription(String, 'goal', self.on_goal, 10)
        self.states = self.create_publisher(Bool, 'state', 10)

    def on_goal(self, message):
        pass


def main():
    rclpy.init()
    rclpy.spin(Arm())


if __name__ == '__main__':
    main()
"""


def workspace(folder: Path, code: str = CODE) -> Path:
    """A package with a program, and no launch file."""
    home = folder / 'robot'
    home.mkdir(parents=True)
    (home / 'package.xml').write_text('<package><name>robot</name></package>')
    (home / 'setup.py').write_text(
        'from setuptools import setup\n'
        "setup(entry_points={'console_scripts': ['arm_node = robot.arm:main']})"
    )
    (home / 'robot').mkdir()
    (home / 'robot' / '__init__.py').touch()
    (home / 'robot' / 'arm.py').write_text(code)
    return home


def launched(home: Path, name: str, text: str) -> Path:
    (home / 'launch').mkdir(exist_ok=True)
    path = home / 'launch' / name
    path.write_text(f'<launch>{text}</launch>')
    return path


ARM = '<node pkg="robot" exec="arm_node"/>'


@pytest.mark.parametrize('path', sorted(LAUNCH.iterdir()), ids=lambda path: path.name)
def test_what_is_written_is_read_as_it_was(path: Path) -> None:
    out = told(str(path))[1]
    (found,) = read_systems(out, 'a.yaml')
    assert write_system(found) == out


@pytest.mark.parametrize(
    ('change', 'what'),
    [
        (
            ('version: 1', 'version: 7'),
            'a.yaml:3:12: version is not 1; write it again by `system`',
        ),
        (('kind: client', 'kind: clerk'), "is 'clerk'; write one of publisher, "),
        (('\n    - service:', '\n    - serve:'), "unknown key 'serve' in 'system.connections[0]'"),
        (('system:', 'sistem:'), "unknown key 'sistem'"),
    ],
)
def test_what_is_no_system_is_refused_at_its_line(change: tuple[str, str], what: str) -> None:
    text = told(str(CALLS_BACK))[1].replace(*change, 1)
    with pytest.raises(SpecFormatError) as caught:
        read_systems(text, 'a.yaml')
    assert what in str(caught.value)


def test_a_folder_gives_a_system_for_each_launch_file(tmp_path: Path) -> None:
    home = workspace(tmp_path)
    launched(home, 'a.launch.xml', ARM)
    launched(home, 'b.launch.xml', f'<group><push-ros-namespace namespace="left"/>{ARM}</group>')
    found = systems_of(str(tmp_path))
    assert [each['name'] for each in found] == ['a.launch.xml', 'b.launch.xml']
    names = [node['name'] for each in found for p in each['processes'] for node in p['nodes']]
    assert names == ['/arm', '/left/arm']
    status, out, _ = told(str(tmp_path), '--output-format', 'dot')
    assert (status, out.count('digraph')) == (0, 1)
    assert [name for name in ('"a.launch.xml"', '"b.launch.xml"') if name in out] == [
        '"a.launch.xml"',
        '"b.launch.xml"',
    ]
    listed = json.loads(told(str(tmp_path), '--output-format', 'json')[1])
    assert [each['system'] for each in listed] == found


def test_without_launch_files_each_program_is_a_process(tmp_path: Path) -> None:
    home = workspace(tmp_path)
    shutil.copy(home / 'robot' / 'arm.py', home / 'robot' / 'leg.py')
    (system,) = systems_of(str(home))
    assert [(p['name'], p['kind'], p['nodes'][0]['name']) for p in system['processes']] == [
        ('arm', 'entry', '/arm'),
        ('leg', 'entry', '/arm'),
    ]
    jsonschema.validate({'system': system}, json.loads(told('--schema')[1]))


def test_recordings_are_a_system_under_the_names_that_were_there(tmp_path: Path) -> None:
    (system,) = systems_of(str(record(tmp_path / 'live')))
    jsonschema.validate({'system': system}, json.loads(told('--schema')[1]))
    (process,) = system['processes']
    assert (process['kind'], process['name']) == ('recorded', 'arm')
    ends = [(c['topic'], e['kind'], e['type']) for c in system['connections'] for e in c['ends']]
    assert ends == [
        ('/goal', 'subscription', 'std_msgs/msg/String'),
        ('/state', 'publisher', 'std_msgs/msg/Bool'),
    ]


def test_a_folder_of_recordings_without_nodes_is_refused(tmp_path: Path) -> None:
    (tmp_path / '7-1.json').write_text(json.dumps(data()), encoding='utf-8')
    status, _, err = told(str(tmp_path))
    assert status == 2
    assert f'{tmp_path}: no recorded process holds a node' in err


def test_what_one_side_has_and_another_has_not_is_told_and_all_is_joined(tmp_path: Path) -> None:
    home = workspace(tmp_path)
    path = launched(home, 'a.launch.xml', ARM + '<node pkg="other" exec="lidar" name="lidar"/>')
    live = record(tmp_path / 'live')
    rows = json.loads((live / '7-1.json').read_text())
    rows['nodes'].append({**node(9, 'stray', stay(1, 0, None)), 'publishers': []})
    rows['entities'].append(entity(5, 'service', 'stop', type='std_srvs/srv/Trigger'))
    (live / '7-1.json').write_text(json.dumps(rows))
    status, out, err = told(str(path), str(live))
    assert status == 0
    (system,) = (each['system'] for each in yaml.safe_load_all(out))
    nodes = {p['name']: [n['name'] for n in p['nodes']] for p in system['processes']}
    assert nodes == {'arm_node': ['/arm', '/stray'], 'lidar': []}
    services = [each['service'] for each in system['connections'] if 'service' in each]
    assert services == ['/stop']
    assert err.splitlines()[-3:] == [
        f'arm.py:12:9: warning: /arm: service /stop is in {live} and not in {path}',
        f'{live}/7-1.json: warning: node /stray is in {live} and not in {path}',
        f'{path}:1:44: note: node /lidar is in {path} and not in {live}',
    ]


def test_a_specification_is_read_in_place_of_a_launch_file(tmp_path: Path) -> None:
    kept = tmp_path / 'kept.yaml'
    kept.write_text(told(str(CALLS_BACK))[1])
    assert told(str(kept))[1] == kept.read_text()
    other = tmp_path / 'other.yaml'
    other.write_text('a: 1\n')
    assert told(str(other)) == (
        2,
        '',
        f'ros2cc-extract: error: {other}: is no system specification; a system specification is '
        'what `system` writes\n',
    )


def test_nothing_named_says_what_may_be() -> None:
    assert told() == (
        2,
        '',
        'ros2cc-extract: error: no path given; name a launch file or a folder, or look at what '
        'runs by --running\n',
    )
