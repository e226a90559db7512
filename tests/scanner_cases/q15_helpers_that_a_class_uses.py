"""Point 15: helpers of the module whose one caller is a class that no known program makes."""
# live: no, the launcher is not installed

import launcher
from rclpy.node import Node
from std_srvs.srv import Trigger


class Switch:
    def __init__(self, name):
        self.name = name

    def flip(self, request, response):
        return response

    def offer(self, owner, group):
        owner.create_service(Trigger, self.name, self.flip, callback_group=group)


SWITCHES = [Switch('lamp'), Switch('fan')]


class House(Node):
    def __init__(self):
        super().__init__('house')
        for switch in SWITCHES:
            switch.offer(self, None)


def main():
    launcher.run(House)


if __name__ == '__main__':
    main()

# expect:
# unit house: no executor
#   group house_default EXCLUSIVE default
#   service lamp_flip in house_default (Switch.flip) key=lamp
#   service fan_flip in house_default (Switch.flip) key=fan
#   ? executor executor
