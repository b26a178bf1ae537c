# OpenBLAS is optional: with the reference BLAS and LAPACK, where they are installed beside it, an edit and a scan are
# the same to 1e-9 of the diagonal, and nothing of OpenBLAS is loaded.
[ -z "$SAN" ] || { echo "another BLAS under a sanitizer shows nothing more"; exit 77; }
blas=$(ls -d /usr/lib/*/blas/libblas.so.3 2>/dev/null | head -n 1)
lapack=$(ls -d /usr/lib/*/lapack/liblapack.so.3 2>/dev/null | head -n 1)
[ "$blas" ] && [ "$lapack" ] || { echo "no reference BLAS beside another"; exit 77; }
fail=0
work() { # folder
	mkdir "$1" && cd "$1" || exit
	for k in 1 2 3; do
		mr-make bumpy -n 3000 | mr-smooth | mr-remesh |
			mr-select --free all --fixed below:y,0.5 --handle 1=above:y,0.85 |
		    mr-encode | mr-pose -H 1 --rotate 0,0,1,30 | mr-solve -k $k -s cholesky |
		    	mr-decode -o edit$k.mrs || exit
	done
	mr-make bumpy -n 3000 --points 5000 | mr-shrinkwrap | mr-simplify | mr-fit | mr-sample |
		mr-decode -o scan.mrs || exit
	cd ..
}
work usual
export LD_LIBRARY_PATH="${blas%/*}:${lapack%/*}"
ldd "$BUILD/bin/mr-solve" >loaded
grep -q "=> ${blas%/*}/libblas" loaded || { cat loaded; echo "the reference BLAS is not loaded"; exit 1; }
grep openblas loaded && { echo "OpenBLAS is loaded beside the reference BLAS"; fail=1; }
work reference
for file in edit1 edit2 edit3 scan; do
	mr-compare --json --vertices usual/$file.mrs reference/$file.mrs >figures ||
		{ echo "$file cannot be compared"; fail=1; }
	awk -F'"vertex_max_relative":' \
		'NF == 2 { sub(/[,}].*/, "", $2); found = 1; print $2; bad = $2 + 0 > 1e-9 }
			END { exit bad || !found }' figures >off ||
	    { echo "$file is $(cat off) of the diagonal off with the reference BLAS"; fail=1; }
done
exit $fail
