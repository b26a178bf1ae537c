"""What breaks around the tools, judged by what they leave: a right result with exit 0, or exit 1, a sentence and nothing.
usage: by_output.py killed TIMES | stalls STEP | flips STEP | full STEP
killed: a stage of a pipe is killed at some moment, TIMES times.  stalls: a producer that stops for a while, or for good, behind
every STEP-th byte.  flips: every STEP-th bit of a stream's headers, and as many of its payloads.  full: a file may have no more
than every STEP-th number of bytes."""
import os, random, records, resource, shlex, shutil, signal, subprocess, sys, time

wrong = runs = 0


def bad(text):
    global wrong
    wrong += 1
    if wrong <= 20:
        print(text)


def output(command, data=b""):
    return subprocess.run(shlex.split(command), input=data, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True).stdout


def sentence(command, err):
    tool = command.split()[0]
    return err.count(b"\n") == 1 and err.startswith(tool.encode() + b": ")


# ---- a stage is killed ----

EDIT = """mr-make bumpy -n 1500 | mr-smooth -q | mr-remesh -q | mr-select --free all --fixed below:y,0.3 --handle 1=above:y,0.8 |
    mr-encode | mr-pose -H 1 --rotate 0,0,1,30 | mr-solve | mr-decode -q | mr-export -q work/out.obj"""
SCAN = """mr-make bumpy -n 400 --points 800 | mr-shrinkwrap -q -m volume | mr-simplify -q -n 80 | mr-fit -q | mr-sample -q -n 2 |
    mr-decode -q | mr-cat -o work/out.mrs"""


def run_pipe(pipe, kill=None):
    """The stages' exit codes; kill: which stage after how many seconds by which signal."""
    stages, previous = [], None
    commands = [shlex.split(c) for c in pipe.split("|")]
    for i, c in enumerate(commands):
        last = i == len(commands) - 1
        p = subprocess.Popen(c, stdin=previous, stdout=None if last else subprocess.PIPE, stderr=subprocess.DEVNULL)
        if previous:
            previous.close()
        previous = p.stdout
        stages.append(p)
    if kill:
        time.sleep(kill[1])
        stages[kill[0]].send_signal(kill[2])
    return [p.wait() for p in stages]


def files():
    return {name: open("work/" + name, "rb").read() for name in os.listdir("work")}


def killed(times):
    global runs
    chance = random.Random(times)
    for pipe in EDIT, SCAN:
        shutil.rmtree("work", ignore_errors=True)
        os.mkdir("work")
        start = time.monotonic()
        codes = run_pipe(pipe)
        takes = time.monotonic() - start
        if any(codes):
            sys.exit("%s: exit %s without a fault" % (pipe, codes))
        good = files()
        for _ in range(times // 2):
            shutil.rmtree("work")
            os.mkdir("work")
            kill = (
                chance.randrange(len(codes)),
                chance.uniform(0, 1.1 * takes),
                chance.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGHUP, signal.SIGSEGV, signal.SIGABRT, signal.SIGPIPE]),
            )
            ends = run_pipe(pipe, kill)
            runs += 1
            if ends[-1] == 0 and files() != good:
                bad("%s of stage %d after %.3f s: exit 0 and another result" % (kill[2].name, kill[0], kill[1]))
            # A stage that is killed between naming its file and its own end leaves a whole one.
            if ends[-1] != 0 and files() and not (ends[-1] < 0 and files() == good):
                bad("%s of stage %d after %.3f s: exit %s, and there is %s" % (kill[2].name, kill[0], kill[1], ends, list(files())))


# ---- streams ----


def small_stream():
    cube = output("mr-make cube -n 8")
    return output("mr-smooth -q -t 0.01", cube)


SINKS = """mr-cat
mr-cat -z
mr-info
mr-info --json -l base
mr-compare -a mesh -b base
mr-export -q -l base -f obj -
mr-export -q -l mesh -f ply -
mr-export -q -l mesh -f stl -
mr-export -q -l base -f off -
mr-export -q -l mesh -f glb -
mr-view -q -
mr-render -q --size 24x24 -""".split("\n")


def feed(command, *pieces):
    """Each piece is written, then a moment's pause."""
    global runs
    runs += 1
    p = subprocess.Popen(shlex.split(command), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, bufsize=0)
    try:
        for i, piece in enumerate(pieces):
            if i:
                time.sleep(0.001)
            p.stdin.write(piece)
    except BrokenPipeError:
        pass
    out, err = p.communicate()
    return p.returncode, out, err


def refused(command, what, at_end, code, out, err):
    """Exit 1, a sentence, and on stdout nothing, but for the frame that stands before a damaged END, or no END."""
    if code != 1 or not sentence(command, err):
        bad("%s: %s: exit %d: %s" % (command, what, code, err[:200]))
    elif b"END" in out[-64:] if command.startswith("mr-cat") else out and not at_end:
        bad("%s: %s: refused, and yet it writes" % (command, what))


def stalls(step):
    stream = small_stream()
    for shift, command in enumerate(SINKS):
        good = output(command, stream)
        for k in range(shift % step, len(stream), step):
            code, out, err = feed(command, stream[:k], stream[k:])
            if code or out != good or err:
                bad("%s: a pause behind byte %d: exit %d: %s" % (command, k, code, err[:200]))
            refused(command, "cut at byte %d" % k, k >= len(stream) - 64, *feed(command, stream[:k]))


def places(stream):
    """Where each record begins, and how many bytes it stores."""
    at = 0
    for *_, data in records.read(stream):
        yield at, len(data)
        at += 64 + (len(data) + 63) // 64 * 64


def flips(step):
    stream = small_stream()
    headers = [8 * at + bit for at, _ in places(stream) for bit in range(512)]
    payloads = [8 * (at + 64) + bit for at, stored in places(stream) for bit in range(8 * ((stored + 63) // 64 * 64))]
    for shift, command in enumerate(SINKS):
        output(command, stream)
        every = max(1, len(payloads) * step // len(headers))
        for bit in headers[shift % step :: step] + payloads[shift % every :: every]:
            flipped = bytearray(stream)
            flipped[bit // 8] ^= 1 << bit % 8
            at_end = bit // 8 >= len(stream) - 64
            refused(command, "bit %d of byte %d" % (bit % 8, bit // 8), at_end, *feed(command, bytes(flipped)))


# ---- a full disk ----

WRITERS = """mr-cat -o work/out.mrs
mr-info --stats work/out
mr-export -q -l base -f obj work/out
mr-export -q -l mesh -f ply work/out
mr-export -q -l mesh -f stl work/out.gz
mr-export -q -l mesh -f glb work/out
mr-render -q --size 24x24 work/out.png""".split("\n")


def full(step):
    global runs
    stream = small_stream()
    for shift, command in enumerate(WRITERS):
        shutil.rmtree("work", ignore_errors=True)
        os.mkdir("work")
        output(command, stream)
        (name, good), = files().items()
        old = b"mrmesh1\n" if name.endswith(".mrs") else b"old"
        for most in range(shift % step, len(good), step):
            shutil.rmtree("work")
            os.mkdir("work")
            open("work/" + name, "wb").write(old)
            limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
            p = subprocess.run(shlex.split(command), input=stream, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=limit)
            runs += 1
            if p.returncode != 1 or not sentence(command, p.stderr) or files() != {name: old}:
                bad("%s: no more than %d bytes: exit %d, %s: %s" % (command, most, p.returncode, files().keys(), p.stderr[:200]))


{"killed": killed, "stalls": stalls, "flips": flips, "full": full}[sys.argv[1]](int(sys.argv[2]))
print("%d runs, %d wrong" % (runs, wrong))
sys.exit(wrong > 0)
