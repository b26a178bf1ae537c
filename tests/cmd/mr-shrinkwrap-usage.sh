# Wrong command lines: exit 2, a sentence, nothing on stdout.
mr-make sphere --points 50 -o points.mrs
for args in '-m sphere' '-r -1' '-r x' '--grid 1e9' '--alpha 2' '--alpha nan' '--lambda -0.1' '-n 1.5' '--nothing' '-m' \
	'-m cube --grid 20' '--lids some' '-m cube --lids none' '--template --lids all' '--template -m cube' '--template -r 9' \
	'-m cube --ignore-normals' '--template --ignore-normals'; do
	mr-shrinkwrap $args points.mrs >out 2>err
	echo "$args: $? $(wc -c <out) $(head -n 1 err)"
done
