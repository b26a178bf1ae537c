# What is kept of surfaces and clouds, and what goes with it.
left() {
	mr-crop --stats stats.json "$@" -o out.mrs &&
	    echo "$*: $(grep -o '"vertices".*[0-9]' stats.json | tr -d '"')"
}
mr-make plane -n 121 -o plane.mrs # 11 by 11, at distances of 0.2
left --keep below:x,0.5 plane.mrs
left --drop below:x,0.5 plane.mrs
left --keep below:x,0.5 --drop below:y,0.5 plane.mrs
left --drop boundary plane.mrs
left --drop sphere:0,0,0,0.1 --drop grow:1 plane.mrs
left --keep sphere:0,0,0,0.3 --keep grow:2 plane.mrs
left --drop sphere:9,9,9,1 plane.mrs
left --keep all plane.mrs
mr-crop --no-history --keep all plane.mrs | cmp - plane.mrs && echo 'all is as it was'

echo 'by columns, regions among them, and by parts'
mr-select --free above:x,0.5 --handle 0=above:x,0.9 plane.mrs -o regions.mrs
left --keep column:region,2,2 regions.mrs
left --drop column:region,0,0 regions.mrs
mr-info out.mrs | grep region
mr-make sphere -n 500 | mr-transform --translate 3,0,0 | mr-cat --append plane.mrs - -o two.mrs
left --keep part:1 two.mrs
left --keep part:2 two.mrs
left --keep component:3,0,0 two.mrs

echo 'clouds'
mr-make sphere --points 1000 -o ball.mrs
mr-make sphere --points 400 | mr-transform --scale 0.5 --translate 2.2,0,0 | mr-cat --append ball.mrs - -o balls.mrs
left --keep box:-1,-1,-1,1,1,0 ball.mrs
left --keep halfspace:1,0,0,0.5+not:above:z,0.5 ball.mrs
left --keep part:2 balls.mrs
left --drop component:2.2,0,0 balls.mrs
left --keep spaced:0.2 ball.mrs
left --keep spaced:0.2 out.mrs
left --keep spaced:0 ball.mrs
left --keep spaced:5%+above:z,0.5 ball.mrs
mr-export -i out.mrs - -f xyz | awk '{ x[NR] = $1; y[NR] = $2; z[NR] = $3 }
	END { # no two are nearer than 5 % of the diagonal
		for (i in x) for (j in x) if (i != j && (x[i] - x[j])^2 + (y[i] - y[j])^2 + (z[i] - z[j])^2 < 0.0289) near++
		print near + 0, "too near"
	}'
mr-split balls.mrs --no-history | mr-cat --no-history --append | mr-export split.xyz
mr-export balls.xyz <balls.mrs
cmp split.xyz balls.xyz && echo 'as it was'

echo 'what a file gave goes along'
cat >model.ply <<'PLY'
ply
format ascii 1.0
element vertex 5
property double x
property double y
property double z
property uchar red
property uchar green
property uchar blue
property float quality
element face 2
property list uchar int vertex_indices
property int label
end_header
0 0 0 255 0 0 0.5
1 0 0 0 255 0 1.5
1 1 0 0 0 255 2.5
0 1 0 0 0 0 3.5
2 0 0 9 9 9 4.5
4 0 1 2 3 7
3 1 4 2 8
PLY
mr-import model.ply | mr-crop --drop column:quality,0,1 | mr-export - -f ply-ascii | sed '1,/end_header/d'
mr-import model.ply | mr-crop --keep column:label,7,7 | mr-export - -f ply-ascii | sed '1,/end_header/d'

echo 'detail stays over its base, which stays'
mr-make bumpy -n 3000 | mr-smooth | mr-remesh | mr-encode -o rest.mrs
mr-crop --keep above:y,0.5 rest.mrs -o half.mrs
mr-info --check half.mrs >checked && echo sound
mr-decode half.mrs | mr-compare -a mesh -b mesh --json half.mrs | grep -c '"vertex_max_relative":[0-9.]*e-1[0-9]'
mr-info half.mrs | grep -E 'source|encoded' | cut -c1-30

echo 'refusals'
refused() {
	mr-crop "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
}
refused plane.mrs
refused --keep plane.mrs
refused --keep nowhere plane.mrs
refused --keep part:0 plane.mrs
refused --keep part:x plane.mrs
refused --keep part:1,0 plane.mrs
refused --keep halfspace:0,0,0,1 plane.mrs
refused --keep spaced: plane.mrs
refused --keep spaced:-1 plane.mrs
refused --keep spaced:1,2 plane.mrs
refused --keep column:region plane.mrs
refused --keep column:region,1 plane.mrs
refused --keep column:,0,1 plane.mrs
refused --keep column:region,2,1 plane.mrs
refused --keep column:region,0,1 plane.mrs
refused --keep column:position,0,1 plane.mrs
refused --keep part:2 plane.mrs
refused --drop all plane.mrs
refused --keep sphere:0,0,0,0.1 plane.mrs
for needs in geodesic:0,0,0,1 rings:1,1 group:a boundary grow:1; do
	refused --keep $needs ball.mrs
done
refused -l base --keep all plane.mrs
