# Wrong command lines: exit 2 and no output; meshes that it cannot work on.
mr-make sphere -n 100 -o s.mrs
for wrong in '-k 0' '-k 4' '--max-length -1' '--loops x' '--loops -1' '--max-length nan'; do
	mr-fill $wrong s.mrs >out 2>err
	echo "$wrong: exit $?, $(wc -c <out) bytes"
	head -n 1 err
done
printf '0 0 0\n1 0 0\n0 1 0\n' >cloud.xyz
mr-import cloud.xyz | mr-fill >out 2>err
echo "exit $?: $(cat err)"
# Soup: lone triangles, edges of three faces, a face without area, one twice, coordinates far away.
cat >wild.off <<'END'
OFF
9 9 0
0 0 0
1 0 0
0.5 1 0
0.5 -1 0
0.5 0 1
0.5 0 0
0 0 0
1e9 0 0
1e9 1 0
3 0 1 2
3 1 0 3
3 0 1 4
3 0 1 5
3 2 4 3
3 0 6 2
3 0 1 2
3 7 8 3
3 6 0 3
END
for o in '' '--loops 9' '-k 3 --max-length 1e10'; do
	mr-import -q wild.off | mr-fill --stats stats.json $o 2>err | mr-export -q -f off - | grep -ci nan
	sed 's/.*\("loops"[^}]*\).*/\1/' stats.json | tr -d '"'
	sed 's/(.*)/(...)/' err
done
