# Wrong command lines, what cannot be packed, and files that are damaged: a sentence, nothing on stdout.
try() {
	"$@" >out 2>err
	echo "$* exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
}
mr-make knot -n 3000 -o mesh.mrs
mr-simplify -q --to control -n 80 mesh.mrs | mr-fit -q | mr-sample -q -n 3 -o s.mrs
mr-pack -q -e 0.01% s.mrs s.mrz

try mr-pack s.mrs
try mr-pack -e 0 s.mrs x.mrz
try mr-pack -e 20% s.mrs x.mrz
try mr-pack -n x s.mrs x.mrz
try mr-pack -n 100 s.mrs x.mrz
try mr-pack mesh.mrs x.mrz
try mr-unpack --level 99 s.mrz
try mr-unpack --bytes 0 s.mrz
try mr-unpack absent.mrz
try mr-unpack mesh.mrs
: >empty
try mr-unpack empty
ls x.mrz 2>&1

# Every beginning, and every byte changed: a surface, or one sentence; never a surface that is taken for whole.
cat >damage.py <<'PY'
import subprocess
whole = open("s.mrz", "rb").read()
ends = {0: 0, 1: 0}
def run(data, quiet=False):
    r = subprocess.run(["mr-unpack"], input=data, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert r.returncode in (0, 1) and r.stderr.count(b"\n") == 1 and r.stderr.startswith(b"mr-unpack: "), r.stderr
    ends[r.returncode] += 1
for n in range(0, len(whole), max(1, len(whole) // 60)):
    run(whole[:n])
print("beginnings: some are surfaces:", ends[0] > 20 and ends[1] > 5)
ends[0] = 0
for i in range(0, len(whole), max(1, len(whole) // 60)):
    run(whole[:i] + bytes([whole[i] ^ 0x10]) + whole[i + 1:])
print("changed bytes that nobody saw:", ends[0])
PY
python3 damage.py
