"""A web server answers on other threads than those that spin, where that is known for certain."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.promises import Promise, judge
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit
from tests.help.cases import said

PROGRAM = """\
import asyncio
import threading
import rclpy
import uvicorn
from fastapi import APIRouter, FastAPI
from flask import Flask
from rclpy.node import Node
from std_msgs.msg import String

APP
board = None

class Orders:
    def __init__(self):
        self.lock = threading.Lock()
        self.open = {}

    def add(self, number):
        ADDS

orders = Orders()

class Board(Node):
    def __init__(self):
        super().__init__('board')
        self.shown = {}
        self.create_subscription(String, 'order', self.on_order, 10)

    def on_order(self, msg):
        with orders.lock:
            for number in orders.open:
                print(number)
        for number in self.shown:
            print(number)

@WEB
DEF answer(number: int):
    DOES

def main():
    global board
    rclpy.init()
    board = Board()
    RUNS

if __name__ == '__main__':
    main()
"""
PLAIN = 'self.open[number] = 0'
LOCKED = 'with self.lock: self.open[number] = 0'
SERVED = """\
threading.Thread(target=rclpy.spin, args=(board,), daemon=True).start()
    uvicorn.run(app)
"""
SPUN = """\
threading.Thread(target=app.run, daemon=True).start()
    rclpy.spin(board)
"""
FLASK_IN_MAIN = SERVED.replace('uvicorn.run(app)', 'app.run()')
FASTAPI_IN_THREAD = SPUN.replace('app.run,', 'uvicorn.run, args=(app,),')
UNKNOWN = 'threading.Thread(target=rclpy.spin, args=(board,), daemon=True).start()'
IN_LOOP = """\
async def spin():
        while rclpy.ok():
            rclpy.spin_once(board, timeout_sec=0)
            await asyncio.sleep(0.01)
    @app.on_event('startup')
    async def begin():
        asyncio.create_task(spin())
    uvicorn.run(app)
"""


def program(
    does: str = 'orders.add(number)',
    runs: str = SERVED,
    *,
    app: str = 'app = FastAPI()',
    web: str = "app.post('/order')",
    define: str = 'def',
    adds: str = PLAIN,
) -> str:
    text = PROGRAM.replace('APP\n', f'{app}\n').replace('WEB', web).replace('DEF', define)
    return text.replace('DOES', does).replace('RUNS', runs).replace('ADDS', adds)


def races(text: str) -> list[str]:
    return [each.message for each in said(text) if each.code == 'CC301']


def reason(text: str) -> str:
    [unit] = scan_text(text, 'board.py').units
    verification = verify_unit(close(unit), Options(profile=Profile.RCLPY))
    judgements = {each.promise: each for each in judge(unit, verification, [])}
    return judgements[Promise.RACES].reason


@pytest.mark.parametrize('define', ['def', 'async def'])
@pytest.mark.parametrize(
    ('does', 'what'),
    [('orders.add(number)', 'Orders.open'), ('board.shown[number] = 0', 'Board.shown')],
)
@pytest.mark.parametrize(
    ('app', 'web', 'runs'),
    [
        ('app = FastAPI()', "app.post('/order')", SERVED),
        ('app = FastAPI()', "app.websocket('/order')", SERVED),
        ('app = FastAPI()\nrouter = APIRouter()', "router.post('/order')", SERVED),
        ('app = Flask(__name__)', "app.route('/order')", SPUN),
        (
            'app = Flask(__name__)',
            "app.route('/order')",
            FLASK_IN_MAIN,
        ),
        (
            'app = FastAPI()',
            "app.post('/order')",
            FASTAPI_IN_THREAD,
        ),
    ],
)
def test_what_it_adds_while_a_callback_goes_over_it_is_told(
    app: str, web: str, runs: str, does: str, what: str, define: str
) -> None:
    [message] = races(program(does, runs, app=app, web=web, define=define))
    assert message.startswith(f'Board.on_order iterates over {what}, and pool thread answer may')


def test_a_lock_around_both_is_enough() -> None:
    assert races(program(adds=LOCKED)) == []
    assert reason(program(adds=LOCKED)) == ''


@pytest.mark.parametrize('does', ['orders.add(number)', 'board.shown[number] = 0'])
@pytest.mark.parametrize('runs', [UNKNOWN, IN_LOOP])
def test_where_its_thread_is_not_known_it_is_undecided(does: str, runs: str) -> None:
    text = program(does, runs)
    assert races(text) == []
    assert "answer may run (it is handed to app.post('/order')" in reason(text)


def test_what_a_server_calls_once_is_undecided_too() -> None:
    text = program(web="app.on_event('startup')")
    assert races(text) == []
    assert 'answer may run' in reason(text)
