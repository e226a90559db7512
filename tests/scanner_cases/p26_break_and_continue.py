"""P26: what a loop assigns before break or continue holds after it; its else may not run."""
# live: no, the nodes found depend on the network

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        kind = None
        for name in self.get_node_names():
            if name == 'x':
                kind = name
                break
        if kind is not None:
            self.create_subscription(String, 'kind', self.on_message, 10)
        found = False
        for name in self.get_node_names():
            if name == 'x':
                found = True
                break
        else:
            self.create_subscription(String, 'else', self.on_message, 10)
        if found:
            self.create_subscription(String, 'found', self.on_message, 10)
        skipped = False
        for name in self.get_node_names():
            if name == 'x':
                skipped = True
                continue
            self.create_subscription(String, 'in_loop', self.on_message, 10)
        if skipped:
            self.create_subscription(String, 'skipped', self.on_message, 10)
        waited = 0
        while rclpy.ok():
            if self.count_publishers('x'):
                waited = 1
                break
        if waited:
            self.create_subscription(String, 'waited', self.on_message, 10)
        for known in (1, 2, 3):
            if known == 2:
                break
        else:
            self.create_subscription(String, 'never', self.on_message, 10)
        if known == 2:
            self.create_subscription(String, 'certain', self.on_message, 10)

    def on_message(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription kind_on_message in a_default (A.on_message) key=kind conditional
#   subscription else__on_message in a_default (A.on_message) key=else conditional
#   subscription found_on_message in a_default (A.on_message) key=found conditional
#   subscription in_loop_on_message in a_default (A.on_message) key=in_loop conditional count=?
#   subscription skipped_on_message in a_default (A.on_message) key=skipped conditional
#   subscription waited_on_message in a_default (A.on_message) key=waited conditional
#   subscription certain_on_message in a_default (A.on_message) key=certain
#   ? in_loop_on_message count
