"""A pool computes; its done-callback hands the result to the coroutine of a subscription."""

import time
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String


def recognise(text):
    time.sleep(0.8)
    return text.upper()


class Ears(Node):
    def __init__(self):
        super().__init__('ears', start_parameter_services=False)
        self.pool = ThreadPoolExecutor(max_workers=1)
        self.publisher = self.create_publisher(String, 'speech', 10)
        self.create_subscription(
            String, 'speech', self.on_speech, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.once = self.create_timer(0.3, self.speak)

    def speak(self):
        if self.publisher.get_subscription_count():
            self.once.cancel()
            self.publisher.publish(String(data='stop'))

    async def on_speech(self, message):
        heard = Future()
        job = self.pool.submit(recognise, message.data)
        job.add_done_callback(lambda done: heard.set_result(done.result()))
        print('listening', flush=True)
        # differs: future-wakes
        print(await heard, flush=True)


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Ears())
    executor.spin()


if __name__ == '__main__':
    main()
