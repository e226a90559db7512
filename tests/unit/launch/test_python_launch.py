"""Python launch files: what they start, as the interpreter follows them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.unit.launch.following import followed, lines, package


@pytest.mark.parametrize(
    ('body', 'expected'),
    [
        (
            "return LaunchDescription([Node(package='p', executable='e', name='n')])",
            ['node p e name=n'],
        ),
        (
            'ld = LaunchDescription()\n'
            '    for i in range(2):\n'
            "        ld.add_action(Node(package='p', executable='e', namespace=['r', str(i)]))\n"
            '    return ld',
            ['node p e ns=/r0', 'node p e ns=/r1'],
        ),
        (
            "nodes = [Node(package='p', executable=e) for e in ('a', 'b')]\n"
            '    return LaunchDescription(nodes)',
            ['node p a', 'node p b'],
        ),
        (
            'return LaunchDescription([\n'
            "        DeclareLaunchArgument('ns', default_value='x'),\n"
            "        GroupAction([PushRosNamespace(LaunchConfiguration('ns')),\n"
            "            PushRosNamespace('y'), SetRemap('a', 'b'),\n"
            "            Node(package='p', executable='e', namespace='z',\n"
            "                remappings=[('c', 'd')]),\n"
            "            Node(package='p', executable='e', namespace='/top')]),\n"
            "        Node(package='p', executable='f')])",
            ['node p e ns=/x/y/z a:=b c:=d', 'node p e ns=/top a:=b', 'node p f'],
        ),
        (
            "return LaunchDescription([Node(package='p', executable='e',\n"
            "        parameters=[{'rate': 2, 'nested': {'deep': True}, 'list': [1, 2]}],\n"
            "        arguments=['--ros-args', '-r', 'q:=r', '-p', 's:=4'])])",
            ['node p e q:=r s=4 rate=2 nested.deep=True list=(1, 2)'],
        ),
        (
            "flag = LaunchConfiguration('flag')\n"
            "    return LaunchDescription([DeclareLaunchArgument('flag', default_value='false'),\n"
            "        Node(package='p', executable='on', condition=IfCondition(flag)),\n"
            "        Node(package='p', executable='off', condition=UnlessCondition(flag)),\n"
            "        Node(package='p', executable='is', condition=IfCondition(PythonExpression([\n"
            '            "\'", flag, "\' == \'false\'"])))])',
            ['node p off', 'node p is'],
        ),
        (
            'return LaunchDescription([\n'
            "        Node(package='p', executable='e', condition=IfCondition(\n"
            "            EnvironmentVariable('REAL'))),\n"
            "        Node(package=EnvironmentVariable('PKG'), executable='e')])",
            ['node p e perhaps', 'node reason?'],
        ),
        (
            "perhaps = IfCondition(EnvironmentVariable('REAL'))\n"
            "    on = LaunchConfiguration('on')\n"
            '    return LaunchDescription([\n'
            "        GroupAction([SetLaunchConfiguration('on', 'true'), PushRosNamespace('x'),\n"
            "            SetRemap('a', 'b'), Node(package='p', executable='in'),\n"
            "            Node(package='p', executable='never', condition=UnlessCondition(on)),\n"
            '        ], condition=perhaps, scoped=False),\n'
            "        Node(package='p', executable='behind', name=on)])",
            ['node p in ns=/x a:=b perhaps', 'node p behind name=true ns=?'],
        ),
        (
            "perhaps = IfCondition(EnvironmentVariable('REAL'))\n"
            "    both = [LaunchConfiguration('one'), LaunchConfiguration('two')]\n"
            '    return LaunchDescription([\n'
            "        DeclareLaunchArgument('one', default_value='a', condition=perhaps),\n"
            "        DeclareLaunchArgument('one', default_value='a'),\n"
            "        Node(package='p', executable='e', name=LaunchConfiguration('one')),\n"
            "        SetLaunchConfiguration('two', 'b', condition=perhaps),\n"
            "        DeclareLaunchArgument('two', default_value='c'),\n"
            "        Node(package='p', executable='e', name=both)])",
            ['node p e name=a', 'node p e name=?'],
        ),
        (
            "one = DeclareLaunchArgument('one', default_value='a')\n"
            "    node = Node(package='p', executable='e', name=LaunchConfiguration('one'))\n"
            "    if os.environ.get('REAL'):\n"
            '        return LaunchDescription([one, node])\n'
            '    return LaunchDescription([one, node])',
            ['node p e name=a perhaps', 'node p e name=a perhaps'],
        ),
        (
            "perhaps = IfCondition(EnvironmentVariable('REAL'))\n"
            '    return LaunchDescription([\n'
            "        SetLaunchConfiguration('one', 'a'),\n"
            "        UnsetLaunchConfiguration('one', condition=perhaps),\n"
            "        DeclareLaunchArgument('one', default_value='b'),\n"
            "        Node(package='p', executable='e', name=LaunchConfiguration('one'))])",
            ['node p e name=?'],
        ),
        (
            'def more(context, suffix):\n'
            "        name = LaunchConfiguration('robot').perform(context) + suffix\n"
            "        count = int(context.launch_configurations['count'])\n"
            "        return [Node(package='p', executable='e', name=name + str(i))\n"
            '            for i in range(count)]\n'
            "    return LaunchDescription([DeclareLaunchArgument('robot', default_value='bot'),\n"
            "        DeclareLaunchArgument('count', default_value='2'),\n"
            "        OpaqueFunction(function=more, args=['_'])])",
            ['node p e name=bot_0', 'node p e name=bot_1'],
        ),
        (
            'def more(context, ld):\n'
            "        who = LaunchConfiguration('who').perform(context)\n"
            "        ld.add_action(Node(package='p', executable=who))\n"
            '        ld.add_action(OpaqueFunction(function=lambda context: ld.add_action(\n'
            "            Node(package='p', executable='last'))))\n"
            "    ld = LaunchDescription([DeclareLaunchArgument('who', default_value='bot')])\n"
            '    ld.add_action(OpaqueFunction(function=more, args=[ld]))\n'
            "    ld.add_action(Node(package='p', executable='first'))\n"
            '    return ld',
            ['node p first', 'node p bot', 'node p last'],
        ),
        (
            'def more(context):\n'
            "        if os.environ.get('SIM'):\n"
            "            ld.add_action(Node(package='p', executable='sim'))\n"
            '    ld = LaunchDescription([OpaqueFunction(function=more)])\n'
            '    return ld',
            ['node p sim perhaps'],
        ),
        (
            'def more(context):\n'
            '        who = perform_substitutions(context,\n'
            "            normalize_to_list_of_substitutions(LaunchConfiguration('who')))\n"
            "        both = perform_substitutions(context, ['/', LaunchConfiguration('who')])\n"
            "        return [Node(package='p', executable=who, remappings=[('a', both + '/b')])]\n"
            "    return LaunchDescription([DeclareLaunchArgument('who', default_value='left'),\n"
            '        OpaqueFunction(function=more)])',
            ['node p left a:=/left/b'],
        ),
        (
            "first = Node(package='p', executable='e')\n"
            '    return LaunchDescription([first, TimerAction(period=2.0, actions=[\n'
            "            Node(package='p', executable='late')]),\n"
            '        RegisterEventHandler(OnProcessExit(target_action=first, on_exit=[\n'
            "            Node(package='p', executable='next')]))])",
            ['node p e', 'node p late after timer', 'node p next after end of a process'],
        ),
        (
            "return LaunchDescription([ComposableNodeContainer(name='c', namespace='',\n"
            "        package='rclcpp_components', executable='component_container',\n"
            "        composable_node_descriptions=[ComposableNode(package='p', plugin='p::T',\n"
            "            name='t', remappings=[('a', 'b')])]),\n"
            "        ExecuteProcess(cmd=['python3', os.path.join('/x', 'y.py')])])",
            [
                'container rclcpp_components component_container name=c',
                'composable p p::T name=t a:=b',
                'process python3 /x/y.py',
            ],
        ),
        (
            'ld = LaunchDescription()\n'
            "    if os.environ.get('SIM'):\n"
            "        ld.add_action(Node(package='p', executable='sim'))\n"
            "    ld.add_action(Node(package='p', executable='e'))\n"
            '    return ld',
            ['node p sim perhaps', 'node p e'],
        ),
    ],
)
def test_what_a_launch_file_starts(body: str, expected: list[str], tmp_path: Path) -> None:
    found = lines(followed(tmp_path, f'    {body}\n'))
    wanted = [line.replace('node reason?', 'node') for line in expected]
    assert [line.split(' environment')[0] for line in found] == wanted


def test_arguments_of_the_command_line_come_before_defaults(tmp_path: Path) -> None:
    body = (
        "    return LaunchDescription([DeclareLaunchArgument('who', default_value='a'),\n"
        "        Node(package='p', executable='e', name=LaunchConfiguration('who'))])\n"
    )
    assert lines(followed(tmp_path, body, who='b')) == ['node p e name=b']


def test_an_included_file_gets_its_arguments_and_leaves_them_behind(tmp_path: Path) -> None:
    home = package(tmp_path)
    (home / 'launch' / 'inner.launch.xml').write_text(
        '<launch><arg name="who" default="x"/><node pkg="p" exec="in" name="$(var who)"/></launch>'
    )
    body = (
        "    share = get_package_share_directory('robot')\n"
        '    return LaunchDescription([IncludeLaunchDescription(\n'
        '        PythonLaunchDescriptionSource(PathJoinSubstitution([\n'
        "            FindPackageShare('robot'), 'launch', 'inner.launch.xml'])),\n"
        "        launch_arguments={'who': 'y'}.items()),\n"
        "        Node(package='p', executable='out', name=LaunchConfiguration('who'))])\n"
    )
    found = followed(tmp_path, body)
    assert lines(found) == ['node p in name=y', 'node p out name=y']
    assert found.files == ('robot/launch/a.launch.py', 'robot/launch/inner.launch.xml')


def test_what_cannot_be_followed_is_named(tmp_path: Path) -> None:
    body = (
        "    return LaunchDescription([DeclareLaunchArgument('needed'),\n"
        '        IncludeLaunchDescription(PythonLaunchDescriptionSource(os.path.join(\n'
        "            get_package_share_directory('elsewhere'), 'x.launch.py'))),\n"
        "        Node(package='p', executable='e', name=LaunchConfiguration('needed'))])\n"
    )
    found = followed(tmp_path, body)
    assert lines(found) == ['node p e name=?']
    assert [each.message for each in found.noticed] == [
        "launch argument 'needed' has no default: give needed:=VALUE",
        'not followed: included launch file: package elsewhere is not found '
        '(robot/launch/a.launch.py:18:13)',
    ]


def test_a_launch_file_is_never_run(tmp_path: Path) -> None:
    mark = tmp_path / 'it_was_run'
    body = f"    open({str(mark)!r}, 'w').close()\n    return LaunchDescription([])\n"
    assert lines(followed(tmp_path, body)) == []
    assert not mark.exists()


def test_parameter_files_name_their_nodes(tmp_path: Path) -> None:
    config = package(tmp_path) / 'config.yaml'
    config.write_text(
        '/**:\n  ros__parameters: {rate: 3}\nleft:\n  arm:\n    ros__parameters: {a: {b: "1"}}\n'
    )
    body = (
        "    return LaunchDescription([Node(package='p', executable='e', parameters=[\n"
        "        os.path.join(get_package_share_directory('robot'), 'config.yaml')])])\n"
    )
    (process,) = followed(tmp_path, body).processes
    assert [(p.name, p.value, p.node) for p in process.parameters] == [
        ('rate', 3, '/**'),
        ('a.b', '1', '/left/arm'),
    ]
