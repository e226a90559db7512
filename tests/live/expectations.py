"""What the executors of the examples hold, written by hand from their sources."""

from __future__ import annotations

from held import Group, Held, group, held, member


def _paper_group(node: str, type_: str, *, default: bool = False) -> Group:
    return group(
        type_,
        member(node, 'timer', 'on_timer_a', 1.0),
        member(node, 'timer', 'on_timer_b', 1.0),
        member(node, 'subscription', 'on_msg_c', 'msg_C'),
        member(node, 'subscription', 'on_msg_d', 'msg_D'),
        default=default,
    )


EXPECTED: dict[str, Held] = {
    'paper_publisher': held(
        'SingleThreadedExecutor',
        1,
        group(
            'EXCLUSIVE',
            member('paper_publisher', 'timer', 'publish_c', 1.0),
            member('paper_publisher', 'timer', 'publish_d', 2.0),
            default=True,
        ),
    ),
    'paper_case1': held(
        'SingleThreadedExecutor', 1, _paper_group('paper_case1', 'EXCLUSIVE', default=True)
    ),
    'paper_case2': held('MultiThreadedExecutor', 4, _paper_group('paper_case2', 'EXCLUSIVE')),
    'paper_case3': held('MultiThreadedExecutor', 4, _paper_group('paper_case3', 'REENTRANT')),
    'default_group_only': held(
        'SingleThreadedExecutor',
        1,
        group(
            'EXCLUSIVE',
            member('battery_watch', 'subscription', 'on_battery', 'battery_state'),
            member('battery_watch', 'timer', 'report', 0.5),
            member('battery_watch', 'service', 'on_clear_alarm', 'clear_alarm'),
            default=True,
        ),
    ),
    'two_groups': held(
        'MultiThreadedExecutor',
        2,
        group(
            'EXCLUSIVE',
            member('obstacle_stop', 'subscription', 'on_scan', 'scan'),
            member('obstacle_stop', 'timer', 'drive', 0.05),
        ),
        group('EXCLUSIVE', member('obstacle_stop', 'timer', 'plan', 0.5)),
    ),
    'two_nodes_one_executor': held(
        'MultiThreadedExecutor',
        2,
        group('EXCLUSIVE', member('wheel_encoder', 'timer', 'on_timer', 0.02), default=True),
        group(
            'EXCLUSIVE',
            member('odometry', 'subscription', 'on_position', 'wheel_position'),
            member('odometry', 'timer', 'on_timer', 0.5),
            default=True,
        ),
    ),
    'service_and_client': held(
        'SingleThreadedExecutor',
        1,
        group(
            'EXCLUSIVE', member('gripper', 'service', 'on_close', 'gripper/close'), default=True
        ),
        group(
            'EXCLUSIVE',
            member('sorter', 'client', None, 'gripper/close'),
            member('sorter', 'timer', 'toggle', 0.2),
            default=True,
        ),
    ),
    'action_server': held(
        'MultiThreadedExecutor',
        2,
        # The probe cannot see its name: an action server of rclpy 7.1 does not keep it.
        group('REENTRANT', member('fibonacci_server', 'action_server', 'on_goal', 'fibonacci')),
        group('EXCLUSIVE', member('fibonacci_server', 'timer', 'report', 1.0), default=True),
    ),
    'group_through_helper': held(
        'MultiThreadedExecutor',
        4,
        group(
            'REENTRANT',
            member('supervisor', 'subscription', 'on_beat', 'base/heartbeat'),
            member('supervisor', 'timer', 'check', 1.0),
        ),
        group(
            'EXCLUSIVE',
            member('supervisor', 'subscription', 'on_beat', 'arm/heartbeat'),
            member('supervisor', 'timer', 'check', 1.0),
            default=True,
        ),
    ),
    'lambda_in_loop': held(
        'MultiThreadedExecutor',
        4,
        *(
            group(
                'EXCLUSIVE',
                member('fleet_status', 'subscription', '<lambda>', f'{robot}/status'),
            )
            for robot in ('alpha', 'beta', 'gamma')
        ),
        group('EXCLUSIVE', member('fleet_status', 'timer', 'summarise', 1.0), default=True),
    ),
    'service_deadlock': held(
        'MultiThreadedExecutor',
        4,
        group(
            'EXCLUSIVE', member('map_server', 'service', 'on_map_ready', 'map_ready'), default=True
        ),
        group(
            'EXCLUSIVE',
            member('navigator', 'client', None, 'map_ready'),
            member('navigator', 'timer', 'drive', 0.5),
            default=True,
        ),
    ),
    'pool_exhaustion': held(
        'MultiThreadedExecutor',
        2,
        group('EXCLUSIVE', member('planner', 'service', 'on_plan', 'plan'), default=True),
        group('EXCLUSIVE', member('two_arms', 'client', None, 'plan')),
        group('EXCLUSIVE', member('two_arms', 'client', None, 'plan')),
        group('EXCLUSIVE', member('two_arms', 'timer', 'move_left', 0.5)),
        group('EXCLUSIVE', member('two_arms', 'timer', 'move_right', 0.5)),
    ),
    # The node is taken out of the MultiThreadedExecutor by rclpy.spin.
    'executor_never_spun': held(
        'SingleThreadedExecutor',
        1,
        group(
            'REENTRANT',
            member('camera_upload', 'subscription', 'on_header', 'image_header'),
            member('camera_upload', 'timer', 'upload', 1.0),
        ),
    ),
}
