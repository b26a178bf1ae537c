# Of several limbs at one handle, in one piece or several, each bends as it would alone.
fail=0
limb=$(printf '%s' '--free all --fixed below:z,0.2 --handle 0=above:z,0.8')
bend() { # regions: a pose about the origin, of one handle or two
	mr-select $1 | mr-smooth -t 0 | mr-encode | mr-pose -H 0 -c 0,0,0 -r 0,1,0,60 |
	    case $1 in *1=*) mr-pose -H 1 -c 0,0,0 -r 0,1,0,60 ;; *) cat ;; esac | mr-solve $solver | mr-decode --mend none --no-check
}
same() { # what, file, file
	mr-compare -a mesh -b mesh --vertices --json "$2" "$3" | grep -Eq '"vertex_max_relative":([0-9.]*e-1[0-9]|0[,}])' ||
	    { echo "$1, solver '$solver': the limbs bend otherwise"; fail=1; }
}
mr-make cylinder -n 2000 -o limb.mrs
mr-transform -t 9,0,0 limb.mrs | mr-cat --append limb.mrs - -o limbs.mrs
for solver in '' '--arap 2'; do
	mr-split limbs.mrs | mr-cat -o apart.mrs
	bend "$limb" <limbs.mrs | mr-split -q -o together.mrs
	bend "$limb" <apart.mrs >each.mrs
	[ "$(mr-info together.mrs | grep -c '^  mesh')" = 2 ] || { echo 'there are not two limbs'; fail=1; }
	same 'two pieces' together.mrs each.mrs

	ends='--free all --fixed below:z,0.6 --free below:z,0.4'
	bend "$ends --handle 0=above:z,0.85 --handle 0=below:z,0.15" <limb.mrs >one.mrs
	bend "$ends --handle 0=above:z,0.85 --handle 1=below:z,0.15" <limb.mrs >two.mrs
	same 'two ends' one.mrs two.mrs
done

# A handle around the middle, between two that hold.
solver=
middle='--free all --fixed above:z,0.9 --handle 0=below:z,0.6 --free below:z,0.4 --fixed below:z,0.1'
bend "$middle" <limb.mrs >both.mrs
bend "$middle --fixed below:z,0.4" <limb.mrs >upper.mrs
for one in both upper; do
	mr-export -f ply-ascii - <$one.mrs | awk 'body { print } /^end_header/ { body = 1 }' >$one
done
mr-export -f ply-ascii - <limb.mrs | awk 'body { print } /^end_header/ { body = 1 }' | paste -d ' ' - both upper | awk '
	$3 > 0 && NF == 9 { n++; d = sqrt(($4 - $7) ^ 2 + ($5 - $8) ^ 2 + ($6 - $9) ^ 2); if (d > most) most = d }
	END { if (!(n > 100 && most < 1e-10)) { print "beside a handle in the middle: off by " most " of " n " vertices"; exit 1 } }' || fail=1
exit $fail
