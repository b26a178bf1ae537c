# Vertices without a face, as scans have them: all tools pass, and a pose at rest returns them where they were.
mr-make bumpy -n 2000 | mr-export -f off - | awk 'NR == 2 { $1 += 3 } NR == 3 { print "0.9 0.9 0.9\n0 0 0\n0.3 -1 0.4" }
	NR > 2 && $1 == 3 && NF == 4 { for (k = 2; k <= 4; k++) $k += 3 } { print }' >scan.off
mr-import scan.off -o scan.mrs
mr-info scan.mrs | grep -o 'isolated vertices [0-9]*'
mr-smooth -t 5 -v scan.mrs -o smooth.mrs
mr-remesh smooth.mrs -o remeshed.mrs
for base in smooth remeshed; do
	mr-select --free all --fixed below:x,0.2 --handle 0=above:x,0.8 $base.mrs | mr-encode | mr-pose | mr-solve |
		mr-decode -o back.mrs
	mr-info --check back.mrs >/dev/null && echo "$base: lawful"
	mr-export -f off - <back.mrs | paste - scan.off | awk 'NR > 2 && NF == 6 { n++; for (i = 1; i <= 3; i++) {
		d = $i - $(i + 3); if (d < 0) d = -d; if (d > most) most = d } }
		END { print (n > 1000 && most < 1e-12 ? "back" : "bad: off by " most) }'
done

# Nor do they hinder a second smoothing, and the remeshing of a base whose map has them.
mr-smooth -t 5 smooth.mrs | mr-remesh | mr-info --check >/dev/null && echo again
for name in ${DATA:+stanford-bunny.obj}; do
	mr-import "$DATA/meshes/$name.gz" | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.1 --handle 0=above:y,0.9 |
		mr-solve | mr-encode | mr-pose | mr-solve | mr-decode -o back.mrs
	mr-info --check back.mrs >/dev/null || echo "$name: bad"
done
