"""matrix -- every tool on every model: a result that keeps what its page promises, or one sentence and exit 1.

usage: tests/matrix/run [--small] [PATTERN]          PATTERN: a part of "MODEL JOB"

Works in the current directory; the models are uglies made here (in uglies/) and, without --small, which leaves out second ways to run a tool
and sizes between, those of $DATA, the small ones first.  A cell is a job on a model: it is wrong where it ends by a signal, not in time, by another exit than 0 or 1, with
0 and a result that breaks a promise or a sentence, with 1 and more or less than one sentence, a whole stream or a file; or
where it takes more CPU time or memory than the bounds below.  Wrong cells are listed with the pipe that shows them; the last
line counts.  Exit 1 where one is wrong.  Knobs: DATA, JOBS (models at a time), SAN (no bounds of memory).
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from multiprocessing import Pool

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(TOP, "lib", "python", "mr")]
import check as c  # noqa: E402
import uglies  # noqa: E402

# Of CPU time and of memory, for a model of so many vertices and faces.  Most of any is mr-solve's and mr-fit's.
SECONDS = lambda rows: 20 + 2e-3 * rows
BYTES = lambda rows: 400e6 + 12e3 * rows

# Job, the job whose result it reads (or MODEL in the command), command, what is promised: of a stream a function of the frames
# before and after, beside what holds for every frame; of a file NAME, or of what is printed (-), one of the frames before and a path.
CHOICE = "--reset --free all --fixed below:y,0.2 --handle 1=above:y,0.8"
EDIT = f"mr-smooth | mr-remesh | mr-select {CHOICE} | mr-encode | mr-pose -H 1 --rotate 0,0,1,30 | mr-solve | mr-decode"
JOBS = [
    ("import", None, "mr-import MODEL", c.anything),
    ("repair", None, "mr-import --repair MODEL", c.anything),
    ("cloud", None, "mr-import --points MODEL", c.columns("points", "position")),
    ("edit", None, f"mr-import MODEL | {EDIT} | mr-export edit.ply", ("edit.ply", None)),
    ("scan", None, "mr-import --points MODEL | mr-shrinkwrap | mr-simplify | mr-fit | mr-sample | mr-decode | mr-export scan.ply",
     ("scan.ply", None)),
    ("cat", "import", "mr-cat", c.same_values),
    ("pack", "import", "mr-cat -z", c.same_values),
    ("info", "import", "mr-info --json", ("-", c.info_text)),
    ("render", "import", "mr-render --size 60x40 x.png", ("x.png", c.png_file)),
    ("view", "import", "mr-view x.html", ("x.html", c.page_file)),
    ("obj", "import", "mr-export x.obj", ("x.obj", c.obj_file)),
    ("ply", "import", "mr-export x.ply", ("x.ply", c.ply_file)),
    ("stl", "import", "mr-export x.stl", ("x.stl", c.stl_file)),
    ("off", "import", "mr-export x.off", ("x.off", c.off_file)),
    ("glb", "import", "mr-export x.glb", ("x.glb", c.glb_file)),
    ("xyz", "cloud", "mr-export x.xyz", ("x.xyz", c.xyz_file)),
    ("transform", "import", "mr-transform --scale 2", c.doubled),
    ("crop", "import", "mr-crop --keep above:y,0.5", c.upper_half),
    ("fill", "import", "mr-fill", c.first_rows),
    ("align", "import", "mr-align MODEL", c.anything),
    ("split", "import", "mr-split", c.parts),
    ("split-cloud", "cloud", "mr-split", c.anything),
    ("normals", "import", "mr-normals", c.unit_normals),
    ("normals-cloud", "cloud", "mr-normals", c.unit_normals),
    ("choose", "import", "mr-select --reset --fixed all --handle 1=above:y,0.5", c.chosen),
    ("smooth", "import", "mr-smooth", c.same_triangles(["base", "mesh"], "base")),
    ("taubin", "import", "mr-smooth -m taubin", c.same_triangles(["base", "mesh"], "base")),
    ("remesh", "smooth", "mr-remesh", c.same_topology("base", "base")),
    ("remesh-rough", "import", "mr-remesh", c.same_topology_joined("base", "mesh", "base")),
    ("adaptive", "import", "mr-remesh --adaptive 1% --feature 40", c.same_topology_joined("base", "mesh", "base")),
    ("compare", "remesh", "mr-compare --json -a mesh -b base", ("-", c.distances)),
    ("select", "remesh", f"mr-select {CHOICE}", c.columns("mesh", "region")),
    ("encode", "select", "mr-encode", c.columns("mesh", "detail_face", "detail_height")),
    ("basis", "encode", "mr-solve --basis", c.columns("base", "response", "rest")),
    ("flatten", "select", "mr-solve --flatten", c.still_fixed),
    ("pose", "encode", "mr-pose -H 1 --rotate 0,0,1,30", c.columns("handles", "transform")),
    ("bend", "pose", "mr-solve", c.still_fixed),
    ("arap", "pose", "mr-solve --arap 1 -k 1", c.still_fixed),
    ("multigrid", "pose", "mr-solve -s multigrid", c.still_fixed),
    ("decode", "bend", "mr-decode", c.same_triangles(["mesh"], "mesh")),
    ("subdivide", "import", "mr-subdivide -n 1 --limit", c.four_of_each),
    ("longest", "import", "mr-subdivide --longest 10%", c.short_edges),
    ("simplify", "import", "mr-simplify", c.same_topology_joined("control", "base", "mesh", "mesh")),
    ("control", "import", "mr-simplify --to control", c.same_topology_joined("base", "mesh", "control")),
    ("fit-mesh", "control", "mr-fit -n 2", c.same_triangles(["control"], "control")),
    ("heights", "control", "mr-sample -n 2", c.heights),
    ("equalize", "heights", "mr-equalize --gain 1,0.5", c.heights),
    ("map", "heights", "mr-map -w map", c.pictures),
    ("bake", "simplify", "mr-map --bake import.mrs -w bake --size 256", c.baked),
    ("rebuild", "heights", "mr-decode", c.heights),
    ("wrap", "cloud", "mr-shrinkwrap", c.manifold("control")),
    ("cube", "cloud", "mr-shrinkwrap -m cube -r 8", c.manifold("control")),
    ("coarse", "wrap", "mr-simplify", c.same_topology("control", "control")),
    ("coarse-creases", "wrap", "mr-simplify --creases", c.same_topology("control", "control")),
    ("fit", "coarse", "mr-fit", c.same_triangles(["control"], "control")),
    ("fit-local", "coarse", "mr-fit -m local -n 2", c.same_triangles(["control"], "control")),
    ("sample", "fit", "mr-sample", c.heights),
    ("robust", "fit", "mr-sample -m robust", c.heights),
    ("surface", "sample", "mr-decode", c.heights),
    ("paint", "import", f"PYTHONPATH='{TOP}/lib/python/mr' {sys.executable} -B '{TOP}/tests/matrix/paint.py'", c.anything),
    ("paint-crop", "paint", "mr-crop --keep above:y,0.5", c.carried("mesh", 0.01, False)),
    ("paint-fill", "paint", "mr-fill", c.carried("mesh", 0.05, False)),
    ("paint-subdivide", "paint", "mr-subdivide -n 1", c.carried("mesh", 0.05)),
    ("paint-remesh", "paint", "mr-remesh", c.carried("base", 0.02)),
    ("paint-simplify", "paint", "mr-simplify", c.carried("mesh", 0.1)),
    ("paint-decode", "paint", "mr-simplify --to control | mr-fit | mr-sample | mr-decode", c.carried("mesh", 0.05)),
]

SECOND = {"repair", "cat", "off", "glb", "xyz", "split-cloud", "taubin", "adaptive", "flatten", "arap", "multigrid", "longest",
          "fit-mesh", "fit-local", "robust", "coarse-creases", "choose", "remesh-rough", "paint-crop", "paint-subdivide"}
BETWEEN = tuple(f"size-1e{e}.obj" for e in (-200, -29, -12, 12, 29, 200))


class Cell:
    """A job of a model, run: its exit, what it said, what it took."""

    def __init__(self, command, source, rows):
        self.limit = SECONDS(rows)
        # A process may have twice the bound of CPU time before it is ended, and all twenty times as much by the clock.
        shell = f"ulimit -c 0; ulimit -t {int(2 * self.limit)}; {command}"
        with open(source or os.devnull, "rb") as stdin, open("out", "wb") as out, open("err", "wb") as err:
            child = subprocess.Popen(["timeout", str(20 * self.limit), "sh", "-c", shell], stdin=stdin, stdout=out, stderr=err, close_fds=False)
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = 0
        self.code = os.waitstatus_to_exitcode(status)
        self.seconds, self.bytes = used.ru_utime + used.ru_stime, 1024 * used.ru_maxrss
        self.said = open("err", encoding="utf-8", errors="replace").read()

    def judge(self, promise, source, rows):
        """Whether there is a result; Broken where the cell is wrong."""
        said = c.sentences(self.said)
        c.must(self.code in (0, 1), f"exit {self.code}: {self.said[-300:]}")
        c.must("without END" not in self.said, f"a stage died without a word: {self.said[-300:]}")
        c.must(len(said) == self.code, f"exit {self.code} and {len(said)} sentences: {self.said[:600]}")
        c.must(self.seconds <= self.limit, f"{self.seconds:.0f} s of {self.limit:.0f}")
        c.must(os.environ.get("SAN") or self.bytes <= BYTES(rows), f"{self.bytes / 1e6:.0f} MB of {BYTES(rows) / 1e6:.0f}")
        name, promise = promise if isinstance(promise, tuple) else (None, promise)
        if self.code:
            c.must(not os.path.exists(name or "map.mtl"), "a file is left where the tool failed")
            c.must(name or b"END\0" not in open("out", "rb").read()[-64:], "a whole stream where the tool failed")
            return False
        if name:
            c.must(os.path.getsize("out" if name == "-" else name), "an empty result")
            if promise:
                promise(c.frames(source), "out" if name == "-" else name)
            return True
        after = c.frames("out")
        c.must(after, "a stream of no frames")
        for frame in after:
            c.lawful(frame)
        promise(c.frames(source) if source else [], after)
        return True


def rows_of(model, states):
    """Vertices and faces; of a model that is not read yet, its lines or so."""
    if "import" not in states and "cloud" not in states:
        return os.path.getsize(model) / (3 if model.endswith(".gz") else 12)
    frame = c.frames(states["import" if "import" in states else "cloud"])[0]
    return max(len(frame[layer]["position"]) + c.faces(frame, layer) for layer in frame if "position" in frame[layer])


def pipe_of(job, model):
    """The command line that gives a job's result."""
    _, source, command, _ = next(j for j in JOBS if j[0] == job)
    return (pipe_of(source, model) + " | " if source else "") + command.replace("MODEL", f"'{model}'")


def row(task):
    """All jobs of a model: counts, and lines about what is wrong."""
    model, pattern, small = task
    jobs = [job for job in JOBS if not small or job[0] not in SECOND]
    wanted = {job[0] for job in jobs if pattern in f"{os.path.basename(model)} {job[0]}"}
    needed = set(wanted)
    for job in reversed(jobs):
        needed |= {job[1]} if job[0] in needed else set()
    folder = tempfile.mkdtemp(prefix="row-", dir=os.getcwd())
    os.chdir(folder)
    states, tally, lines, slow = {}, {"good": 0, "refused": 0, "wrong": 0}, [], []
    try:
        for job, source, command, promise in jobs:
            if job not in needed or source and source not in states:
                continue
            rows = rows_of(model, states)
            cell = Cell(command if source else pipe_of(job, model), states.get(source), rows)
            try:
                verdict = "good" if cell.judge(promise, states.get(source), rows) else "refused"
            except Exception as error:  # whatever the check stumbles over is wrong
                verdict = "wrong"
                if job in wanted:
                    lines.append(f"WRONG {os.path.basename(model)} {job}: {error}\n      {pipe_of(job, model)}")
            if verdict == "good" and any(job == j[1] for j in jobs):
                states[job] = os.path.join(folder, job + ".mrs")
                os.rename("out", states[job])
            if job in wanted:
                tally[verdict] += 1
                slow.append((cell.seconds / cell.limit, cell.bytes / BYTES(rows), job, model))
            for name in os.listdir("."):
                if not name.endswith(".mrs"):
                    os.remove(name)
    finally:
        os.chdir("..")
        shutil.rmtree(folder)
    return tally, lines, slow


def models(small, pattern):
    def wanted(path):
        return any(pattern in f"{os.path.basename(path)} {job[0]}" for job in JOBS)
    made = uglies.write(os.path.abspath("uglies"), lambda path: wanted(path) and not (small and path.endswith(BETWEEN)))
    data = os.environ.get("DATA") if not small else None
    found = [os.path.join(where, name) for folder in ("meshes", "points", "malformed", "faults")
             for where, _, names in os.walk(os.path.join(data, folder)) for name in names
             if not name.endswith((".mtl", ".md", ".mrs", ".png", ".jpg"))] if data else []
    return made + sorted(filter(wanted, found), key=lambda path: (os.path.getsize(path), path))


def by_default_signals():
    """A worker that took SIGTERM as its parent does could pass over the exception and never end."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)


def main(arguments):
    small = arguments[:1] == ["--small"]
    pattern = "".join(arguments[small:])
    sparse = int(os.environ.get("SPARSE") or 1) if small else 1
    tasks = [(model, pattern, small) for model in models(small, pattern)][::sparse]
    total, worst, done = {"good": 0, "refused": 0, "wrong": 0}, [], 0
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        with Pool(int(os.environ.get("JOBS") or 1), by_default_signals) as pool:
            for tally, lines, slow in pool.imap(row, tasks):
                for verdict in total:
                    total[verdict] += tally[verdict]
                for line in lines:
                    print(line, flush=True)
                worst += slow
                done += 1
            pool.close()
            pool.join()
    finally:
        for k, what in (0, "time"), (1, "memory"):
            for cell in sorted(worst, key=lambda w: -w[k])[:3]:
                print(f"{100 * cell[k]:.0f} % of the {what}: {os.path.basename(cell[3])} {cell[2]}")
        print(f"{done} of {len(tasks)} models, {sum(total.values())} cells: {total['good']} results, {total['refused']} refused by a sentence,"
              f" {total['wrong']} wrong", flush=True)
    return total["wrong"] > 0 or not total["good"]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
