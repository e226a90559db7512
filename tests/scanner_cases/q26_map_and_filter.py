"""Point 26: what ``map`` and ``filter`` call is called, over known lists and over unknown ones."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

TOPICS = ['scan', 'odom', '']


class Relay:
    def __init__(self, node, topic):
        node.create_subscription(String, topic, self.on_msg, 10)

    def on_msg(self, msg):
        pass


class Every:
    def __init__(self, node, seconds, topic):
        self.topic = topic
        self.timer = node.create_timer(seconds, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    node = Node('relays')
    kept = list(map(lambda topic: Relay(node, topic), filter(None, TOPICS)))
    kept += map(Every, [node, node], [0.5, 1.0], ['a', 'b'])
    names = node.get_topic_names_and_types()
    kept += [*map(lambda name: Relay(node, f'relayed{name[0]}'), names)]
    rclpy.spin(node)
    return kept


if __name__ == '__main__':
    main()

# expect:
# unit relays: SingleThreadedExecutor x1 rclpy.spin, main
#   group relays_default EXCLUSIVE default
#   timer tick in relays_default every 0.5
#   timer tick_2 in relays_default (Every.tick) every 1
#   subscription scan_on_msg in relays_default (Relay.on_msg) key=scan
#   subscription odom_on_msg in relays_default (Relay.on_msg) key=odom
#   subscription on_msg in relays_default key=? count=?
#   ? on_msg topic
#   ? on_msg count
