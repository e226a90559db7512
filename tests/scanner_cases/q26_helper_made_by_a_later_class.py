"""Point 26: a helper class and a function that a later class of the file uses; no entry."""
# live: no, there is no program

from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


def add_status(node, topic):
    node.create_subscription(String, topic, print, 10)


class Robot:
    def __init__(self, node, name):
        self.stop = node.create_client(Trigger, f'{name}/stop')


class Door:
    def __init__(self, node, name):
        self.open = node.create_client(Trigger, f'{name}/open')


class Fleet(Node):
    def __init__(self):
        super().__init__('fleet')
        self.robots = [Robot(self, 'one'), Robot(self, 'two')]
        add_status(self, 'status')

    def later(self):
        self.door = Door(self, 'gate')

# expect:
# unit fleet: no executor
#   group fleet_default EXCLUSIVE default
#   subscription print in fleet_default key=status
#   client one_stop_client in fleet_default key=one/stop
#   client two_stop_client in fleet_default key=two/stop
#   client gate_open_client in fleet_default key=gate/open conditional when=later
#   ? executor executor
