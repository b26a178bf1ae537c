# Regions from a file, as the page of mr-view saves them: exactly those vertices, of this model alone; malformed ones by their line.
mr-make plane -n 121 -o plane.mrs # 11 by 11
mr-make sphere --points 500 -o points.mrs
cat >selection.py <<'Y'
import records
def head(path, layer="mesh"):
	c, total = records.first_frame(path), 2166136261
	triangles = c.get((layer, "triangles"), ())
	for v in (v for triangle in triangles for v in triangle):
		total = (total ^ v) * 16777619 % 2 ** 32
	return "mr-selection 1 %s %d %d %08x" % (layer, len(c[layer, "position"]), len(triangles), total)
Y
head=$(python3 -c 'from selection import head; print(head("plane.mrs"))')
regions() { # stream: vertices of each region, as ranges
	python3 - "$1" <<'Y'
import records, sys
region = next([r for r, in v] for k, v in records.first_frame(sys.argv[1]).items() if k[1] == "region")
for r in sorted(set(region)):
	print(("fixed", "free")[r] if r < 2 else "handle %d" % (r - 2), *[v for v in range(len(region)) if region[v] == r])
Y
}
counts() {
	mr-select --stats stats.json "$@" -o out.mrs && echo "$*: $(grep -o '"fixed".*[0-9]' stats.json | tr -d '"')"
}

echo '-- exactly those vertices; the order of lines is free, and what is not there keeps its region'
printf '%s # of a plane\n\n# the middle\nhandle 3 60\nfree 0-3 5\t7-9\nfree 100-102\nhandle 65535 120\n' "$head" >some
counts --from some plane.mrs
regions out.mrs
mr-select --free all plane.mrs | counts --from some
mr-select --free all plane.mrs | counts --reset --from some

echo '-- options apply in order'
counts --free all --from some --handle 3=grow:1 plane.mrs
counts --from some --handle 1=rings:60,1 plane.mrs
printf '%s\nfixed 0-120\n' "$head" >all
counts --from some --from all plane.mrs
printf '%s\r\nfixed 0-120\r\n' "$head" >windows
counts --from windows plane.mrs

echo '-- the one in the page of mr-select'
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n' | mr-import -o tetrahedron.mrs
python3 -c 'import re, sys; print(re.search(r"^mr-selection .*\n.*\n.*\n", sys.stdin.read(), re.M).group(), end="")' <"$TOP/man/mr-select.1" >page
counts --from page tetrahedron.mrs
regions out.mrs

echo '-- a pose of the same model, and points'
mr-transform --translate 1,2,3 plane.mrs | counts --from all
printf 'mr-selection 1 points 500 0 811c9dc5\nfree 0-249\n' >cloud
counts --from cloud points.mrs
counts -v --from cloud points.mrs 2>&1

echo '-- of another model, another layer, another topology'
refused() { # options
	mr-select "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(cat err)"
}
refused --from cloud plane.mrs
mr-make plane -n 100 -o small.mrs
refused --from all small.mrs
python3 - <<'Y'
from selection import head
with open("turned", "w") as f:
	f.write(head("plane.mrs")[:-8] + "00000000\nfree 1\n")
Y
refused --from turned plane.mrs
echo '-- malformed'
wrong() { # lines
	printf "$@" >wrong
	refused --from wrong plane.mrs
}
wrong ''
wrong 'free 1\n'
wrong 'mr-selections 1\n'
wrong 'mr-selection\n'
wrong 'mr-selection 2 mesh 121 200 00000000\nfree 1\n'
wrong 'mr-selection 1x mesh 121 200 00000000\nfree 1\n'
wrong 'mr-selection 1\n'
wrong 'mr-selection 1 a-name-of-17-bytes 121 200 00000000\nfree 1\n'
wrong 'mr-selection 1 mesh 121 200\n'
wrong 'mr-selection 1 mesh 121 -1 00000000\n'
wrong 'mr-selection 1 mesh 99999999999999999999 200 00000000\n'
wrong 'mr-selection 1 mesh 121 200 0000000\n'
wrong 'mr-selection 1 mesh 121 200 0000000G\n'
wrong 'mr-selection 1 mesh 121 200 00000000 more\n'
wrong "$head\n"
wrong "$head\n\nfree\n"
wrong "$head\nfre 1\n"
wrong "$head\nfrees 1\n"
wrong "$head\nfree 1 2 x\n"
wrong "$head\nfree 1- 2\n"
wrong "$head\nfree 7-3\n"
wrong "$head\nfree 1-2-3\n"
wrong "$head\nfree 3,4\n"
wrong "$head\nfree -1\n"
wrong "$head\nfree 0x10\n"
wrong "$head\nfree 121\n"
wrong "$head\nfree 5-4294967295\n"
wrong "$head\nfree 99999999999999999999\n"
wrong "$head\nhandle\n"
wrong "$head\nhandle 3\n"
wrong "$head\nhandle x 3\n"
wrong "$head\nhandle -1 3\n"
wrong "$head\nhandle 65536 3\n"
wrong "$head\nfree 1-9\nfixed 0 9\n"
wrong "$head\nfree 4 4\n"
wrong "$head\nfree 1\\0002\n"
wrong "$head\nfree \033[31m1\n"
refused --from absent plane.mrs
refused --from . plane.mrs
refused --from
refused --from= plane.mrs
