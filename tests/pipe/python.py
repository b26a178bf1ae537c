# What python.sh asks of the package from within: ways of frames, findings, errors, and much that is no input.
import gc, os, random, threading, time, warnings

import numpy as np

import mr

failed = 0


def check(good, what):
    global failed
    if not good:
        failed = 1
        print(what)


def data(path):
    with open(path, "rb") as f:
        return f.read()


def raises(error, act, words):
    try:
        act()
    except Exception as caught:
        check(type(caught) is error and words in str(caught), f"{words}: {caught!r}")
    else:
        check(False, f"{words}: no {error.__name__}")


def alike(frames, others):
    """Whether two sequences have the same columns, but for the history."""
    ours, theirs = ([{place: bytes(c.payload) for place, c in frame.columns.items() if place[1] != "history"}
                     for frame in some] for some in (frames, others))
    return bool(ours) and ours == theirs


model = mr.read("model.mrs")
mr.write("again.mrs", model)
check(data("again.mrs") == data("model.mrs"), "a stream that is read and written is another")
p, t = model["mesh"]["position"], model["mesh"]["triangles"]
check(p.dtype == float and p.shape[1] == 3 and not p.flags.owndata and not p.flags.writeable, "positions are no view")

# Frames by themselves, in a chain of processes, by an iterator of Python's, from a file: the same.
handles = mr.select(mr.smooth(model), free="all", fixed="below:y,0.5", handle=["0=above:y,0.9", "1=above:y,0.85"])
creature = mr.encode(handles)
poses = list(mr.pose([creature], handle=1, rotate=(0, 0, 1, 20), frames=4))
chain = list(mr.decode(mr.solve(mr.pose([creature], handle=1, rotate=(0, 0, 1, 20), frames=4))))
check(len(chain) == 5 and not chain[1].key, "a chain gives no deltas")
check(alike(chain, mr.decode(mr.solve(poses))), "a list gives otherwise")
check(alike(chain, mr.decode(f for f in mr.solve(f for f in poses))), "a generator gives otherwise")
mr.write("poses.mrs", poses)
check(alike(chain, mr.decode(mr.solve(mr.frames("poses.mrs")))), "a file gives otherwise")
begun = mr.solve(poses)
first = next(begun)
check(len(list(mr.decode(begun))) == 4, "what is begun does not go on")
check(alike([mr.mesh(p, t)], [model]), "a frame of arrays is another")
check(mr.mesh(p)["points"]["position"].shape == p.shape, "points of arrays")

# The order of options counts; side streams are frames or files; reports are values.
swapped = mr.select(mr.smooth(model), handle={0: "above:y,0.9", 1: "above:y,0.85"}, fixed="below:y,0.5", free="all")
check(set(swapped["mesh"]["region"]) == {1}, "the last option does not win")
warnings.filterwarnings("ignore", "mr-compare")  # that they could be aligned
moved = mr.transform(model, rotate=[(0, 0, 1, 90), (0, 1, 0, 90)], matrix=np.eye(4)[:3])
check(mr.compare(moved, model)["a_to_b"]["max"] > 0.1, "nothing has moved")
back = mr.align(moved, model)
check(mr.compare(back, "model.mrs", vertices=True)["a_to_b"]["max"] < 1e-6, "it is not back")
check("away" in mr.compare(moved, model, column="away")["mesh"], "no column")
check(len(mr.cat(model, moved, append=True)["mesh"]["position"]) == 2 * len(p), "not both")
check([f.name for f in mr.cat([model], [moved], [back])] == ["model"] * 3, "not all three")
check(mr.info(model)["layers"]["mesh"]["genus"] == 0 and mr.info([model, moved], verdict=True) == ["good"] * 2, "info")
check(mr.render(model, "-", size="64x64")[1:4] == b"PNG" and mr.render(model, "x.png", size="64x64") == b"", "a picture")

# Findings: warnings where the caller stands, once; on the frame, with their numbers.
flat = mr.transform(mr.make("torus", vertices=500), scale=(1, 0.01, 1))
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    shrunk = mr.smooth(flat, time=1000, plain=True)
check([(w.category, w.message.kind, w.message.tool, w.filename) for w in caught] ==
      [(mr.Finding, "shrunk", "mr-smooth", __file__)], f"warned: {[str(w.message) for w in caught]}")
(finding,) = shrunk.findings
check((finding.kind, finding.layer, finding.count) == ("shrunk", "base", None) and finding.value > 0.9, repr(finding))
with warnings.catch_warnings(record=True) as caught:
    check(not mr.smooth(flat, time=1000, plain=True, quiet=True).findings and not caught, "quiet")

# Errors: the sentence of what failed first; an exception of a generator comes through all tools.
raises(mr.Error, lambda: mr.solve(model), "mr-solve: frame 1 (model): no layer base")
raises(mr.Error, lambda: list(mr.decode(mr.solve(mr.pose([model], handle=7, translate=(0, 0, 1))))), "mr-pose: ")
raises(mr.Error, lambda: list(mr.smooth(f for f in mr.pose([model], handle=7, translate=(0, 0, 1)))), "mr-pose: ")
raises(mr.Error, lambda: mr.smooth(model, time="soon"), "mr-smooth: --time: 'soon' is not a number")
raises(mr.Error, lambda: mr.split(mr.cat(model, mr.transform(model, translate=(9, 9, 9)), append=True)), "2 frames")
raises(mr.Error, lambda: mr.read("poses.mrs"), "poses.mrs: 5 frames")
raises(FileNotFoundError, lambda: mr.read("none.obj"), "none.obj")
raises(TypeError, lambda: mr.smooth(model, tim=3), "mr.smooth: got an unexpected keyword argument 'tim'")
raises(TypeError, lambda: mr.smooth("model.mrs"), "a frame is expected, or several, not str")
raises(TypeError, lambda: list(mr.smooth([model, 3])), "a frame is expected, not int")
taken = mr.smooth([model])
of_taken = mr.remesh(taken)
raises(mr.Error, lambda: next(taken), "mr-smooth: another tool has its frames")
list(of_taken)


def breaks():
    yield model
    raise KeyError("mine")


raises(KeyError, lambda: list(mr.remesh(mr.smooth(breaks()))), "mine")

# What nobody reads to its end is ended.
left = mr.pose([creature], handle=1, rotate=(0, 0, 1, 20), frames=100000)
next(left)
process = left.process
del left
gc.collect()
check(process.poll() is not None, "a tool runs for nobody")
for _ in range(100):
    if threading.active_count() > 1:
        time.sleep(0.1)
check(threading.active_count() == 1, "threads are left")
del first, begun, taken, of_taken
gc.collect()
check(len(os.listdir("/proc/self/fd")) < 20, "files are left open")

# Whatever comes in, a frame or a sentence comes out.
dice = random.Random(1)
numbers = [0, -1, 3, 2 ** 31, 2 ** 40, 2 ** 70, 1e300, float("nan"), float("inf"), 1.5, True, None, "", "x", "-1", b"x", "\0",
           "ä\udcff", [], [1], (1, 2, 3), {}, {1: 2}, {"a": [1]}, object(), 1j, np.float32(2), np.int8(-3), np.datetime64("now"), [None],
           [[1], [2, 3]], model, [model], iter([]), mr, len, np.zeros((0, 3)), np.zeros((2, 2, 2)), np.array(["a"])]
arrays = [p, t, p[:, :2], p[::2], p.T, p.astype(np.float32), p.astype(complex), p.astype(object), np.full((4, 3), np.nan),
          t.astype(np.int64) - 1, t.astype(float), t + 10 ** 6, t[:0], np.zeros((3, 300)), np.broadcast_to(1.0, (10 ** 13, 3)),
          np.broadcast_to(np.uint32(0), (5, 3)), p[:, :, None], np.ma.masked_array(p), memoryview(bytes(9)), range(9)] + numbers
expected = (mr.Error, TypeError, ValueError, MemoryError, OverflowError, UnicodeError, OSError)
options = "time passes layer method threads scratch stats".split()


def any_frame():
    act = dice.randrange(4)
    if act == 0:
        return mr.mesh(dice.choice(arrays), dice.choice(arrays))
    frame = mr.Frame(dice.choice(["x", "", "a/b", 3, None, "n" * 300, "ä"]) if act == 1 else "x")
    if act > 1:
        frame = mr.mesh(p, t)
    frame.put(dice.choice(["mesh", "", "base", "l" * 17, "ä", 3]), dice.choice(["position", "region", "", "c" * 25, "END"]),
              dice.choice(arrays), dice.choice(["v", "f", "-", "x", "", None, 3]))
    return frame


warnings.simplefilter("ignore")
given, attempts = 0, 400 // int(os.environ.get("SPARSE", 1))
for attempt in range(attempts):
    try:
        frame = any_frame() if attempt % 4 else model
        if attempt % 8 < 4:
            mr.smooth(frame, **{dice.choice(options): dice.choice(numbers)} if attempt % 4 == 0 else {})
        elif attempt % 8 == 4:
            mr.transform(model, **{dice.choice(["translate", "rotate", "matrix"]): dice.choice(arrays)})
        elif attempt % 8 == 5:
            mr.smooth(dice.choice(arrays))
        else:
            mr.write("any.mrs", frame)
        given += 1
    except expected as error:
        check(str(error), f"attempt {attempt}: no sentence: {error!r}")
    except Exception as error:
        check(False, f"attempt {attempt}: {error!r}")
check(attempts / 40 < given < attempts / 2, f"{given} of {attempts} went well")
raise SystemExit(failed)
