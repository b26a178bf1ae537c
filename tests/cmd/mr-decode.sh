# The detail on its base, on other bases, exaggerated; posing by the base's response.
compare() { # file, file, tolerance relative to the diagonal: mesh.position of their last frames
	python3 - "$@" <<'END'
import records, sys
a, b = (records.column(path, b'mesh', b'position') for path in sys.argv[1:3])
diagonal = sum((max(a[k::3]) - min(a[k::3])) ** 2 for k in range(3)) ** .5
far = max(map(lambda x, y: abs(x - y), a, b)) / diagonal
print('equal' if len(a) == len(b) and far <= float(sys.argv[3]) else 'differ by %g' % far)
END
}
mr-make bumpy -n 2500 | mr-smooth | mr-remesh -o base.mrs || exit
mr-encode base.mrs -o detail.mrs

echo 'on the base as it was'
mr-decode detail.mrs -o back.mrs
compare base.mrs back.mrs 1e-13
mr-decode --no-history back.mrs >again.mrs # decoding is a function of base and detail alone
mr-decode --no-history detail.mrs | cmp -s - again.mrs || compare back.mrs again.mrs 0

echo 'gains are linear, and 0 is on the base'
for gain in 0 1 3; do
	mr-decode --gain $gain detail.mrs -o gain$gain.mrs
done
python3 - gain0.mrs gain1.mrs gain3.mrs <<'END'
import records, sys
a, b, c = (records.column(path, b'mesh', b'position') for path in sys.argv[1:])
print('ok' if max(abs(x + 3 * (y - x) - z) for x, y, z in zip(a, b, c)) < 1e-13 else 'bad')
END
mr-encode --stats flat.json gain0.mrs -o flat.mrs
sed 's/.*"height_max":\([^,}]*\).*/\1/' flat.json | awk '{ print $1 < 1e-13 ? "ok" : "bad" }'

echo 'by the response: at rest, moved rigidly, as by mr-solve'
mr-select --free all --fixed below:y,0.2 --handle 0=above:y,0.8 base.mrs -o regions.mrs
mr-solve --basis regions.mrs | mr-encode -o basis.mrs || exit
mr-pose basis.mrs | mr-decode -o rest.mrs
compare base.mrs rest.mrs 1e-12
mr-pose --rotate 1,2,3,40 --translate 0.2,0.3,0 basis.mrs -o posed.mrs
mr-decode posed.mrs -o fast.mrs
mr-solve --rotations linear posed.mrs | mr-decode -o slow.mrs
compare fast.mrs slow.mrs 1e-9
mr-info fast.mrs | grep -c 'handles\|response'

mr-select --free all --handle 0=below:y,0.2 --handle 1=above:y,0.8 base.mrs | mr-solve --basis | mr-encode |
    mr-pose --rotate 1,1,0,70 --center 0,0,0 | mr-pose -H 1 --rotate 1,1,0,70 --center 0,0,0 | mr-decode -o turned.mrs
mr-select --free all --handle 0=below:y,0.2 base.mrs | mr-pose --rotate 1,1,0,70 --center 0,0,0 >turn.mrs
python3 - base.mrs turn.mrs turned.mrs <<'END'
import sys
from records import column
p, t = column(sys.argv[1], b'mesh', b'position'), column(sys.argv[2], b'handles', b'transform')
q = column(sys.argv[3], b'mesh', b'position')
far = 0
for i in range(0, len(p), 3):
    for k in range(3):
        x = sum(t[4 * k + j] * p[i + j] for j in range(3)) + t[4 * k + 3]
        far = max(far, abs(x - q[i + k]))
print('rigid motion:', 'ok' if far < 1e-8 else far)
END

echo 'an animation is its poses one by one'
mr-pose --rotate 1,2,3,40 --frames 4 basis.mrs | mr-decode -o film.mrs
mr-pose --rotate 1,2,3,40 basis.mrs | mr-decode -o last.mrs
compare film.mrs last.mrs 0
mr-pose --rotate 1,2,3,40 --frames 4 basis.mrs | mr-decode -j 1 | cmp - film.mrs && echo same

echo 'a turn that is too far for a response, said once for an animation'
mr-pose --rotate 1,2,3,240 --frames 8 basis.mrs | mr-decode 2>&1 >far.mrs | grep response
mr-pose --rotate 1,2,3,60 basis.mrs | mr-decode 2>&1 >far.mrs | grep response
mr-pose --rotate 1,2,3,240 --frames 8 basis.mrs | mr-solve | mr-decode 2>&1 >far.mrs | grep response


echo 'two handles turn against each other beside a part that is fixed; each against what is fixed between them'
mr-transform --translate 6,0,0 base.mrs | mr-cat --append base.mrs - |
	mr-select --free all --handle 0=below:y,0.2 --handle 1=above:y,0.8 --fixed above:x,0.6 | mr-solve --basis | mr-encode -o beside.mrs
mr-select --free all --handle 0=below:y,0.2 --handle 1=above:y,0.8 base.mrs |
	mr-select --fixed above:y,0.4+below:y,0.6 | mr-solve --basis | mr-encode -o between.mrs
for file in beside between; do
	mr-pose -H 1 --rotate 0,1,0,59 $file.mrs | mr-pose -H 0 --rotate 0,1,0,-59 | mr-decode 2>&1 >far.mrs | grep response
	echo $file
done

echo 'parts that touch, held at one end and bent at the other, and then let come apart'
mr-make cylinder -n 600 | mr-export -f off - | awk '
	NR == 2 { n = $1; print 2 * $1, 2 * $2, 0; next }
	NR == 1 { print; next }
	NR <= n + 2 { a[NR] = $1 " " $2 " " $3 + 3.999; print; next }
	{ if (!shown++) for (i = 3; i <= n + 2; i++) print a[i]; print; f[++m] = 3 " " $2 + n " " $3 + n " " $4 + n }
	END { for (i = 1; i <= m; i++) print f[i] }' >rods.off
mr-import rods.off | mr-smooth -t 0 | mr-encode | mr-select --free all --fixed below:z,0.1 --handle 0=above:z,0.9 |
    mr-pose --rotate 1,0,0,60 --frames 4 -o rods.mrs
mr-solve rods.mrs | mr-decode -o held.mrs
mr-solve --apart rods.mrs | mr-decode --stats gaps.json -o apart.mrs
grep -o '"apart":[0-9]*' gaps.json

echo 'little harm is a note, much a warning, none is nothing'
mr-make torus -n 1500 | mr-smooth | mr-remesh | mr-select --reset --free all --fixed below:y,0.4 --handle 0=above:y,0.6 |
	mr-encode -o torus.mrs
for angle in 40 75 150; do
	mr-pose --rotate 1,0,0,$angle torus.mrs | mr-solve | mr-decode -v -o out.mrs 2>&1 | sed -n 's/[0-9]*//g; s/, most.*//; /folded/p'
	echo $angle
done

echo 'harm to a displaced surface'
mr-make torus --points 3000 | mr-shrinkwrap | mr-simplify | mr-fit | mr-sample |
	mr-select --reset --free all --fixed below:y,0.4 --handle 0=above:y,0.6 -o scan.mrs
for angle in 60 110; do
	mr-pose --rotate 1,0,0,$angle scan.mrs | mr-solve | mr-decode -o posed.mrs 2>&1 | sed -n 's/[0-9]*//g; s/, most.*//; /folded/p'
	echo $angle
done
mr-decode posed.mrs -o out.mrs 2>&1 | sed -n 's/[0-9]*//g; s/, most.*//; /folded/p'

echo 'fixed vertices and handles that base is too coarse to hold, and one that is fine enough'
for ratio in 1.5 0.3; do
	echo $ratio >&2
	mr-make sphere -n 42 | mr-smooth -t 0 | mr-remesh --ratio $ratio | mr-encode -q |
	    mr-select --free all --fixed below:z,0.1 --handle 0=above:z,0.7 | mr-pose --rotate 1,0,0,70 | mr-solve | mr-decode -o ball.mrs
done

echo '-- sheets that pass through each other without a fold, in one pose and in the last frame of a sequence'
mr-make cylinder -n 1500 -o body.mrs
mr-transform --scale 1.03,1.03,0.6 body.mrs | mr-cat --append body.mrs - | mr-smooth | mr-remesh |
	mr-select --free all --fixed below:z,0.2 --handle 1=above:z,0.8 | mr-encode -o sheets.mrs
for frames in 0 7; do
	mr-pose -H 1 --rotate 1,0,0,80 --frames $frames sheets.mrs | mr-solve | mr-decode --stats sheets.json -o out.mrs 2>&1 |
		sed 's/^.*frame/frame/; s/, most.*//'
	grep -c '"far_intersections"' sheets.json
done
mr-info out.mrs | grep -c handles

echo 'refusals'
refused() {
	mr-decode "$@" >out
	echo "exit $?, $(wc -c <out) bytes"
}
refused base.mrs
mr-pose regions.mrs | mr-encode -o lost.mrs
refused lost.mrs
refused --gain x detail.mrs
mr-make sphere -n 42 -o sphere.mrs
refused sphere.mrs

echo '-- a second pose begins where the first has ended'
mr-make bumpy -n 2000 | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.5 --handle 1=above:y,0.85 | mr-encode |
	mr-pose -H 1 --rotate 0,0,1,30 | mr-solve | mr-decode -o bent.mrs
mr-pose -H 1 --rotate 0,0,1,10 bent.mrs | mr-solve | mr-decode -o further.mrs
mr-decode bent.mrs -o again.mrs && mr-compare -a mesh -b mesh bent.mrs again.mrs --json | grep -o '"vertex_max":[^,]*'


echo '-- what it holds is judged from there, with what the first has bent fixed in the second; by mr-solve or a response'
mr-make bumpy -n 2500 | mr-smooth | mr-remesh -r 3 | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 | mr-encode |
	mr-pose -H 1 --rotate 0,0,1,60 | mr-solve -k 1 | mr-decode -q -o bent.mrs
mr-select --reset --free all --fixed below:y,0.5 --handle 1=above:y,0.85 bent.mrs -o again.mrs
mr-pose -H 1 --rotate 1,0,0,50 again.mrs | mr-solve -k 1 -o solved.mrs
mr-info solved.mrs | grep -c ' before '
mr-decode solved.mrs 2>&1 >twice.mrs | sed 's/.*warning: //; s/: base is.*//'
mr-info twice.mrs | grep -c ' before '
mr-transform --translate 1,2,3 --scale 2 solved.mrs | mr-decode 2>&1 >out.mrs | sed 's/.*warning: //; s/: base is.*//'
mr-solve --basis -k 1 again.mrs | mr-pose -H 1 --rotate 1,0,0,50 | mr-decode 2>&1 >out.mrs | sed 's/.*warning: //; s/: base is.*//'

echo '-- heights keep their length where a handle scales'
mr-make bumpy -n 2000 | mr-smooth | mr-remesh | mr-encode | mr-select --free all --fixed below:y,0.2 --handle 0=above:y,0.8 |
	mr-pose --scale 2 | mr-solve | mr-decode 2>&1 >out.mrs | sed 's/.*warning: //'

echo '-- straight edges from end to end do not bend: they are to be split first'
awk 'BEGIN { print "OFF\n16 28 0"; for (z = 0; z < 2; z++) for (i = 0; i < 8; i++) print cos(0.785398 * i), sin(0.785398 * i), 10 * z
	for (i = 0; i < 8; i++) { j = (i + 1) % 8; print 3, i, j, j + 8; print 3, i, j + 8, i + 8 }
	for (i = 1; i < 7; i++) { print 3, 0, i + 1, i; print 3, 8, 8 + i, 9 + i } }' >rod.off
mr-import rod.off -o rod.mrs
mr-subdivide -q --longest 1.5 rod.mrs -o split.mrs
for rod in rod split; do
	mr-smooth -q $rod.mrs | mr-remesh -q -L 1 | mr-encode | mr-select --free all --fixed below:z,0.2 --handle 1=above:z,0.8 |
		mr-pose -H 1 --rotate 1,0,0,60 | mr-solve | mr-decode --stats stats.json -o out.mrs
	grep -o '"long_edges":[0-9]*' stats.json
done

echo '-- a vertex that no face has goes with the surface, though it is fixed'
mr-make bumpy -n 2000 | mr-export -f off - | awk 'NR == 2 { n = $1; $1++ } NR == n + 2 { print; print "0 2.5 0"; next } { print }' >above.off
mr-import above.off | mr-smooth | mr-select --free all --fixed below:y,0.3 --handle 0=above:y,0.7 --fixed sphere:0,2.5,0,0.1 |
    mr-encode | mr-pose --rotate 1,0,0,60 | mr-solve | mr-decode 2>&1 >out.mrs | grep -o '1 constrained.*'

echo 'a lid that is lifted: the middles of its edges go with it' >&2
mr-make cube -n 8 -o low.mrs
mr-transform -t 0,0,2 low.mrs | mr-cat --append low.mrs - | mr-smooth -t 0 | mr-select --fixed part:1 --handle 0=part:2 | mr-encode |
	mr-pose -t 0,0,3 | mr-solve --apart | mr-decode | mr-compare -a base -b mesh | grep -c 'vertex max 0,'
echo 'a bar of twelve faces, none of whose vertices is free' >&2
mr-transform -s 1,1,12 low.mrs | tee bar.mrs | mr-smooth -t 0 | mr-select --free all --fixed below:z,0.2 --handle 0=above:z,0.8 |
	mr-encode | mr-pose -r 0,0,1,180 | mr-solve | mr-decode >/dev/null
echo 'a thin double wall that is bent: the walls pass through each other at a small angle' >&2
awk 'BEGIN { n = 40; m = 20; print "OFF\n" 2 * n * (m + 1), 4 * n * m + 2 * n, 0
	for (k = 0; k < 2; k++) for (j = 0; j <= m; j++) for (i = 0; i < n; i++) { a = 6.283185307 * i / n; r = k ? 0.47 : 0.5; print r * cos(a), r * sin(a), 5 * j / m }
	for (k = 0; k < 2; k++) for (j = 0; j < m; j++) for (i = 0; i < n; i++) { a = k * n * (m + 1) + j * n + i; b = k * n * (m + 1) + j * n + (i + 1) % n
		if (k) { print 3, a, b + n, b; print 3, a, a + n, b + n } else { print 3, a, b, b + n; print 3, a, b + n, a + n } }
	for (i = 0; i < n; i++) { a = i; b = (i + 1) % n; c = n * (m + 1); print 3, a, a + c, b + c; print 3, a, b + c, b } }' >tube.off
mr-smooth -q tube.off | mr-remesh -q | mr-select --free all --fixed below:z,0.2 --handle 0=above:z,0.8 | mr-encode | mr-pose -r 1,0,0,90 | mr-solve -q | mr-decode -o out.mrs
