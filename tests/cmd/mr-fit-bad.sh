# What it cannot work on is refused by name; what is odd but lawful is worked on.
merge() { # an .off file and an .xyz file
	mr-import -l control "$1" -o c.mrs && mr-import "$2" -o p.mrs && mr-cat --merge c.mrs p.mrs
}
mr-make sphere -n 100 | mr-export -f off - >ball.off
mr-make sphere --points 500 | mr-export -f xyz - >ball.xyz
printf '1 2 3\n1 2 3\n1 2 3\n' >one.xyz
printf '0 0 1\n0 0 -1\n' >two.xyz
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n' >fan.off
refused() {
	mr-fit >out
	echo "exit $?"
	if mr-cat out >/dev/null 2>&1; then
		echo 'bad: whole output'
	fi
}
mr-import ball.xyz | refused
mr-import -l control ball.off | refused
awk 'NR > 2 && NR <= 94 { $0 = "0 0 0" } 1' ball.off >shrunk.off
merge shrunk.off ball.xyz | refused
for m in local least-squares; do
	merge ball.off one.xyz | mr-fit -q -m $m >out; echo "exit $?"
	merge fan.off ball.xyz | mr-fit -q -m $m >out; echo "exit $?"
	echo 'two points; a triangle; a vertex without a face, which stays'
	merge ball.off two.xyz | mr-fit -q -m $m | mr-export -f off -l control - | grep -ci nan
	printf 'OFF\n4 1 0\n-1 -1 0\n1 -1 0\n7 8 9\n0 1 0\n3 0 1 3\n' >tri.off
	merge tri.off ball.xyz | mr-fit -q -m $m | mr-export -f off -l control - | sed -n 5p
	merge tri.off ball.xyz | mr-fit -q -m $m | mr-export -f off -l control - | grep -ci nan
	echo 'faces without area'
	printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n' >flat.off
	merge flat.off ball.xyz | mr-fit -q -m $m | mr-export -f off -l control - | grep -ci nan
done
