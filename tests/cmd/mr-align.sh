# A surface is moved back onto where it was: whole, in part, noisy, scaled; figures, matrix and column say how.
apart() { # FILE FILE MOST: of vertices that correspond, in shares of the diagonal
	mr-compare --json -i "$1" "$2" | sed 's/.*"vertex_max_relative":\([^,}]*\).*/\1/' |
		awk -v most="$3" '{ print ($1 <= most ? "ok" : "bad: " $1) }'
}
mr-make bumpy -n 8000 -o whole.mrs
echo 'to the bit of rounding, wherever it is'
for by in '--rotate 1,2,3,170' '--rotate 0,1,0,90 --translate 1e4,2e4,3e4' '--rotate 3,1,2,23 --translate 9,0,0'; do
	mr-transform $by whole.mrs | mr-align whole.mrs -o back.mrs
	apart back.mrs whole.mrs 1e-9
done
echo 'with another triangulation'
mr-make bumpy -n 3000 | mr-transform --rotate 2,1,0,120 | mr-align whole.mrs | mr-compare --json whole.mrs |
	sed 's/.*"both_relative":{[^}]*"mean":\([^,]*\),.*/\1/' | awk '{ print ($1 < 0.002 ? "ok" : "bad: " $1) }'
echo 'scaled'
mr-transform --scale 0.01 --rotate 1,0,0,50 whole.mrs | mr-align --scale --stats stats.json whole.mrs -o back.mrs
apart back.mrs whole.mrs 1e-9
grep -o '"scale":[0-9]*' stats.json
echo 'two noisy scans: truth, matrix, column'
mr-crop --keep below:x,0.68 whole.mrs -o left.mrs
mr-crop --keep above:x,0.32 whole.mrs -o right.mrs
cat >noise.awk <<'END'
BEGIN { srand(5) }
function gauss() { return 0.5 * sqrt(-2 * log(1 - rand())) * cos(6.283185307 * rand()) }
/^v / { print "v", $2 + s * gauss(), $3 + s * gauss(), $4 + s * gauss(); next }
{ print }
END
for side in left right; do
	mr-export -q -f obj - <$side.mrs | awk -v s=0.02 -f noise.awk >$side.obj
	mr-import -q $side.obj -o $side-noisy.mrs
done
mr-transform --rotate 1,1,2,23 --translate 0.5,0.5,0.3 right-noisy.mrs -o away.mrs
mr-align -m motion.txt left-noisy.mrs <away.mrs >back.mrs
apart back.mrs right-noisy.mrs 0.002
wc -l <motion.txt
mr-transform -m motion.txt away.mrs | mr-export -q -f obj - >a.obj
mr-export -q -f obj - <back.mrs | cmp - a.obj && echo same
mr-info back.mrs | grep transform.*1 | grep -v mr-
mr-align -j1 left-noisy.mrs <away.mrs | mr-export -q -f obj - | cmp - a.obj && echo 'any number of threads'
echo 'a cloud without normals onto a surface, and back'
mr-make bumpy -n 8000 --points 20000 | mr-transform --rotate 1,2,3,100 -o cloud.mrs
mr-align whole.mrs <cloud.mrs | mr-compare --json -a points -b mesh whole.mrs |
	sed 's/.*"a_to_b_relative":{[^}]*"mean":\([^,]*\),.*/\1/' | awk '{ print ($1 < 0.002 ? "ok" : "bad: " $1) }'
mr-align cloud.mrs <whole.mrs | mr-compare --json -b points cloud.mrs |
	sed 's/.*"b_to_a_relative":{[^}]*"mean":\([^,]*\),.*/\1/' | awk '{ print ($1 < 0.002 ? "ok" : "bad: " $1) }'
echo 'a symmetric surface, and those that slide'
for shape in cube torus sphere cylinder; do
	mr-make $shape -n 2000 -o there.mrs
	mr-make $shape -n 3000 | mr-transform --rotate 1,2,3,100 --translate 5,0,0 | mr-align there.mrs |
		mr-compare --json there.mrs | sed 's/.*"both_relative":{[^}]*"mean":\([^,]*\),.*/\1/' |
		awk -v s=$shape '{ print s, ($1 < 0.002 ? "ok" : "bad: " $1) }'
done
echo 'one layer alone, and a sequence as its key'
mr-smooth whole.mrs | mr-transform -l base --translate 3,0,0 2>/dev/null |
	mr-align -l base whole.mrs | mr-compare --json -a base -b mesh |
	sed 's/.*"both_relative":{[^}]*"mean":\([^,]*\),.*/\1/' | awk '{ print ($1 < 0.02 ? "ok" : "bad: " $1) }'
mr-smooth whole.mrs | mr-remesh -q -r 2 | mr-select --free all --fixed below:x,0.2 --handle 0=above:x,0.8 | mr-encode |
	mr-pose --rotate 0,0,1,40 --frames 2 | mr-solve | mr-decode -q -o film.mrs
mr-transform --rotate 1,2,3,100 --translate 1,2,3 film.mrs | mr-align film.mrs -o again.mrs
mr-compare --json -a mesh -b mesh -i again.mrs film.mrs | sed 's/.*"vertex_max_relative":\([^,}]*\).*/\1/' |
	awk '{ print ($1 <= 1e-9 ? "ok" : "bad: " $1) }'
