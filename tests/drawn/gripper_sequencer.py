# Gripper sequencer: a command on /gripper/cmd plays a short sequence of positions
# at a fixed rate on /gripper/position.
import logging

import rclpy
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float64, String

LOG = logging.getLogger('gripper')


class Sequence:
    """A named list of set points, played one per period."""

    def __init__(self, name, points):
        self.name = name
        self.points = list(points)

    def __iter__(self):
        return iter(self.points)

    def __len__(self):
        return len(self.points)


SEQUENCES = {
    'open': Sequence('open', [0.0, 0.02, 0.04, 0.06, 0.08]),
    'close': Sequence('close', [0.08, 0.05, 0.02, 0.0]),
}


class GripperSequencer(Node):

    def __init__(self):
        super().__init__('gripper_sequencer')
        self.declare_parameter('rate', 10.0)
        self._rate = self.create_rate(self.get_parameter('rate').value)
        self._position = self.create_publisher(Float64, '/gripper/position', 10)
        self._done = self.create_publisher(String, '/gripper/done', 10)
        self._played = 0
        self.create_subscription(String, '/gripper/cmd', self.on_command, 10)

    def on_command(self, msg):
        name = 'open' if self._played % 2 == 0 else 'close'
        sequence = SEQUENCES.get(msg.data, SEQUENCES[name])
        self.get_logger().info('playing %s (%d points)' % (sequence.name, len(sequence)))
        self.play(sequence)
        self._played += 1
        self._done.publish(String(data=sequence.name))
        self.get_logger().info('finished %s, %d played' % (sequence.name, self._played))

    def play(self, sequence):
        for point in sequence:
            self._position.publish(Float64(data=point))
            self._rate.sleep()


def main():
    logging.basicConfig(level=logging.INFO)
    rclpy.init()
    node = GripperSequencer()
    LOG.info('sequencer up')
    try:
        rclpy.spin(node, executor=MultiThreadedExecutor())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
