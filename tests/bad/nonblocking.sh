# Pipes that do not block, as one who shares them may have asked for, change nothing.
cat >run.py <<'P'
import os, subprocess
read, write = os.pipe()
os.set_blocking(read, False)
os.set_blocking(write, False)
maker = subprocess.Popen(["mr-make", "torus", "-n", "50000"], stdout=write)
os.close(write)
cat = subprocess.Popen(["mr-cat", "-o", "out.mrs"], stdin=read)
os.close(read)
assert maker.wait() == 0 and cat.wait() == 0
read, write = os.pipe()
os.set_blocking(read, False)
model = subprocess.Popen(["mr-import", "-", "-o", "model.mrs"], stdin=read)
os.close(read)
for part in (b"v 0 0 0\nv 1 0 0\n", b"v 0 1 0\nf 1 2 3\n"):
    os.write(write, part)
    os.sched_yield()
os.close(write)
assert model.wait() == 0
P
python3 run.py || exit
mr-make torus -n 50000 | mr-cat -o straight.mrs
mr-cat --no-history straight.mrs >a
mr-cat --no-history out.mrs >b
cmp a b && mr-info model.mrs | grep -q '3 vertices, 1 faces'
