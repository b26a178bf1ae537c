"""Much at once: results are those of little, and memory does not grow.
usage: load.py frames N | pipelines N | operands N | long GIGABYTES | wide BYTES"""
import json, shlex, struct, subprocess, sys, zlib


def output(command, data=b""):
    return subprocess.run(shlex.split(command), input=data, stdout=subprocess.PIPE, check=True).stdout


def fail(text):
    sys.exit(text)


def chain(source, commands):
    """The source's bytes, an iterable, through the commands: what the last one writes, in lines, and the memory each took in bytes."""
    pipe = " | ".join("%s --stats stats%d" % c[::-1] for c in enumerate(commands))
    sh = subprocess.Popen(["sh", "-c", pipe + " >out"], stdin=subprocess.PIPE)
    for piece in source:
        sh.stdin.write(piece)
    sh.stdin.close()
    if sh.wait():
        fail("%s: exit %d" % (pipe, sh.returncode))
    took = [json.loads(open("stats%d" % i).read().split("\n")[-2])["peak_bytes"] for i in range(len(commands))]
    return sum(1 for _ in open("out", "rb")), took


def frames(n):
    """So many frames through a chain that computes, as keys and as deltas."""
    stream = output("mr-make cube -n 8")
    start, frame, end = stream[:64], stream[64:-64], stream[-64:]
    edit = ["mr-smooth -q -t 0.01", "mr-remesh -q -n 1", "mr-cat -z", "mr-transform -s 2", "mr-info --json -l base"]
    posed = output("mr-encode", output("mr-select --free all --fixed below:y,0.3 --handle 1=above:y,0.8", output("mr-smooth -q", output("mr-make sphere -n 200"))))
    for source, commands in (
        (lambda k: (x for x in [start] + [frame] * k + [end]), edit),
        (lambda k: (posed,), ["mr-pose -H 1 --translate 0,0,1 --frames %d", "mr-solve", "mr-decode -q", "mr-info --json -l mesh"]),
    ):
        some, little = chain(source(n // 100), [c.replace("%d", str(n // 100)) for c in commands])
        all, much = chain(source(n), [c.replace("%d", str(n)) for c in commands])
        if all < 100 * (some - 1):
            fail("of %d frames %d come out" % (n, all))
        for command, before, after in zip(commands, little, much):
            print("%s: %d frames: %.1f MB, %d frames: %.1f MB" % (command, n // 100, before / 1e6, n, after / 1e6))
            if after > 1.1 * before + 4e6:  # two large pages
                fail("its memory grows")


def pipelines(n):
    """So many pipes at once."""
    pipe = "mr-make torus -n 100 | mr-smooth -q | mr-remesh -q | mr-export -q -f off -"
    running = [subprocess.Popen(["sh", "-c", pipe], stdout=open("torus%d" % i, "wb")) for i in range(n)]
    failed = sum(p.wait() != 0 for p in running)
    good = subprocess.run(["sh", "-c", pipe], stdout=subprocess.PIPE, check=True).stdout
    other = sum(open("torus%d" % i, "rb").read() != good for i in range(n))
    if failed or other:
        fail("of %d pipes %d fail, %d have another result" % (n, failed, other))


def operands(n):
    open("s", "wb").write(output("mr-make cube -n 8"))
    export = output("mr-export -q -f off -", open("s", "rb").read())
    open("m.off", "wb").write(export)
    for command in "mr-cat" + n * " s", "mr-import" + n * " m.off":
        open("command", "w").write(command + " --stats stats >out")
        if subprocess.run(["sh", "command"]).returncode:
            fail("%s of %d files fails" % (command[:9], n))
        lines = open("stats").read().split("\n")
        if len(lines) != n + 1:
            fail("%s: of %d files %d frames" % (command[:9], n, len(lines) - 1))
        peak = json.loads(lines[-2])["peak_bytes"]
        print("%s: %d files: %.1f MB" % (command[:9], n, peak / 1e6))
        if peak > 20e6:
            fail("its memory grows")


def long(gigabytes):
    """A stream longer than 2^32 bytes, where a bit flips at its end."""
    output("mr-make sphere -n 700000 -o ball.mrs")
    ball = open("ball.mrs", "rb").read()
    times = gigabytes * 10**9 // len(ball) + 1
    _, took = chain((ball for _ in range(times)), ["mr-cat --no-history", "mr-transform -s 2", "mr-cat -o /dev/null"])
    count = open("stats2").read().count("\n")
    if count != times:
        fail("of %d frames %d come out" % (times, count))
    print("%.1f GB, %d frames, %s MB" % (times * len(ball) / 1e9, times, [t // 1000000 for t in took]))
    p = subprocess.Popen(["mr-cat", "--no-history"], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    for _ in range(times):
        p.stdin.write(ball)
    try:
        p.stdin.write(bytes(64))
    except BrokenPipeError:
        pass
    _, err = p.communicate()
    print(err.decode().strip())
    if p.returncode != 1 or b"byte %d" % (times * len(ball)) not in err:
        fail("a wrong record at byte %d: exit %d: %s" % (times * len(ball), p.returncode, err))


def record(layer, name, kind, rows, stored, payload_crc):
    """A header; the checksum of its payload is that of `stored` bytes."""
    head = struct.pack("<16s24s4sIQQ", layer, name, kind, 0, rows, stored)
    return head[:44] + struct.pack("<I", payload_crc(zlib.crc32(head))) + head[48:]


def wide(size):
    """A column of so many bytes, a hole of the file, is passed on, packed and unpacked; so are coordinates of as many."""
    zeros = bytes(1 << 24)

    def crc_of_zeros(n):
        def crc(value):
            for at in range(0, n, len(zeros)):
                value = zlib.crc32(zeros[: min(len(zeros), n - at)], value)
            return value
        return crc

    small = output("mr-make cube -n 8 --points 100")
    start, end = small[:64], small[-64:]
    name = b"key hole".ljust(64, b"\0")
    for layer, column, kind, rows, bytes_each in (b"points", b"marks", b"-b\1\0", size, 1), (b"points", b"position", b"vd\3\0", size // 24, 24):
        stored = rows * bytes_each
        with open("wide.mrs", "wb") as f:
            f.write(start)
            f.write(record(b"", b"FRAME", b"-t\1\0", 8, 8, lambda c: zlib.crc32(name[:8], c)) + name)
            f.write(record(layer, column, kind, rows, stored, crc_of_zeros(stored)))
            f.seek((stored + 63) // 64 * 64, 1)
            f.write(record(b"", b"ENDFRAME", b"-t\1\0", 0, 0, lambda c: c) + end)
        same = "cmp - wide.mrs"
        for command in (
            "mr-cat --no-history wide.mrs | " + same,
            "cat wide.mrs | mr-cat --no-history | " + same,
            "mr-cat --no-history -z wide.mrs >packed.mrs && test $(wc -c <packed.mrs) -lt %d" % (stored // 50),
            "mr-cat --no-history -u packed.mrs | " + same,
        ) + (("mr-transform --translate 1,2,3 --no-history wide.mrs | mr-transform --translate -1,-2,-3 --no-history | " + same,) if kind[:1] == b"v" else ()):
            if subprocess.run(command, shell=True).returncode:
                fail("%s of %d rows: %s" % (column.decode(), rows, command))
        print("%s: %d rows, %.1f GB" % (column.decode(), rows, stored / 1e9))


globals()[sys.argv[1]](int(sys.argv[2]))
