"""checks.py -- what the tests of the page share: counting what fails, and values of a stream as numbers."""
import math
import sys

from records import first_frame as columns

failed = 0


def check(good, what):
    global failed
    if not good:
        print(what)
        failed += 1


def end():
    sys.exit(1 if failed else 0)


def box(points):
    return [min(p[c] for p in points) for c in range(3)], [max(p[c] for p in points) for c in range(3)]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return [x / length(a) for x in a]


class Camera:
    """That of the page: all of a box in view, from a direction, y upwards; canvas: left, top, width, height."""

    def __init__(self, points, canvas, direction=(0.5, 0.35, 1)):
        low, high = box(points)
        self.canvas, half = canvas, math.radians(15)
        self.aspect = canvas[2] / canvas[3]
        across = math.atan(math.tan(half) * min(self.aspect, 1))
        self.target = [(a + b) / 2 for a, b in zip(low, high)]
        self.back = unit(direction)
        self.distance = length(sub(high, low)) / 2 / math.sin(across)
        self.eye = [t + self.distance * d for t, d in zip(self.target, self.back)]
        self.right = unit(cross((0, 1, 0), self.back))
        self.up = cross(self.back, self.right)
        self.scale = math.tan(half)

    def pixel(self, point):
        """Where a point is in the window."""
        v = sub(point, self.eye)
        depth = -dot(v, self.back)
        x, y = dot(v, self.right) / depth / self.scale / self.aspect, dot(v, self.up) / depth / self.scale
        left, top, width, height = self.canvas
        return left + (x + 1) / 2 * width, top + (1 - y) / 2 * height
