# Gains by level: none, prefixes, threads, frames; refusals.
mr-make torus -n 3000 -o mesh.mrs
mr-make torus -n 60 | mr-export -f off - | mr-import -l control - | mr-cat --merge - mesh.mrs |
	mr-sample -n 3 --no-history -o torus.mrs || exit
heights() { # file, how many (of all): one a line
	python3 - "$@" <<'END'
import records, sys
h = records.column(sys.argv[1], b'displacement', b'height')
print('\n'.join('%.17g' % x for x in h[:int(sys.argv[2])] ))
END
}
near() { # two files of lines, tolerance
	paste "$1" "$2" | awk -v t="$3" '{ d = $1 - $2; if (d > t || -d > t) bad++ } END { print (NR && !bad ? "equal" : "differ") }'
}
heights torus.mrs 9999999 >were
wc -l <were
for gain in '' '--gain 1' '--gain 1,1,1,1'; do
	mr-equalize $gain torus.mrs -o out.mrs
	heights out.mrs 9999999 >are
	near were are 1e-16
done

echo 'what is above does not show below'
mr-equalize --gain 1,1,0.5,-3 torus.mrs -o out.mrs
heights out.mrs 240 >are # levels 0 and 1
heights torus.mrs 240 | cmp - are && echo same
mr-equalize --gain 0,0,0,0 torus.mrs | mr-decode --no-history --gain 3 -o flat.mrs
mr-decode --gain 0 torus.mrs | mr-export -f off - >domain.off
mr-export -f off - <flat.mrs | cmp - domain.off && echo flat
mr-info out.mrs | sed -n '/^  displacement/,$p'

echo 'threads'
mr-equalize --gain 1,2,3 -j 2 torus.mrs -o two.mrs
mr-equalize --gain 1,2,3 -j 1 torus.mrs | cmp - two.mrs && echo same

echo 'refusals'
refused() {
	mr-equalize "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes"
	head -n 1 err
}
refused --gain 1,1,1,1,1 torus.mrs
refused --gain 1,x torus.mrs
refused --gain 1, torus.mrs
refused --gain '' torus.mrs
refused --gain nan torus.mrs
refused --gain 1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1 torus.mrs
refused mesh.mrs
mr-make torus -n 60 | mr-export -f off - | mr-import -l control - >control.mrs
refused control.mrs
