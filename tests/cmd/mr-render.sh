# The size of pictures, as their headers say it; the same bytes for any number of threads.
size() { # FILE: width x height
	od -An -tu1 -j16 -N8 "$1" | awk -v f="$1" '{ print f, $3 * 256 + $4 "x" $7 * 256 + $8 }'
}
mr-make torus -n 500 >torus.mrs
mr-make knot -n 600 >knot.mrs
cat torus.mrs knot.mrs >two.mrs
mr-render -s 120x80 one.png <torus.mrs && size one.png
mr-render -j 1 -s 120x80 -i torus.mrs j1.png && mr-render -j 3 -s 120x80 -i torus.mrs j3.png
cmp one.png j1.png && cmp one.png j3.png && echo same
mr-render -s 120x80 - <torus.mrs | cmp - one.png && echo 'same on stdout'
mr-render -s 100x90 'p-%s.png' <two.mrs && size p-torus.png && size p-knot.png
mr-render -s 100x90 'n-%03d.png' <two.mrs && cmp n-001.png p-torus.png && cmp n-002.png p-knot.png && echo 'same by number'
mr-render -s 100x90 --sheet --columns 2 sheet.png <two.mrs && size sheet.png

# Layers side by side, in the order asked for; columns of each kind.
mr-make sphere -n 700 | mr-select --free all --handle 0=above:z,0.8 | mr-smooth >layers.mrs
mr-render -s 100x90 all.png <layers.mrs && size all.png
mr-render -s 100x90 -l base base.png <layers.mrs && size base.png
for color in region source_face source_bary position; do
	mr-render -s 100x90 --color $color -i layers.mrs $color.png && size $color.png
done
cat layers.mrs torus.mrs | mr-render -s 100x90 --sheet --columns 2 mixed.png && size mixed.png
mr-render -s 60x60 --view 1,2,3 -i layers.mrs near.png
mr-render -s 60x60 -i torus.mrs near.png; mr-render -s 60x60 --at 0,0,0,9 -i torus.mrs far.png
cmp -s far.png near.png || echo 'another point, another picture'
mr-render --at 1,2 -i torus.mrs none.png 2>err; echo "exit $?: $(head -n 1 err)"
for view in front back left right top bottom iso 1,2,3; do
	mr-render -s 60x60 --view $view --up z --wire -i layers.mrs view.png || echo "$view fails"
done

# An animation stands still: what a picture shows does not depend on the panels of other frames' keys, but on its own deltas.
mr-select --free all --handle 0=above:z,0.8 torus.mrs | mr-pose --frames 3 --translate 1,0,0 >poses.mrs
mr-render -s 80x60 'pose-%d.png' <poses.mrs && ls pose-*.png

# A pipe is written where it is, and a link stays one.
mkfifo pipe
mr-render -s 120x80 -i torus.mrs pipe & cat pipe >read.png
wait; [ -p pipe ] && cmp one.png read.png && echo 'same through a pipe'
ln -s real.png link.png; : >real.png
mr-render -s 120x80 -i torus.mrs link.png && [ -L link.png ] && cmp one.png real.png && echo 'same behind a link'

# A failure leaves no picture behind.
mr-render -s 100x90 none.png <two.mrs 2>err; echo "exit $?: $(head -n 1 err)"
mr-render --color nothing none.png <torus.mrs 2>err; echo "exit $?: $(head -n 1 err)"
mr-render -l control none.png <torus.mrs 2>err; echo "exit $?: $(head -n 1 err)"
mr-render no/such/folder.png <torus.mrs 2>err; echo "exit $?: $(head -n 1 err)"
head -c 1000 torus.mrs | mr-render none.png 2>err; echo "exit $?"
ls none.png* 2>/dev/null || echo 'no picture'
