from robot import Robot, serve

if __name__ == '__main__':
    serve(Robot)()
