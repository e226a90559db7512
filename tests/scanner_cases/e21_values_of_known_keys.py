"""EffectLog: storing under a key of the set-up changes no size; under a new one it does."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import SetBool


class Gateway(Node):
    def __init__(self):
        super().__init__('gateway')
        self.states = {'lidar': False, 'arm': False}
        self.heard = {}
        for module in self.states.keys():
            self.create_service(
                SetBool, module, lambda request, answer, m=module: self.switch(request, answer, m)
            )
        self.create_subscription(String, 'in', self.on_msg, 10)

    def switch(self, request, answer, module):
        self.states[module] = request.data
        return answer

    def on_msg(self, msg):
        self.states[msg.data] = True
        self.heard['last'] = msg.data
        self.heard['last'] = msg.data.strip()


def main():
    rclpy.init()
    rclpy.spin(Gateway())

# expect:
# unit gateway: SingleThreadedExecutor x1 rclpy.spin, main
#   group gateway_default EXCLUSIVE default
#   subscription on_msg in gateway_default key=in
#     reads Gateway.states @25
#     reads Gateway.heard item 'last' @26
#     reads Gateway.heard item 'last' @27
#     writes Gateway.states update in_place @25
#     writes Gateway.heard update in_place item 'last' @26
#     writes Gateway.heard update in_place keeps_size item 'last' @27
#   service lidar_lambda_switch in gateway_default (Gateway.__init__.<locals>.<lambda>) key=lidar
#     reads Gateway.states item 'lidar' @16>21
#     writes Gateway.states update in_place keeps_size item 'lidar' @16>21
#   service arm_lambda_switch in gateway_default (Gateway.__init__.<locals>.<lambda>) key=arm
#     reads Gateway.states item 'arm' @16>21
#     writes Gateway.states update in_place keeps_size item 'arm' @16>21
