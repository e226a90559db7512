"""What runs now, as one side of a comparison."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from ros2cc_extract.cli.shared.arguments import number_of_seconds

if TYPE_CHECKING:
    from ros2cc_extract.pipeline.system_paths import Side

DEFAULT_SECONDS = 10.0


def add_running_arguments(parser: argparse.ArgumentParser) -> None:
    """Add that the running system is meant, and how it is looked at."""
    group = parser.add_argument_group('the running system')
    group.add_argument(
        '--running',
        action='store_true',
        help='what runs now in this ROS domain, by the graph: nodes of any language',
    )
    group.add_argument(
        '--seconds',
        type=number_of_seconds,
        default=DEFAULT_SECONDS,
        metavar='S',
        help='look for nodes for S seconds at most (default %(default)g)',
    )
    group.add_argument(
        '--python',
        metavar='PROGRAM',
        help='the interpreter that has rclpy (default: this one, else python3)',
    )


def running_sides(args: argparse.Namespace) -> tuple[Side, ...]:
    """
    What runs now, if it is asked for.

    :raises ToolNotFoundError: when no interpreter with rclpy is there.
    :raises InputError: when no node is found.
    """
    if not args.running:
        return ()
    from ros2cc_extract.cli.shared.on_node import interpreter_of
    from ros2cc_extract.extract.live.graph.running import running_system
    from ros2cc_extract.pipeline.system_paths import Side

    system = running_system(interpreter_of(args), args.seconds)
    return (Side(f'the running {system.name}', (system,)),)
