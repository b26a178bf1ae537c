# How far the solution of every solver is from Cholesky's at a relative residual of 1e-10, of the diagonal; a pose of the
# models between a fixed and a moved fifth.  k = 3 where at most 20 thousand vertices are free.
figure() { # name: a number of the last line of stats.json
	sed -n '$s/.*"'"$1"'":\([^,}]*\).*/\1/p' stats.json
}
agree() { # k, label, options
	k=$1 label=$2
	shift 2
	if mr-solve -k "$k" --tol 1e-10 --stats stats.json "$@" posed.mrs -o out.mrs 2>error; then
		mr-solve -k "$k" -s cholesky posed.mrs -o direct.mrs
		error=$(mr-compare --json -a base -b base direct.mrs <out.mrs | sed -n '$s/.*"hausdorff_relative":\([^,}]*\).*/\1/p')
		echo "$model-k$k $label $error diagonals"
		echo "$model k = $k by $label: $(figure free) free, residual $(figure residual), $(figure iterations) iterations, $(figure seconds_solve) s"
	else
		echo "$model k = $k by $label: $(cat error)"
	fi
}
case_of() { # name; selected.mrs
	model=$1
	mr-solve -k 1 --flatten --stats stats.json selected.mrs | mr-pose --translate 0.02,0.1,0.05 --rotate 0,1,0,30 -o posed.mrs
	free=$(figure free)
	[ "$free" -le 20000 ] && orders='1 2 3' || orders='1 2'
	for k in $orders; do
		agree "$k" lu -s lu
		agree "$k" lu-unsymmetric -s lu --unsymmetric
		agree "$k" multigrid -s multigrid
		[ "$k" -eq 3 ] || agree "$k" cg -s cg
	done
}
mr-make torus -n 16000 | mr-smooth -t 0 | mr-select --free all --fixed below:x,0.05 --handle 0=above:x,0.95 -o selected.mrs
case_of torus
for file in bunny00.off.gz armadillo.off.gz horse.ply.gz knot1.off lion-head.off.gz igea.ply.gz; do
	[ -f "$DATA/meshes/$file" ] || continue
	mr-import "$DATA/meshes/$file" | mr-smooth | mr-remesh |
	    mr-select --free all --fixed below:y,0.2 --handle 0=above:y,0.8 -o selected.mrs
	case_of "${file%%.*}"
done
