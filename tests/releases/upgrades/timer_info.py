"""A control loop that asks how late it is."""

import rclpy
from rclpy.node import Node
from rclpy.timer import TimerInfo


class Control(Node):
    def __init__(self):
        super().__init__('control')
        self.create_timer(0.2, self.step)

    # differs: timer-info
    def step(self, info: TimerInfo):
        late = info.actual_call_time - info.expected_call_time
        print('late' if late.nanoseconds > 10**9 else 'in time', flush=True)


def main():
    rclpy.init()
    rclpy.spin(Control())


if __name__ == '__main__':
    main()
