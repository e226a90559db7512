"""Charts for reviews, as Mermaid reads them."""

from __future__ import annotations

from pathlib import Path

from tests.e2e.conftest import Run

BEFORE = """\
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Grip(Node):
    def __init__(self):
        super().__init__('grip')
        self.safe = self.create_client(Trigger, 'safe')
        self.create_timer(0.1, self.ask)

    def ask(self):
        self.safe.call(Trigger.Request())

rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Grip())
executor.spin()
"""
AFTER = BEFORE.replace(
    "'safe')", "'safe', callback_group=rclpy.callback_groups.ReentrantCallbackGroup())"
)


def test_a_diff_draws_both_sides_with_what_changed_marked(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'before.py').write_text(BEFORE)
    (tmp_path / 'after.py').write_text(AFTER)
    outcome = run('diff', 'before.py', 'after.py', '--output-format', 'mermaid')
    assert outcome.status == 1
    assert (
        outcome.out
        == """\
flowchart LR
    subgraph side_0["before"]
        s0u0_executor(["MultiThreadedExecutor, 2 threads (before.py:16), spin"])
        subgraph s0u0_grip_default["grip_default: mutually exclusive"]
            s0u0_ask["Grip.ask<br/>timer every 0.1 s"]
            s0u0_safe_client["client 'safe'"]
        end
        s0u0_executor --> s0u0_grip_default
        s0u0_ask -. "client.call" .-> s0u0_safe_client
    end
    subgraph side_1["after"]
        s1u0_executor(["MultiThreadedExecutor, 2 threads (after.py:16), spin"])
        subgraph s1u0_safe_client_group["safe_client_group: reentrant"]
            s1u0_safe_client["client 'safe'"]
        end
        s1u0_executor --> s1u0_safe_client_group
        subgraph s1u0_grip_default["grip_default: mutually exclusive"]
            s1u0_ask["Grip.ask<br/>timer every 0.1 s"]
        end
        s1u0_executor --> s1u0_grip_default
        s1u0_ask -. "client.call" .-> s1u0_safe_client
    end
    side_0 ~~~ side_1
    style s0u0_safe_client stroke:#c62828,stroke-width:3px
    style s1u0_safe_client_group stroke-dasharray: 5 5
    style s1u0_safe_client stroke:#c62828,stroke-width:3px
"""
    )


def test_two_programs_are_one_chart(run: Run, tmp_path: Path) -> None:
    for name in ('one.py', 'two.py'):
        (tmp_path / name).write_text(BEFORE)
    outcome = run('.', '--output-format', 'mermaid')
    assert outcome.out.count('flowchart LR\n') == 1
    assert outcome.out.count('subgraph side_') == 2
