# Heights over a control mesh: to points, with noise too, and to a mesh; shares of tries; the same bytes for any -j.
figure() { # name: a figure of --stats
	sed "s/.*\"$1\":\([^,}]*\).*/\1/" stats.json
}
check() { # name, condition in awk over figures
	awk "BEGIN { print \"$1: \" (($2) ? \"ok\" : \"bad: $2\") }"
}
control() { # shape, options
	mr-make "$@" | mr-export -f off - | mr-import -l control -
}
frame() { # control, points or mesh
	mr-cat --merge "$2" "$1"
}
control sphere -n 42 >ball.mrs || exit
mr-make sphere --points 6000 -o points.mrs || exit
frame ball.mrs points.mrs >sphere.mrs
echo "uniform random points: 25, 50 and 69 % at least"
mr-sample --stats stats.json --refine 0 sphere.mrs -o paper.mrs || exit
check level "$(figure level) == 4"
check tries "$(figure tries_1) > 0.25 && $(figure tries_4) > 0.5 && $(figure tries_10) > 0.6875"
check missed "$(figure filled) < 0.01 * $(figure vertices)"
found=$(figure gap_mean)
mr-sample --stats stats.json sphere.mrs -o sphere.out || exit
check refined "$(figure gap_mean) < 0.5 * $found && $(figure gap_mean) < 2e-4 && $(figure folds) == 0"
mr-info sphere.out | sed -n '/displacement:/,$p'

echo "noise"
mr-make sphere --points 3000 --noise 0.01 -o noisy.mrs
frame ball.mrs noisy.mrs | mr-sample -m robust --stats stats.json -o noisy.out || exit
mr-make sphere --points 3000 --noise 0.1 | frame ball.mrs - | mr-sample -m triangle 2>&1 >/dev/null | grep -c rough
for method in auto robust; do
	mr-make sphere --points 3000 --noise 0.03 | frame ball.mrs - | mr-sample --no-history -m $method -o $method.out
done
cmp auto.out robust.out && echo by default the same
check noise "$(figure fairness) > 1"

echo "a mesh; an open one"
mr-make torus -n 8000 -o torus.mrs
control torus -n 200 >ring.mrs
frame ring.mrs torus.mrs | mr-sample -n 3 --stats stats.json -o torus.out || exit
check mesh "$(figure gap_max) < 1e-3 && $(figure missed) == 0"
mr-make plane --points 2000 -o flat.mrs
control plane -n 25 >plane.mrs
frame plane.mrs flat.mrs | mr-sample --stats stats.json -o flat.out || exit
check open "$(figure gap_mean) < 1e-3"

echo "a mesh that its control mesh is too coarse for, and one with spikes, which are no outliers"
mr-make cube -n 8 | mr-simplify --to control | mr-fit -q | mr-sample >/dev/null
mr-make sphere -n 1500 | mr-export -f off - | awk 'NR > 2 && NF == 3 && NR % 300 == 0 { $0 = 2 * $1 " " 2 * $2 " " 2 * $3 } 1' >spikes.off
mr-import spikes.off | mr-simplify --to control | mr-fit --stats stats.json | mr-sample >/dev/null
check spikes "$(figure outliers) == 0"

echo "the same bytes for any number of threads"
for method in triangle robust; do
	mr-sample --no-history -m $method -j 1 sphere.mrs >one
	mr-sample --no-history -m $method -j 3 sphere.mrs | cmp one - && echo same
done

echo "what mr-solve did to control is lost where heights are looked for in what has not followed; where mesh has, it is not" >&2
mr-make bumpy -n 2000 | mr-simplify --to control | mr-fit -q -o rest.mrs
for heights in cat mr-sample; do
	$heights <rest.mrs >from.mrs
	mr-select -l control --free above:y,0.3 --handle 0=above:y,0.85 from.mrs | mr-pose --rotate 0,0,1,5 | mr-solve -o posed.mrs
	mr-sample -n 2 posed.mrs 2>&1 >/dev/null | grep -v 'the displaced surface' >&2
done
mr-fit posed.mrs 2>&1 >/dev/null | grep 'mr-solve has' >&2
mr-decode -q posed.mrs | mr-sample -n 2 >/dev/null
