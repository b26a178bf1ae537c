# The distance of each vertex as a column of the stream: signed where the other surface is closed.
mr-make sphere -n 4000 >ball.mrs
mr-make sphere -n 1000 | mr-transform --scale 1.5,0.5,1 >egg.mrs
echo 'in and out'
mr-compare --column distance --stats stats.json ball.mrs <egg.mrs >map.mrs
mr-info map.mrs | grep -o 'distance.*' | head -n 1
mr-export -q -l mesh -f ply-ascii - <map.mrs | grep '^property.*distance'
mr-export -q -l mesh -f ply-ascii - <map.mrs | sed '1,/end_header/d' | awk 'NF > 4 || ($1 == $1 + 0 && NF == 4) {
	d = sqrt($1 * $1 + $2 * $2 + $3 * $3) - 1 - $4; if (NF == 4 && $1 != 3) worst = d * d > worst ? d * d : worst }
	END { print worst < 1e-6 ? "as of a ball" : "bad: " worst }'
tr ',' '\n' <stats.json | sed -n 's/^"\(.*q[59].*\)":\([0-9.]\{4\}\).*/\1 \2/p'
echo 'an open surface has no sides'
mr-crop --keep above:y,0.3 ball.mrs -o dome.mrs
mr-compare --column d dome.mrs <egg.mrs | mr-export -q -l mesh -f ply-ascii - | sed '1,/end_header/d' |
	awk 'NF == 4 && $1 != 3 && $4 < 0 { n++ } END { print n + 0, "negative" }'
echo 'the rest of the stream passes, the map is drawn'
mr-compare --no-history --column d ball.mrs <ball.mrs | mr-export -q -f off - >a.off
mr-export -f off - <ball.mrs | cmp - a.off && echo same
mr-compare -j1 --column distance ball.mrs <egg.mrs | cmp - map.mrs || echo threads
mr-render --color distance map.png <map.mrs && head -c 4 map.png | tail -c 3
echo
echo 'wrong usage'
for wrong in '--column position' '--column ""' '--column d --json'; do
	eval "mr-compare $wrong ball.mrs" <ball.mrs >out 2>err
	echo "$wrong: exit $?, $(wc -c <out) bytes"
	head -n 1 err
done
