# What holds of every stream that a tool passes on: sequences, ends, full disks, closed pipes, damage.
fail=0
bad() {
	echo "$*"
	fail=1
}
one_sentence() {
	[ "$(wc -l <err)" -eq 1 ] && grep -q '^mr-[a-z]*: .' err
}

mr-make bumpy -n 3000 >a.mrs
mr-make torus --points 700 | mr-cat -z >b.mrs
mr-cat </dev/null >empty.out 2>err
[ $? -eq 1 ] && one_sentence && grep -q 'stream ends without END at byte 0: the previous tool failed' err ||
    bad "empty input: $(cat err)"
mr-cat empty.out >/dev/null 2>&1 && bad 'empty input makes a stream'

# A stream of no frames is one, alone and among others.
head -c 64 a.mrs >none.mrs
tail -c 64 a.mrs >>none.mrs
mr-cat none.mrs | cmp - none.mrs || bad 'a stream of no frames does not pass'
cat none.mrs a.mrs none.mrs b.mrs none.mrs | mr-cat --no-history >all.mrs || bad 'streams in a row do not pass'
mr-cat --no-history a.mrs b.mrs | cmp - all.mrs || bad 'cat and mr-cat differ'
{ mr-cat --no-history a.mrs && mr-cat --no-history b.mrs; } | mr-cat --no-history | cmp - all.mrs || bad 'one by one: differs'

# A stream is read from where its descriptor stands, aligned or not.
{ dd bs=64 count=1 of=/dev/null 2>/dev/null; mr-cat --no-history; } <none.mrs >mid.out 2>err
[ $? -eq 1 ] && grep -q 'byte 64' err || bad "a place within a file is not counted: $(cat err)"
printf 'abc' | cat - a.mrs >shifted
{ dd bs=3 count=1 of=/dev/null 2>/dev/null; mr-cat --no-history; } <shifted | cmp - a.mrs || bad 'a shifted stream differs'
{ mr-cat --no-history | cmp - a.mrs; mr-cat; } <a.mrs >out 2>err
[ $? -eq 1 ] && [ ! -s out ] && grep -q 'without END' err || bad 'a file is read twice through one descriptor'

# Cut anywhere, from a file or a pipe: exit 1, one sentence, no END.
size=$(wc -c <a.mrs)
for bytes in 1 63 64 65 128 1000 $((size / 2)) $((size - 65)) $((size - 64)) $((size - 1)); do
	head -c "$bytes" a.mrs >cut.mrs
	for way in file pipe; do
		if [ $way = file ]; then mr-cat cut.mrs; else cat cut.mrs | mr-cat; fi >out 2>err
		[ $? -eq 1 ] || bad "cut at $bytes, $way: no failure"
		one_sentence && grep -q 'stream ends without END' err || bad "cut at $bytes, $way: $(cat err)"
		mr-cat out >/dev/null 2>&1 && bad "cut at $bytes, $way: a whole stream comes out"
	done
	cat b.mrs cut.mrs | mr-cat 2>/dev/null | mr-cat >/dev/null 2>&1 && bad "cut at $bytes behind a whole one: passes"
done
cat a.mrs | { cat; printf 'more'; } | mr-cat >out 2>err && bad 'bytes behind END pass'
one_sentence && grep -q "byte $size: this is not a stream" err || bad "bytes behind END: $(cat err)"

# The dead stage fails the pipe, without pipefail.
{ head -c 5000 a.mrs; false; } | mr-cat 2>/dev/null | mr-cat 2>/dev/null | mr-cat >out 2>err && bad 'a dead stage is not seen'

# Damage stops at the first tool, whether or not it looks at the column.
refuse() { # FILE WHAT
	for way in mr-cat 'mr-cat -z' 'mr-normals -l points' mr-info 'mr-info -l points' 'mr-export -f ply -' 'mr-render -' 'mr-view -'; do
		$way <"$1" >out 2>err
		[ $? -eq 1 ] && one_sentence && grep -q "stdin: byte .*: .*$2" err || bad "$way: $1: $(cat err)"
		mr-cat out >/dev/null 2>&1 && bad "$way: $1: a whole stream comes out"
	done
}
for at in 2000 $((size / 2 + 1000)); do
	cp a.mrs damaged.mrs
	printf '\377' | dd of=damaged.mrs bs=1 seek=$at conv=notrunc 2>/dev/null
	refuse damaged.mrs checksum
done

# So does a bit of a column's name: without its triangles a mesh would be a cloud.
mr-make cube -n 8 -o cube.mrs
python3 - <<'END'
stream = open("cube.mrs", "rb").read()
for bit in range(8):
    name = bytearray(stream)
    name[stream.index(b"triangles")] ^= 1 << bit
    open("bit%d.mrs" % bit, "wb").write(name)
END
for bit in 0 1 2 3 4 5 6 7; do
	refuse bit$bit.mrs ''
done

# Full disk, closed pipe, closed stdout.
mr-cat a.mrs >/dev/full 2>err
[ $? -eq 1 ] && one_sentence && grep -q 'No space left' err || bad "full disk: $(cat err)"
{ mr-cat a.mrs a.mrs a.mrs a.mrs; echo $? >code; } 2>err | head -c 1 >/dev/null
[ "$(cat code)" -eq 141 ] && [ ! -s err ] || bad "closed pipe: exit $(cat code): $(cat err)"
mr-cat a.mrs >&- 2>err && bad 'closed stdout is not seen'

# All of the input is read, also by who needs none of it.
{ cat a.mrs a.mrs a.mrs a.mrs; echo $? >code; } | mr-cat >/dev/null
[ "$(cat code)" -eq 0 ] || bad 'the input is not drained'
exit $fail
