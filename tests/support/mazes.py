"""Programs that take long to be followed, though they are short."""

from __future__ import annotations

from pathlib import Path

DEPTH = 17
_HEAD = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Maze(Node):
    def __init__(self):
        super().__init__('maze')
        self.out = self.create_publisher(String, 'out', 10)
        self.create_timer(1.0, self.go_0)
"""
_STEP = """
    def go_{n}(self):
        self.out.publish(String(data='{n}'))
        self.go_{next}()
        self.go_{next}()
"""
_TAIL = """
    def go_{n}(self):
        self.out.publish(String(data='{n}'))


def main():
    rclpy.init()
    rclpy.spin(Maze())


if __name__ == '__main__':
    main()
"""


def maze() -> str:
    """A node whose timer calls two methods, each of which calls two more, and so on."""
    steps = (_STEP.replace('{n}', str(n)).replace('{next}', str(n + 1)) for n in range(DEPTH))
    return ''.join((_HEAD, *steps, _TAIL.replace('{n}', str(DEPTH))))


def write_mazes(folder: Path, number: int, *, remarks: int = 0) -> None:
    """Write so many programs, each with so many lines of remarks."""
    folder.mkdir(parents=True, exist_ok=True)
    for n in range(number):
        text = maze().replace("'maze'", f"'maze_{n}'") + '# There is a way out.\n' * remarks
        (folder / f'maze_{n}.py').write_text(text, 'utf-8')
