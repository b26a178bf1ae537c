"""Columns that hold what they cannot, under checksums that are right: a result that breaks no law, or a sentence.
usage: columns.py STEP COMMAND...
Each word of the command that names a stream is replaced by that stream damaged, in every STEP-th of the ways: each column's first,
middle or last value, or all, is another, or it has fewer or more rows."""
import itertools, math, records, resource, signal, struct, subprocess, sys, zlib

NUMBERS = {
    b"d": ("<d", [math.nan, math.inf, 1e300, -1e300, 1e31, 9e29, 1e-29, 5e-324, -1.0, 0.0]),
    b"u": ("<I", [0xFFFFFFFF, 0x80000000, 0x7FFFFFFF, 65536, 0]),
    b"b": ("<B", [255, 2, 1, 0]),
    b"t": ("<B", [0, 10, 127, 255]),
}


def values(shape, data):
    """The column with other values: each with its name."""
    form, others = NUMBERS[shape[1:2]]
    size = struct.calcsize(form)
    n = len(data) // size
    for x in others + [max(n // shape[2] - 1, 0)] * (form == "<I"):
        raw = struct.pack(form, x)
        yield "all are %g" % x, raw * n
        for i in sorted({0, n // 2, n - 1}):
            yield "value %d is %g" % (i, x), data[: i * size] + raw + data[(i + 1) * size :]


def damaged(stream):
    end = 0
    for layer, name, shape, rows, data in records.read(stream):
        at, end = end, end + 64 + (len(data) + 63) // 64 * 64
        if not layer or layer == b"mrmesh1\n" or not rows:
            continue
        row = len(data) // rows
        changes = [(what, rows, other) for what, other in values(shape, data)]
        changes += [("%d rows of %d" % (k, rows), k, (data + data)[: k * row]) for k in (0, rows // 2, rows - 1, rows + 1)]
        for what, k, other in changes:
            yield "%s of %s: %s" % (name.decode(), layer.decode(), what), (at, end, (layer, name, shape, k, other))


def is_lawful(stream):
    return subprocess.run(["mr-info", "--check"], input=stream, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def fault(command, stream):
    """What is wrong with the end of the command, which was given the stream, or nothing."""
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (60, 70))
    p = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=limit)
    if p.returncode == -signal.SIGXCPU:
        return "no end within 60 s of computing"
    if p.returncode == 1 and p.stderr.startswith(command[0].encode() + b": "):
        return None
    if p.returncode:
        return "exit %d: %s" % (p.returncode, p.stderr[:200])
    if p.stdout.startswith(b"mrmesh1") and is_lawful(stream) and not is_lawful(p.stdout):
        return "a result that breaks a law"
    return None


step, command = int(sys.argv[1]), sys.argv[2:]
whole = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
if whole.returncode:
    sys.exit("%s: exit %d without a fault" % (" ".join(command), whole.returncode))
runs = wrong = 0
for i, word in enumerate(command):
    if not word.endswith(".mrs") or command[i - 1] == "-o":
        continue
    stream = subprocess.run(["mr-cat", "-u", word], stdout=subprocess.PIPE, check=True).stdout
    first = zlib.crc32(" ".join(command).encode()) % step
    for what, (at, end, parts) in itertools.islice(damaged(stream), first, None, step):
        other = stream[:at] + records.record(*parts) + stream[end:]
        open("damaged.mrs", "wb").write(other)
        runs += 1
        told = fault(command[:i] + ["damaged.mrs"] + command[i + 1 :], other)
        if told:
            wrong += 1
            print("%s: %s: %s" % (" ".join(command), what, told))
print("%s: %d runs, %d wrong" % (" ".join(command), runs, wrong))
sys.exit(wrong > 0)
