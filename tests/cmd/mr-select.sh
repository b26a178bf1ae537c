# Regions by predicates, on surfaces where the numbers are known.
mr-make plane -n 121 -o plane.mrs # 11 by 11, at distances of 0.2
counts() { # what the options select of plane.mrs
	mr-select --stats stats.json "$@" plane.mrs -o out.mrs &&
	    echo "$*: $(grep -o '"fixed".*[0-9]' stats.json | tr -d '"')"
}
counts --free all
counts --free all --fixed boundary --handle 0=sphere:0,0,0,0.21
counts --handle 3=above:x,0.9 --free sphere:0,0,0,10% --handle 7=below:y,0
counts --free geodesic:0,0,0,0.41 --fixed not:geodesic:0,0,0,0.3+above:x,0.5
counts --free rings:60,2 --free grow:1
counts --handle 1=box:-0.1,-0.1,0,0.1,0.1,0 --handle 1=grow:2+halfspace:1,1,0,0
printf '0\n# the opposite corner\n120\n' >corners
counts --handle 0=vertices:corners --free component:0,0,0+not:vertices:corners

echo 'points'
mr-make sphere --points 500 -o points.mrs
count_points() {
	mr-select --stats stats.json "$@" points.mrs -o out.mrs &&
	    echo "$*: $(grep -o '"fixed".*[0-9]' stats.json | tr -d '"')"
}
count_points --free part:1 --handle 0=above:z,0.9
count_points -l points --free component:0,0,0+not:box:0,0,0,1,1,1
mr-select --free all --fixed grow:2 plane.mrs 2>&1 >out.mrs
mr-select --free all --fixed rings:60,1 --fixed grow:1 --stats stats.json plane.mrs >out.mrs
grep -o '"fixed".*[0-9]' stats.json

echo 'regions stay without --reset, and go with it'
mr-select --free above:x,0.5 plane.mrs | mr-select --handle 0=below:x,0 --stats stats.json >kept.mrs
grep -o '"fixed".*[0-9]' stats.json
mr-select --reset --handle 0=below:x,0 --stats stats.json kept.mrs >reset.mrs
grep -o '"fixed".*[0-9]' stats.json

echo 'two commands are one'
mr-select --no-history --free all --handle 0=above:y,0.9 plane.mrs >one.mrs
mr-select --no-history --free all plane.mrs | mr-select --no-history --handle 0=above:y,0.9 | cmp - one.mrs && echo same

echo 'remarks'
mr-select -v --free all --fixed below:x,0 plane.mrs 2>&1 >out.mrs

echo 'refusals'
refused() {
	mr-select "$@" plane.mrs >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
}
refused --handle 2=sphere:5,5,5,0.1
refused --free group:wheel
refused --free rings:121,1
echo 200 >far
refused --free vertices:far
echo x >words
refused --free vertices:words
refused --free vertices:absent
refused
refused --free
refused --free nowhere
refused --free all+bx:1 plane.mrs
refused --free sphere:1,2,3
refused --handle above:x,0.5
refused --handle 70000=all
refused --handle 0=
refused --free part:2
refused --free column:region,0,1
mr-select --free boundary points.mrs 2>&1 >out || echo "exit $?"
mr-make torus -n 100 | mr-select --free not:sphere:1e200,0,0,1e201 -o out || echo "exit $?"
mr-make torus -n 100 | mr-select --free sphere:1e200,0,0,1e201 --stats - 2>&1 >out | grep -o '"free":[0-9]*'
