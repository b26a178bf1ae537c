# What the page saves: a script that gives the page's stream the painted regions and a basis of their handles, and a
# file of the regions; nothing of a history or a name is run.
. "$TOP/tests/page/begin"
mr-make bumpy -n 3000 | mr-export -q 'a model.off' || exit
mr-import 'a model.off' | mr-smooth -t 5 | mr-remesh -o base.mrs || exit
mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 base.mrs | mr-solve --basis --rotations linear |
	mr-encode |
	mr-pose -H 1 --rotate 0,0,1,20 | mr-decode -q -o edit.mrs || exit
mr-import 'a model.off' -o plain.mrs || exit
mr-make torus -n 400 | mr-transform --translate 1,2,3 -o shape.mrs || exit
mr-make bumpy --points 2000 | mr-shrinkwrap -q -m cube -r 4 | mr-simplify -q -n 200 -o control.mrs || exit
mr-make bumpy --points 2000 | mr-shrinkwrap -q -m cube -r 4 | mr-simplify -q -n 200 | mr-sample -q -n 2 |
	mr-decode -q -o scan.mrs || exit
python3 - <<'Y'
import struct
from records import END, START, frame, record
with open("evil.mrs", "wb") as f:
	f.write(START + frame(b"key ';touch pwned;'$(touch pwned)",
		record(b"mesh", b"position", b"vd\3", 3, struct.pack("<9d", 0, 0, 0, 1, 0, 0, 0, 1, 0)),
		record(b"mesh", b"triangles", b"fu\3", 1, struct.pack("<3I", 0, 1, 2)),
		record(b"", b"history", data=b"mr 1.0: mr-import '$(touch pwned)'\n")) + END)
Y
for model in base edit plain shape control scan evil; do
	mr-view -q -i $model.mrs $model.html || exit
done
exec python3 "$TOP/tests/page/recipe.py"
