# Wrong command lines: exit 2 and no output; meshes that it cannot or can work on.
mr-make sphere -n 100 -o s.mrs
for wrong in '-t -1' '-t nan' '-m cubic' '-m taubin -t 1.5 -n 9' '-n x'; do
	mr-smooth $wrong s.mrs >out 2>err
	echo "$wrong: exit $?, $(wc -c <out) bytes"
	head -n 1 err
done
refuse() {
	mr-import "$1" | mr-smooth >out 2>err
	echo "exit $?: $(cat err)"
}
printf '0 0 0\n1 0 0\n0 1 0\n' >cloud.xyz
refuse cloud.xyz

# Three faces at an edge, a flat one, a face with no area at all, one repeated: finite results.
cat >wild.off <<'END'
OFF
7 9 0
0 0 0
1 0 0
0.5 1 0
0.5 -1 0
0.5 0 1
0.5 0 0
0 0 0
3 0 1 2
3 1 0 3
3 0 1 4
3 0 1 5
3 2 4 3
3 0 6 2
3 0 1 2
3 2 3 4
3 6 0 3
END
for m in implicit taubin; do
	mr-import wild.off | mr-smooth -m $m -t 1 | mr-export -f off -l base - | grep -ci nan || :
done
for size in 1e80 1e-100; do
	printf 'OFF\n3 1 0\n0 0 0\n%s 0 0\n0 %s 0\n3 0 1 2\n' $size $size | mr-import -f off - 2>&1 >tiny.mrs
	mr-smooth tiny.mrs 2>&1 >out.mrs || :
done
