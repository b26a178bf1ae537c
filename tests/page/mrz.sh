# The decoder for other people's pages gives what mr-unpack and mr-decode give, to the bit, whole and cut off; what is
# damaged is a sentence.  At most 40 kB, packed.
command -v node >/dev/null || { echo "node is not here"; exit 77; }
web=$BUILD/web
size=$(cat "$web/mrz.js" "$web/mrz.wasm" | gzip -9c | wc -c)
[ "$size" -le 40000 ] || { echo "the loader takes $size bytes"; exit 1; }

pack() { # name, error: of a mesh on stdin
	mr-simplify -q --to control -n 80 | mr-fit -q | mr-sample -q -n 3 | mr-pack -q -e "$2" - "$1.mrz"
}
mr-make knot -n 3000 | pack closed 0.05%
mr-make plane -n 900 | pack open 0.1%
mr-make cube -n 3000 | pack creased 0.1%
mr-make torus -n 3000 >torus.mrs
cat >color.py <<'PY'
import sys
from records import numbers, read, record
for layer, name, shape, rows, data in read(sys.stdin.buffer.read()):
    sys.stdout.buffer.write(record(layer, name, shape, rows, data))
    if name == b"position":
        p = numbers(shape, data)
        c = bytes(255 if i % 4 == 3 else int(127 + 60 * p[i // 4 * 3 + i % 4]) for i in range(4 * rows))
        sys.stdout.buffer.write(record(layer, b"color", b"vb\4", rows, c))
PY
PYTHONPATH=$TOP/tests PYTHONDONTWRITEBYTECODE=1
export PYTHONPATH PYTHONDONTWRITEBYTECODE
python3 color.py <torus.mrs | pack colored 0.05%

expected() { # file, level: positions, triangles and colours, in bytes
	mr-unpack -q --level "$2" "$1" | mr-decode -q >d.mrs
	python3 - <<'PY'
import records
columns = {(layer, name): data for layer, name, _, _, data in records.read(open("d.mrs", "rb").read())}
with open("want", "wb") as out:
    for name in b"position", b"triangles", b"color":
        out.write(columns.get((b"mesh", name), b""))
PY
}
cat >decode.mjs <<'JS'
import fs from "fs";
const [web, file, level] = process.argv.slice(2);
const { Mrz } = await import(`${web}/mrz.js`);
const mrz = await Mrz.load(fs.readFileSync(`${web}/mrz.wasm`));
try {
	const surface = mrz.open(fs.readFileSync(file));
	const m = surface.mesh(Number(level));
	const arrays = [m.positions, m.triangles, ...(m.colors ? [m.colors] : [])];
	fs.writeFileSync("got", Buffer.concat(arrays.map((a) => Buffer.from(a.buffer))));
	surface.close();
} catch (e) {
	console.log(e.message);
}
JS
cp "$web/mrz.js" "$web/mrz.wasm" . && echo '{"type":"module"}' >package.json
fail=0
same() { # file, level
	rm -f got
	expected "$1" "$2"
	node decode.mjs "$PWD" "$1" "$2"
	cmp -s got want || { echo "$1, level $2: other bytes"; fail=1; }
}
for name in closed open creased colored; do
	[ -e $name.mrz ] || { echo "$name: not packed"; fail=1; continue; }
	for level in 0 1 2 3; do same $name.mrz $level; done
done
for name in closed colored; do
	head -c $(($(wc -c <$name.mrz) - 40)) $name.mrz >$name-cut.mrz
	same $name-cut.mrz 3
done
says() { # file, level, sentence
	said=$(node decode.mjs "$PWD" "$1" "$2")
	[ "$said" = "$3" ] || { echo "$1: $said"; fail=1; }
}
head -c 100 closed.mrz >short.mrz
{ head -c 60 closed.mrz; printf x; tail -c +62 closed.mrz; } >damaged.mrz
says short.mrz 0 'it ends before its control mesh'
says damaged.mrz 0 'its control mesh is damaged'
says closed.mrz 4 'there is no level 4: the finest is 3'
exit $fail
