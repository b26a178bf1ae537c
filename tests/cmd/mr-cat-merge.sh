# The layers of several streams in one frame, frame by frame.
mr-make torus -n 500 -o mesh.mrs
mr-make torus --points 300 -o points.mrs
mr-make knot -n 400 -o knot.mrs

# The names of frames, layers and columns, and the lines of the history.
list() {
	strings -n 3 "$1" | grep -xE 'key .*|delta .*|mesh|points|position|normal|triangles|DROP|mr 1\.0: .*'
}
mr-cat --merge mesh.mrs points.mrs -o both.mrs
list both.mrs

echo 'one frame goes into all:'
mr-cat --no-history mesh.mrs knot.mrs >two.mrs
mr-cat --merge --no-history two.mrs points.mrs | mr-cat -u --no-history >both.mrs
list both.mrs | grep -v '^mr 1.0'

echo 'what is refused:'
refused() {
	"$@" >out
	echo "exit $?"
	if mr-cat out >/dev/null 2>&1; then
		echo 'bad: whole output'
	fi
}
refused mr-cat --merge mesh.mrs knot.mrs
refused mr-cat --merge points.mrs two.mrs
cat two.mrs knot.mrs >three.mrs
mr-make sphere --points 10 >p.mrs
cat p.mrs p.mrs >p2.mrs
refused mr-cat --merge three.mrs p2.mrs
refused mr-cat --merge points.mrs no-such-file
head -c 200 mesh.mrs >cut.mrs
refused mr-cat --merge points.mrs cut.mrs
