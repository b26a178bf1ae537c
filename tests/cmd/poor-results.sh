# What is poor is said: one model for each warning that no other test gets to hear.
heard() { # what, the tool's words
	echo "-- $1"
	grep -o "$2" said | sort -u || sed 's/^/not heard: /' said
}
mr-make bumpy -n 5000 | mr-smooth -q -t 200 | mr-remesh -q -r 4 | mr-select --free all --fixed below:y,0.3 --handle 1=above:y,0.5 |
    mr-encode -q | mr-pose -H 1 --rotate 0,0,1,170 --scale 0.2 | mr-solve -q | mr-decode 2>said >out
heard 'half a model shrunk in little room' '\[folded\]'

# a disc whose lids are fans of long triangles
mr-make sphere -n 42 -o sphere.mrs
awk 'BEGIN { n = 40; print "OFF"; print 2 * n, 4 * n - 4, 0
	for (k = 0; k < 2; k++) for (i = 0; i < n; i++) print cos(6.2831853 * i / n), sin(6.2831853 * i / n), k / 100
	for (i = 1; i < n - 1; i++) { print 3, 0, i + 1, i; print 3, n, n + i, n + i + 1 }
	for (i = 0; i < n; i++) { j = (i + 1) % n; print 3, i, j, n + j; print 3, i, n + j, n + i } }' >disc.off
mr-subdivide --stats stats.json disc.off 2>said >out
heard 'a disc with long triangles' '\[folded\]'
grep -c '"findings":{"folded":' stats.json
for options in '-n 0' '--longest 10%'; do mr-subdivide $options disc.off -o out; done
mr-subdivide sphere.mrs -o out

mr-make knot --points 900 --noise 2% | mr-shrinkwrap 2>said >out
heard 'too few points of a knot, with noise' '\[uncertain\]'

mr-make sphere -n 42 | mr-export -f off - | mr-import -l control -o control.mrs
mr-make knot --points 1500 | mr-cat --merge control.mrs - | mr-fit -m local 2>said -o fit.mrs
heard 'a control mesh of something else' '\[rough\]'
mr-sample fit.mrs 2>said >out
heard 'and its displaced surface' '\[rough\]'
