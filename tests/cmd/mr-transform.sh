# Moving, turning, scaling; a frame moved as a whole is the frame of the model moved.
where() { # the box
	mr-info "$@" | sed -n 's/^    box *//p' | sed 's/, diagonal.*//'
}
mr-make boxes --genus 1 -n 60 -o model.mrs
where model.mrs
for how in '--translate 1,2,3' '--rotate 0,0,2,90' '--scale 2' '--scale 1,2,3' '--scale -1,1,1' '--up y:z' '--up z:y' '--up -x:x' \
    '--up y:y' '--translate 5,5,5 --center' '--unit' '--scale 1,4,2 --unit --translate 0,0,1' '--translate 1,0,0 --scale 2' \
    '--scale 2 --translate 1,0,0' '--matrix 0,-1,0,7,1,0,0,0,0,0,1,0'; do
	mr-transform $how model.mrs -o moved.mrs
	echo "$how: $(where moved.mrs)"
	mr-info moved.mrs | grep -o 'volume [0-9.-]*'
done
printf '1 0 0 1\n0 1 0 0 # a row\n0 0 -1 0\n0 0 0 1\n' >matrix
mr-transform --matrix matrix --stats - model.mrs 2>stats | where
grep -o '"m11.*' stats

echo 'what is forth and back is where it was'
mr-transform --up y:z model.mrs | mr-transform --up z:y --no-history | mr-export there.off
mr-export here.off <model.mrs
cmp there.off here.off && echo same

echo 'everything in a frame goes alike'
mr-make bumpy -n 1500 | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.3 --handle 1=above:y,0.8 |
    mr-encode -o rest.mrs
mr-pose -H 1 --rotate 1,2,3,100 --scale 1.2 --translate 0.1,0.2,0.1 rest.mrs -o posed.mrs
mr-solve -q posed.mrs -o solved.mrs
mr-make bumpy --points 300 >points.mrs
mr-make bumpy -n 1500 | mr-simplify --to control -n 300 | mr-sample -n 1 -o levels.mrs
near() { # what, two streams: vertex by vertex
	mr-compare -a mesh -b mesh --json "$3" <"$2" | python3 -c '
import json, sys
d = json.load(sys.stdin)["vertex_max_relative"]
print(sys.argv[1], "near" if d < 1e-9 else d)' "$1"
}
for how in '--rotate 1,2,3,40 --translate 3,2,1' '--scale 3' '--scale -2 --up x:y' '--scale 1,1,-1'; do
	for stage in rest solved; do
		mr-transform $how $stage.mrs | mr-decode -q -o early.mrs
		mr-decode -q $stage.mrs | mr-transform $how -o late.mrs
		near "$how, $stage:" early.mrs late.mrs
	done
done
for how in '--rotate 1,2,3,40 --translate 3,2,1' '--scale 3'; do
	mr-transform $how levels.mrs | mr-decode -o early.mrs
	mr-decode levels.mrs | mr-transform $how -o late.mrs
	near "$how, heights:" early.mrs late.mrs
done

echo 'one layer alone'
mr-cat --merge model.mrs points.mrs | mr-transform -l points --translate 9,9,9 | where
mr-transform -l mesh --translate 1,0,0 rest.mrs | mr-info | grep -c detail

echo 'normals'
mr-make sphere --points 2000 | mr-transform --scale 1,1,-3 | mr-export - -f ply-ascii |
    awk 'body && n < 400 { n++; x = $1 * $4 + $2 * $5 + $3 * $6 / 9 * 3; r = sqrt($4^2 + $5^2 + $6^2)
	c = ($1 * $4 + $2 * $5 + $3 * $6 / 9) / r / sqrt($1^2 + $2^2 + $3^2 / 81); if (c < 0.99) bad++ }
	/end_header/ { body = 1 } END { print n, "normals,", bad + 0, "not at right angles and outward" }'

echo 'refusals'
refused() {
	mr-transform "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
}
refused model.mrs
refused --scale 0 model.mrs
refused --scale 1,2 model.mrs
refused --rotate 0,0,0,10 model.mrs
refused --up y model.mrs
refused --up w:z model.mrs
refused --matrix 1,2,3 model.mrs
refused --matrix 1,0,0,0,1,0,0,0,0,0,0,0 model.mrs
refused --matrix 1,0,0,0,0,1,0,0,0,0,1,0,0,0,1,1 model.mrs
refused --matrix absent model.mrs
echo '1 0 0 x' >words
refused --matrix words model.mrs
refused --scale 1e300 --scale 1e300 model.mrs
refused --scale 1,2,1 rest.mrs
refused --scale 1,2,1 levels.mrs
refused --scale -1 levels.mrs
refused --scale 2 posed.mrs
mr-decode -q solved.mrs | mr-transform -q -l base --scale 2 | mr-info | grep -c '^  base'
refused -l nowhere --scale 2 model.mrs

echo 'scales far from 1: normals and spacing follow'
mr-make sphere -n 200 | mr-normals | mr-select --free all --handle 0=above:y,0.8 -o turned.mrs
mr-make sphere --points 300 | mr-shrinkwrap -q -o wrap.mrs
there_and_back() { # there, back, stream
	mr-transform --scale "$1" "$3" | mr-transform --scale "$2" -o back.mrs
	python3 - "$1" "$3" <<'END'
import sys
from records import first_frame
a, b = ({key: rows for key, rows in first_frame(path).items() if key[0]} for path in (sys.argv[2], "back.mrs"))
assert a.keys() == b.keys() and len(a) >= 4
print(float(sys.argv[1]).hex(), [name for layer, name in a if a[layer, name] != b[layer, name]] or "the same")
END
}
for stream in turned.mrs wrap.mrs; do
	there_and_back 4.909093465297727e-91 2.037035976334486e+90 $stream
	there_and_back 2.037035976334486e+90 4.909093465297727e-91 $stream
done
echo 'a sequence moves on about the place of its key frame'
mr-make sphere -n 200 | mr-transform --translate 5,0,0 | mr-smooth | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 |
    mr-encode | mr-pose -H 1 --frames 2 --translate 0,2,0 | mr-solve | mr-decode -q -o moves.mrs
mr-transform --unit moves.mrs | mr-info -l mesh | grep box

mr-make cube -n 8 | mr-transform -m nan,0,0,0,0,1,0,0,0,0,1,0 >out
echo "exit $?"
echo 'what keeps detail from following is left behind with -l mesh'
mr-make torus -n 300 | mr-smooth | mr-encode | mr-decode -o encoded.mrs
mr-transform -l mesh --scale 1,2,1 encoded.mrs | mr-export -l mesh stretched.off
mr-make torus -n 300 | mr-transform --scale 1,2,1 | mr-export same.off
mr-compare stretched.off same.off | awk '/vertex max/ { print ($4 + 0 < 1e-12 ? "same" : $4) }'
echo 'pictures of heights keep their size, and that is told; the range does not'
mr-make sphere -n 60 | mr-simplify --to control -n 40 | mr-sample -q -n 1 | mr-map -w relief -o mapped.mrs
for change in '--scale 2' '--rotate 1,2,3,40' '-l mesh --scale 2'; do
	mr-transform $change mapped.mrs 2>&1 >out.mrs | grep -o 'the pictures.*'
done
mr-transform -q --scale 2 mapped.mrs -o out.mrs
python3 - mapped.mrs out.mrs <<'END'
import records, sys
one, two = (records.column(path, b"displacement", b"range") for path in sys.argv[1:])
print("range", "twice" if two == (2 * one[0], 2 * one[1]) else (one, two))
END
