# A hole of a billionth of the model's size, as poles of a sphere that was not welded have, is no reason to fail.
fail=0
awk 'BEGIN {
	n = 40; m = 24; pi = atan2(0, -1)
	for (j = 0; j <= m; j++)
		for (i = 0; i < n; i++) {
			a = 2 * pi * i / n; b = pi * (j ? j : 1e-10) / m
			print "v", cos(a) * sin(b), sin(a) * sin(b), cos(b)
		}
	for (j = 0; j < m; j++)
		for (i = 1; i <= n; i++) {
			k = i % n + 1
			print "f", j * n + i, (j + 1) * n + i, (j + 1) * n + k, j * n + k
		}
}' >sphere.obj
mr-import sphere.obj | mr-smooth | mr-remesh | mr-select --reset --free all --fixed below:x,0.2 --handle 0=above:x,0.8 |
    mr-encode -o rest.mrs || exit 1
mr-info rest.mrs | grep -q 'boundary loops 2' || { echo "the holes are closed"; fail=1; }
mr-pose -H 0 --translate 0.3,0,0 rest.mrs | mr-solve | mr-decode -q | mr-export after.obj || exit 1
paste -d ' ' sphere.obj after.obj | awk '
	$1 == "v" {
		d = sqrt(($2 - $6) ^ 2 + ($3 - $7) ^ 2 + ($4 - $8) ^ 2)
		if (!(d <= most)) most = d
	}
	END { print "moved by up to " most; exit !(most > 0.29 && most < 0.31) }' || fail=1
exit $fail
