from robot import Robot, serve


class FakeRobot(Robot):
    pass


def test_robot():
    serve(FakeRobot)()
