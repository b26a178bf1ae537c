# mr.stream of lib/python: what the tools write it reads, and what it writes they read; damage never comes out as data.
for python in python3 /usr/bin/python3; do
	$python -c 'import numpy' 2>/dev/null && break
	python=
done
[ -n "$python" ] || { echo 'no Python with numpy'; exit 77; }
PYTHONPATH=$TOP/tests:. PYTHONDONTWRITEBYTECODE=1
export PYTHONPATH PYTHONDONTWRITEBYTECODE
mkdir mr && cp "$TOP/lib/python/mr/stream.py" mr || exit
fail=0
bad() {
	echo "$*"
	fail=1
}

# Models of all kinds of columns; keys, deltas that add, drop and replace, several streams in a row, none.
mr-make bumpy -n 40000 | mr-export colored.ply
mr-import colored.ply >a.mrs
mr-make torus --points 35000 | mr-cat -z >z.mrs
mr-make bumpy -n 800 | mr-select --free all --fixed below:z,0.2 --handle 1=above:z,0.8 >region.mrs
mr-smooth region.mrs | mr-solve | mr-encode >rest.mrs
mr-pose -H 1 --rotate 0,1,0,60 --frames 4 <rest.mrs >pose.mrs
mr-solve <pose.mrs | mr-decode >walk.mrs
mr-cat -z walk.mrs >walkz.mrs
mr-make cube -n 1 | mr-select --handle 1=above:z,0.8 | mr-pose -H 1 --translate 0,0,1 --frames 1 >small.mrs
mr-cat -z small.mrs >smallz.mrs
{ head -c 64 a.mrs && tail -c 64 a.mrs; } >none.mrs
cat none.mrs small.mrs walkz.mrs none.mrs z.mrs none.mrs >all.mrs
sed -n '/^\.\\" begin mrstream.py$/,/^\.\\" end$/p' "$TOP/man/mr-stream.5" | grep -v '^\.' |
    sed 's/\\&//g; s/\\-/-/g; s/\\e/\\/g' >page.py
$python "$TOP/tests/pipe/stream-python.py" || fail=1

# From pipe to pipe it passes what mr-cat passes; the tools find nothing to blame.
echo 'from mr import stream; stream.write("-", stream.read(), history=None)' >pass.py
mr-cat --no-history all.mrs >want
$python pass.py <all.mrs | cmp - want || bad 'a file passes otherwise'
cat all.mrs | $python pass.py | cat >got && cmp want got || bad 'a pipe passes otherwise'
mr-info --check --no-intersections <got >/dev/null || bad 'what passes breaks a law'

# The filter of its first page: positions to the last bit, deltas stay deltas, one line of history more.
sed -n '/^    import sys$/,/^    stream.write/s/^    //p' "mr/stream.py" >scale.py
for file in z walkz; do
	$python scale.py 2 <$file.mrs | $python scale.py 0.5 >twice.mrs || bad "$file: scale.py fails"
	mr-cat -u --no-history $file.mrs | $python pass.py >want
	mr-info twice.mrs | grep -q "mr.stream 1.0: scale.py 0.5" || bad "$file: no line of history"
	for way in want twice.mrs; do
		mr-export "$way-%d.obj" -i $way && cat $way-*.obj >$way.obj
	done
	cmp want.obj twice.mrs.obj || bad "$file: scaled by 2 and by a half, another shape"
done
[ "$(wc -c <twice.mrs)" -le "$(mr-cat -u walkz.mrs | wc -c)" ] || bad 'deltas are sent whole'
mr-make torus -n 900 | $python scale.py 3 | mr-export out.ply && [ -s out.ply ] || bad 'no pipe with scale.py'
(mr-make torus -n 900 | head -c 9000 | $python scale.py 3) 2>err | mr-cat >/dev/null 2>&1 && bad 'a dead stage is not seen'
grep -q 'mr.stream.CutOff: stream ends without END at byte 9000: the previous tool failed' err || bad "cut off: $(cat err)"

# Its other example: a key, and a delta that is the smaller by the triangles and the history.
{ echo 'from mr import stream'; sed -n '/^    frame = stream.Frame/,/^$/s/^    //p' "mr/stream.py"; } >make.py
$python make.py && mr-info --check x.mrs >list || bad 'the example from nothing'
[ "$(grep -c '^triangle: frame ' list)" -eq 2 ] && [ "$(wc -c <x.mrs)" -eq $((64 * (11 + 6 + 1))) ] || bad "from nothing: $(cat list)"
exit $fail
