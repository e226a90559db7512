import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.srv import BasicTypes


class Ledger(Node):
    """Keeps the price list."""

    PRICES = {1: 120, 2: 75, 3: 310, 4: 42}

    def __init__(self):
        super().__init__('ledger')
        self.create_service(BasicTypes, 'lookup', self.lookup)

    def lookup(self, request, response):
        response.int32_value = self.PRICES.get(request.int32_value, 0)
        return response


class PriceGateway(Node):

    def __init__(self):
        super().__init__('price_gateway')
        self.declare_parameter('tax_percent', 20)
        self._group = ReentrantCallbackGroup()
        self._lookup = self.create_client(
            BasicTypes, 'lookup', callback_group=self._group)
        self.create_service(
            BasicTypes, 'quote', self.quote, callback_group=self._group)

    async def quote(self, request, response):
        reply = await self._lookup.call_async(request)
        net = reply.int32_value
        tax = self.get_parameter('tax_percent').value
        response.int32_value = net * (100 + tax) // 100
        self.get_logger().info('quoted item %d' % request.int32_value)
        return response


class Till(Node):
    """Asks for a whole basket at once."""

    def __init__(self, basket):
        super().__init__('till')
        self._basket = list(basket)
        self._round = 0
        self._client = self.create_client(
            BasicTypes, 'quote', callback_group=ReentrantCallbackGroup())
        self._timer = self.create_timer(1.0, self.scan)

    async def scan(self):
        if not self._client.service_is_ready():
            return
        self._round += 1
        self.get_logger().info('scanning basket %d' % self._round)
        futures = [self._client.call_async(BasicTypes.Request(int32_value=item))
                   for item in self._basket]
        total = 0
        for future in futures:
            reply = await future
            total += reply.int32_value
        self.get_logger().info('basket %d total %d' % (self._round, total))


def main():
    rclpy.init()
    nodes = [Ledger(), PriceGateway(), Till([1, 2, 3, 4])]
    executor = MultiThreadedExecutor(num_threads=2)
    for node in nodes:
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        for node in nodes:
            node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
