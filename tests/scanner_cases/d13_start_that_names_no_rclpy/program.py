from robot import Robot, serve


class Other(Robot):
    pass


main = serve(Other)
