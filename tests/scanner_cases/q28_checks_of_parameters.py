"""Point 28: a list that holds what fails a check is empty when nothing fails."""

import rclpy
from rclpy.node import Node


class Checked(Node):
    def __init__(self):
        super().__init__('checked')
        names = {
            'left': str(self.declare_parameter('left', 'l').value),
            'right': str(self.declare_parameter('right', 'r').value),
        }
        missing = [side for side, name in names.items() if not name]
        if missing:
            raise ValueError('no name')
        self.create_timer(1.0, self.tick)
        wrong = {side: name for side, name in names.items() if name.isspace()}
        assert not wrong
        if wrong:
            return
        self.create_timer(2.0, self.tock)

    def tick(self):
        pass

    def tock(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(Checked())


if __name__ == '__main__':
    main()

# expect:
# unit checked: SingleThreadedExecutor x1 rclpy.spin, main
#   group checked_default EXCLUSIVE default
#   timer tick in checked_default every 1
#   timer tock in checked_default every 2 conditional
