# Dragging a handle in the page of mr-view, in Chromium without a window, of many frames the median and the fastest,
# drawing not counted: from the pose to base and mesh as mr-decode has them; the normals to draw with; and
# the size of the page.
command -v chromium >/dev/null || { echo "no Chromium: make check-page installs it"; exit 0; }
page_of() { # name, what makes its mesh
	name=$1
	shift
	"$@" | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 |
		mr-solve --basis |
		mr-encode | mr-view -q "$name.html" || exit
	echo "$name-page mr $(($(wc -c <"$name.html") / 1000)) kB"
}
page_of bumpy-35k mr-make bumpy -n 34000
page_of bumpy-150k mr-make bumpy -n 147000
[ ! -f "$DATA/meshes/bunny00.off.gz" ] || page_of bunny00 mr-import "$DATA/meshes/bunny00.off.gz"
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$TOP/tests/page" exec python3 "$TOP/tests/bench/page.py" *.html
