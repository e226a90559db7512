"""P26: what an unknown loop collected is met again, once each, never as one that is certain."""
# live: no, the number depends on the environment

import os

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        names, by_name, ready = ['base'], {}, set()
        for name in os.environ['ROBOTS'].split():
            if name != 'all':
                names.append(name)
            by_name[name] = self.on_dict
            ready.add(name)
        for name in names:
            self.create_subscription(String, name, self.on_list, 10)
        for name, callback in by_name.items():
            self.create_subscription(String, name, callback, 10)
        for index, name in enumerate(sorted(ready)):
            self.create_subscription(String, f'{name}_{index}', self.on_set, 10)
        for topic in [f'{name}/x' for name in names]:
            self.create_subscription(String, topic, self.on_comprehension, 10)

    def on_list(self, msg):
        pass

    def on_dict(self, msg):
        pass

    def on_set(self, msg):
        pass

    def on_comprehension(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription base_on_list in a_default (A.on_list) key=base
#   subscription on_list in a_default key=? conditional count=?
#   subscription on_dict in a_default key=? count=?
#   subscription on_set in a_default key=? count=?
#   subscription base_x_on_comprehension in a_default (A.on_comprehension) key=base/x
#   subscription on_comprehension in a_default key=? count=?
#   ? on_list topic
#   ? on_list count
#   ? on_dict topic
#   ? on_dict count
#   ? on_set topic
#   ? on_set count
#   ? on_comprehension topic
#   ? on_comprehension count
