# The programs in mr-stream(5) work as they stand there, and the hexadecimal stream is one.
fail=0
bad() {
	echo "$*"
	fail=1
}

# What stands in the page between its marks, as a reader sees it.
extract() {
	sed -n "/^\.\\\\\" begin $1\$/,/^\.\\\\\" end\$/p" "$TOP/man/mr-stream.5" | grep -v '^\.' |
	    sed 's/\\&//g; s/\\-/-/g; s/\\e/\\/g' >"$1"
	[ -s "$1" ] || bad "the page holds no $1"
}
extract triangle.hex
extract mirror.c
extract mrstream.py
${CC:-cc} -std=c11 -Wall -Wextra -Wconversion -Werror -O1 -o mirror mirror.c -lz || bad 'mirror.c does not compile'

# The triangle: written by the page's program, by the tools, and as it is printed.
cat >triangle.py <<'END'
import struct, sys
from mrstream import write
p, t = struct.pack("<9d", 0, 0, 0, 1, 0, 0, 0, 1, 0), struct.pack("<3I", 0, 1, 2)
write(sys.stdout.buffer, [(b"triangle", {
    (b"mesh", b"position"): ((b"v", b"d", 3), 3, p),
    (b"mesh", b"triangles"): ((b"f", b"u", 3), 1, t)})])
END
python3 triangle.py >triangle.mrs || bad 'mrstream.py does not write'
od -A x -t x1z triangle.mrs | cmp - triangle.hex || bad 'the page shows another stream'
mr-cat --no-history triangle.mrs | cmp - triangle.mrs || bad 'mr-cat reads another stream'
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >triangle.off
mr-import --no-history triangle.off | cmp - triangle.mrs || bad 'mr-import writes another stream'

# Keys and deltas: a delta of positions; one that drops the triangles and a whole layer; one that drops what is left
# of a layer behind a column of it that it sends.
cat >deltas.py <<'END'
import struct, sys
from mrstream import record
def frame(text, *records):
    return record(b"", b"FRAME", rows=len(text), data=text) + b"".join(records) + record(b"", b"ENDFRAME")
def drop(layer, name):
    return record(layer, b"DROP", rows=len(name), data=name)
def position(layer, n):
    return record(layer, b"position", (b"v", b"d", 3), n, struct.pack("<%dd" % (3 * n), *range(3 * n)))
triangles = record(b"mesh", b"triangles", (b"f", b"u", 3), 1, struct.pack("<3I", 0, 1, 2))
sys.stdout.buffer.write(record(b"mrmesh1\n", b"START")
    + frame(b"key walk", position(b"mesh", 3), triangles, position(b"base", 5))
    + frame(b"delta walk", position(b"mesh", 3))
    + frame(b"delta walk", drop(b"mesh", b"triangles"), drop(b"base", b""), position(b"base", 2), position(b"points", 40000))
    + frame(b"delta walk")
    + frame(b"delta walk", triangles)
    + frame(b"delta walk", position(b"mesh", 4), drop(b"mesh", b"")) + record(b"", b"END"))
END
python3 deltas.py >deltas.mrs
mr-cat --no-history deltas.mrs >read.mrs || bad 'mr-cat reads no deltas'
python3 mrstream.py <deltas.mrs >whole.mrs && python3 mrstream.py <read.mrs | cmp - whole.mrs || bad 'deltas: other values'
mr-cat -z --no-history deltas.mrs >packed.mrs || bad 'mr-cat packs no deltas'
[ "$(wc -c <packed.mrs)" -lt "$(wc -c <deltas.mrs)" ] || bad 'nothing is packed'
python3 mrstream.py <packed.mrs | cmp - whole.mrs || bad 'packed: other values'
mr-cat --no-history whole.mrs | cmp - whole.mrs || bad 'what mrstream.py writes is read as something else'

# Real columns of all types, several streams, one of them packed.
mr-make bumpy -n 2000 >a.mrs
{ cat a.mrs; mr-make torus --points 35000 | mr-cat -z; } >b.mrs
python3 mrstream.py <b.mrs >whole.mrs || bad 'mrstream.py fails'
mr-cat -u --no-history b.mrs | cmp - whole.mrs || bad 'mrstream.py and mr-cat -u differ'

# The filter: twice is not at all; the frames keep their deltas; packed, damaged, cut and empty input are refused.
./mirror <deltas.mrs >m.mrs || bad 'mirror fails'
cmp -s m.mrs deltas.mrs && bad 'mirror does nothing'
mr-cat -z m.mrs >/dev/null || bad 'mirror writes no stream'
./mirror <m.mrs | cmp - deltas.mrs || bad 'mirrored twice, another stream'
python3 mrstream.py <m.mrs >mw.mrs && python3 mrstream.py <deltas.mrs | ./mirror | cmp - mw.mrs || bad 'a delta is mirrored otherwise'
./mirror <packed.mrs >/dev/null 2>&1 && mr-cat <packed.mrs | ./mirror >/dev/null 2>&1 && bad 'mirror takes packed positions'
printf x | dd of=m.mrs bs=1 seek=300 conv=notrunc 2>/dev/null
./mirror <m.mrs >/dev/null 2>&1 && bad 'mirror takes damaged positions'
for bytes in 0 64 100 200 640; do
	head -c $bytes deltas.mrs | ./mirror >cut.mrs && bad "mirror takes $bytes bytes for a stream"
	mr-cat cut.mrs >/dev/null 2>&1 && bad "mirror makes a stream of $bytes bytes"
	head -c $bytes deltas.mrs | python3 mrstream.py >cut.mrs 2>err && bad "mrstream.py takes $bytes bytes for a stream"
	[ "$(wc -l <err)" -eq 1 ] || bad "mrstream.py says of $bytes bytes: $(cat err)"
	mr-cat cut.mrs >/dev/null 2>&1 && bad "mrstream.py makes a stream of $bytes bytes"
done
exit $fail
