"""Columns that hold what they cannot, under checksums that are right: a result that breaks no law, or a sentence.
usage: columns.py STEP COMMAND...
Each word of the command that names a stream is replaced by that stream damaged, in every STEP-th of the ways: each column's first,
middle or last value, or all, is another, or it has fewer or more rows."""
import itertools, math, resource, signal, struct, subprocess, sys, zlib

NUMBERS = {
    b"d": ("<d", [math.nan, math.inf, 1e300, -1e300, 1e31, 9e29, 1e-29, 5e-324, -1.0, 0.0]),
    b"u": ("<I", [0xFFFFFFFF, 0x80000000, 0x7FFFFFFF, 65536, 0]),
    b"b": ("<B", [255, 2, 1, 0]),
    b"t": ("<B", [0, 10, 127, 255]),
}


def records(stream):
    at = 0
    while at < len(stream):
        stored, = struct.unpack_from("<Q", stream, at + 56)
        yield at, stream[at : at + 64], stream[at + 64 : at + 64 + stored]
        at += 64 + (stored + 63) // 64 * 64


def record(head, rows, data):
    head = head[:44] + bytes(4) + struct.pack("<QQ", rows, len(data))
    crc = zlib.crc32(data, zlib.crc32(head))
    return head[:44] + struct.pack("<I", crc) + head[48:] + data + bytes(-len(data) % 64)


def values(head, data):
    """The column with other values: each with its name."""
    form, others = NUMBERS[head[41:42]]
    size = struct.calcsize(form)
    n = len(data) // size
    for x in others + [max(n // head[42] - 1, 0)] * (form == "<I"):
        raw = struct.pack(form, x)
        yield "all are %g" % x, raw * n
        for i in sorted({0, n // 2, n - 1}):
            yield "value %d is %g" % (i, x), data[: i * size] + raw + data[(i + 1) * size :]


def damaged(stream):
    for at, head, data in records(stream):
        rows, = struct.unpack_from("<Q", head, 48)
        layer, name = (head[k : k + w].rstrip(b"\0").decode() for k, w in ((0, 16), (16, 24)))
        if not layer or not rows:
            continue
        row = len(data) // rows
        changes = [(what, rows, other) for what, other in values(head, data)]
        changes += [("%d rows of %d" % (k, rows), k, (data + data)[: k * row]) for k in (0, rows // 2, rows - 1, rows + 1)]
        end = at + 64 + (len(data) + 63) // 64 * 64
        for what, k, other in changes:
            yield "%s of %s: %s" % (name, layer, what), (at, end, head, k, other)


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
    for what, (at, end, head, rows, data) in itertools.islice(damaged(stream), first, None, step):
        other = stream[:at] + record(head, rows, data) + stream[end:]
        open("damaged.mrs", "wb").write(other)
        runs += 1
        told = fault(command[:i] + ["damaged.mrs"] + command[i + 1 :], other)
        if told:
            wrong += 1
            print("%s: %s: %s" % (" ".join(command), what, told))
print("%s: %d runs, %d wrong" % (" ".join(command), runs, wrong))
sys.exit(wrong > 0)
