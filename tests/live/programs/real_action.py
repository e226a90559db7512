"""An action server and its client on a pool: one goal is reached, another is cancelled."""

import faulthandler
import threading
import time

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci

REACHED = 5
ENDLESS = 1_000_000
PATIENCE_S = 240


class Server(Node):
    """Counts until it has got there or is told to stop."""

    def __init__(self) -> None:
        super().__init__('counter')
        self.group = ReentrantCallbackGroup()
        self.server = ActionServer(
            self,
            Fibonacci,
            'count',
            self.execute,
            goal_callback=self.on_goal,
            cancel_callback=self.on_cancel,
            callback_group=self.group,
        )

    def on_goal(self, goal: Fibonacci.Goal) -> GoalResponse:
        return GoalResponse.ACCEPT

    def on_cancel(self, handle: object) -> CancelResponse:
        return CancelResponse.ACCEPT

    def execute(self, handle) -> Fibonacci.Result:
        sequence = []
        for number in range(handle.request.order):
            if handle.is_cancel_requested:
                handle.canceled()
                return Fibonacci.Result()
            sequence.append(number)
            handle.publish_feedback(Fibonacci.Feedback(sequence=sequence[-3:]))
            time.sleep(0.005)
        handle.succeed()
        return Fibonacci.Result(sequence=sequence)


class Asking(Node):
    """Asks for what can be reached, then for what cannot."""

    def __init__(self) -> None:
        super().__init__('asking')
        self.over = threading.Event()
        self.client = ActionClient(self, Fibonacci, 'count')

    def ask(self, order: int) -> None:
        asked = self.client.send_goal_async(Fibonacci.Goal(order=order), self.on_feedback)
        asked.add_done_callback(self.on_answer)

    def on_feedback(self, message: object) -> None:
        pass

    def on_answer(self, future) -> None:
        handle = future.result()
        handle.get_result_async().add_done_callback(self.on_result)
        if len(told) == 1:
            handle.cancel_goal_async()

    def on_result(self, future) -> None:
        told.append((future.result().status, list(future.result().result.sequence)))
        if len(told) == 1:
            self.ask(ENDLESS)
        else:
            self.over.set()


told: list[tuple[int, list[int]]] = []


def main() -> None:
    faulthandler.dump_traceback_later(PATIENCE_S, exit=True)
    rclpy.init()
    server, asking = Server(), Asking()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(server)
    executor.add_node(asking)
    spinning = threading.Thread(target=executor.spin)
    spinning.start()
    asking.client.wait_for_server()
    asking.ask(REACHED)
    asking.over.wait()
    executor.shutdown()
    spinning.join()
    print(told)
    rclpy.shutdown()


if __name__ == '__main__':
    main()
