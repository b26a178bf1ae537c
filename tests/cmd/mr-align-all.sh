# Five noisy parts of a surface, as a turn-table shows them, come into one frame of reference, and a stranger stays.
mr-make bumpy -n 60000 -o whole.mrs
cat >noise.awk <<'END'
BEGIN { srand(seed) }
function gauss() { return sqrt(-2 * log(1 - rand())) * cos(6.283185307 * rand()) }
/^v / { print "v", $2 + s * gauss(), $3 + s * gauss(), $4 + s * gauss(); next }
{ print }
END
noise=0.0246 # 0.5 % of the diagonal
part() { # NUMBER DIRECTION: half of it, and the same elsewhere
	mr-crop --keep "halfspace:$2,0,0" whole.mrs | mr-export -q -f obj - |
		awk -v s=$noise -v seed="$1" -f noise.awk >"$1.obj"
	mr-import -q "$1.obj" | mr-transform --rotate 1,2,3,23 --translate 1.6,0.1,0 -o "true$1.mrs"
	mr-import -q "$1.obj" | mr-transform --rotate "$1,2,3,$((23 * $1))" --translate "$1.6,0.$1,0" -o "away$1.mrs"
}
part 1 0.309,0.951
part 2 -0.809,0.588
part 3 -0.809,-0.588
part 4 0.309,-0.951
part 5 1,0
mr-cat true[1-5].mrs -o true.mrs
mr-cat away1.mrs away2.mrs away3.mrs away4.mrs away5.mrs -o away.mrs
mr-align --all -m 'motion%d.txt' --stats stats.json away.mrs -o back.mrs
mr-compare --vertices --json -i back.mrs true.mrs | sed 's/.*"vertex_mean":\([^,}]*\).*/\1/' |
	awk -v most=$noise '{ print ($1 <= most / 10 ? "ok" : "bad: " $1) }'
cat motion1.txt
grep -c '"score"' stats.json
echo 'the motions as text'
for k in 1 2 3 4 5; do
	mr-transform -m motion$k.txt away$k.mrs -o again$k.mrs
done
mr-cat again[1-5].mrs -o again.mrs
mr-compare --vertices --json -i back.mrs again.mrs | sed 's/.*"vertex_max":\([^,}]*\).*/\1/'
echo 'a stranger stays, and a sequence moves as its key'
mr-make knot -n 3000 -o knot.mrs
mr-make bumpy -n 3000 | mr-crop --keep below:x,0.7 | mr-smooth | mr-remesh -q -r 2 |
	mr-select --free all --fixed below:z,0.2 --handle 0=above:z,0.8 | mr-encode |
	mr-pose --rotate 0,0,1,20 --frames 2 | mr-solve | mr-decode -q -o film.mrs
mr-make bumpy -n 4000 | mr-crop --keep above:x,0.3 | mr-transform --rotate 1,2,3,100 -o other.mrs
mr-cat knot.mrs other.mrs film.mrs >all.mrs
mr-align --no-history --all --stats stats.json all.mrs -o back.mrs
mr-align --no-history -j1 --all all.mrs | cmp - back.mrs && echo 'with any number of threads'
grep -o '"name.*' stats.json | sed 's/,"seconds[^}]*\("findings.*\)/ \1/; s/,"seconds.*//'
